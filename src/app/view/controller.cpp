#include "app/view/controller.h"

#include <algorithm>
#include <cmath>

#include "app/console.h"
#include "app/view/camera_moves.h"
#include "app/view/still.h"

namespace lancer {
namespace {

constexpr double full_turn_rad = 2 * pi_d;
constexpr double click_slack = 3;        // pixels that a click may move
constexpr double line_slack = 5;         // pixels beside the line of the split that still mean it
constexpr double double_click = 0.35;    // seconds
constexpr double step_of_wheel = 0.1;    // part of the distance
constexpr double seconds_per_frame = 2;  // from key frame to key frame
constexpr double third_of_a_stop = 1.0 / 3;
constexpr double fly_speed = 0.7;  // distances to the target a second
constexpr uint32_t least_depth = 1, most_depth = 20;
constexpr uint32_t usual_depth_of_path = 20, usual_depth_of_classic = 7;
constexpr uint32_t traced_paths = 8;  // of a pixel
constexpr std::string_view fly_keys = "WASD";

std::optional<size_t> fly_key_of(int key)
{
    const size_t place = key >= 0 && key < 128 ? fly_keys.find(static_cast<char>(key)) : fly_keys.npos;
    return place == fly_keys.npos ? std::nullopt : std::optional(place);
}

// The way that one looks from the front, where z is up as where y is.
Vec3d front_of(Vec3d up) { return std::abs(up.z) > std::abs(up.y) ? Vec3d{0, 1, 0} : Vec3d{0, 0, -1}; }

}  // namespace

Controller::Controller(Session& session, EditedScene document, Sight first, DisplayCurve curve, KeyFrames frames,
                       ControllerHost host)
    : session_(session),
      document_(std::move(document)),
      sight_(first),
      first_(std::move(first)),
      curve_(curve),
      frames_(std::move(frames)),
      host_(std::move(host))
{
}

void Controller::say(const std::string& text)
{
    message_ = text;
    host_.say(text);
}

void Controller::show()
{
    sight_.scene = document_.scene(), sight_.rest = document_.rest();
    number_ = split_ ? split_->show(sight_) : session_.show(sight_);
}

bool Controller::take(ShownPicture& picture)
{
    if (split_) return split_->take(picture);
    if (std::exchange(is_other_picture_, false)) picture.version = 0;
    return session_.take(picture);
}

// The settings as they are stay on the left; what is chosen from now on is shown on the right.
void Controller::toggle_split()
{
    if (split_) {
        split_.reset();
        is_other_picture_ = true;
    } else {
        split_ = std::make_unique<Split>(session_, sight_);
        say("the settings are kept on the left: choose others for the right");
    }
    show();
}

bool Controller::is_at_line(double x) const
{
    return split_ && std::abs(x - split_->place() * sight_.settings.size.width) <= line_slack;
}

void Controller::set_camera(const CameraDescription& camera)
{
    if (is_same_view(camera, sight_.camera)) return;
    sight_.camera = camera;
    show();
}

std::string Controller::scene_text() const
{
    OutputDescription output;
    output.exposure = Exposure{.stops = curve_.exposure_stops};
    output.tonemap = curve_.tonemap;
    return document_.text(sight_.camera, sight_.settings, output);
}

void Controller::handle(const InputEvent& event)
{
    using Kind = InputEvent::Kind;
    if (event.kind == Kind::key_down || event.kind == Kind::key_up) fly_key(event);
    if (event.kind == Kind::key_down && !(drag_ == Drag::look && fly_key_of(event.key)))
        if (const auto action = action_of(event.key, event.mods)) act(*action);
    if (event.kind == Kind::button_down) press(event);
    if (event.kind == Kind::button_up) release(event);
    if (event.kind == Kind::move) move(event);
    if (event.kind == Kind::wheel) wheel(event);
    if (event.kind != Kind::key_down && event.kind != Kind::key_up) last_ = event;
}

// Held with the right button; D alone is the depth.
void Controller::fly_key(const InputEvent& event)
{
    const auto place = fly_key_of(event.key);
    if (!place) return;
    const uint32_t bit = 1u << *place;
    if (event.kind == InputEvent::Kind::key_up)
        flies_ &= ~bit;
    else if (drag_ == Drag::look)
        flies_ |= bit;
}

void Controller::press(const InputEvent& event)
{
    playing_since_.reset();
    pressed_ = last_ = event;
    has_dragged_ = false;
    held_ = event.key == 2 ? std::nullopt : handle_at(handles(), event.x, event.y);
    if (held_)
        drag_ = Drag::handle;
    else if (event.key == 0 && is_at_line(event.x))
        drag_ = Drag::line;
    else if (event.key == 2 || (event.key == 0 && (event.mods & mod_shift)))
        drag_ = Drag::pan;
    else
        drag_ = event.key == 1 ? Drag::look : Drag::orbit;
}

void Controller::release(const InputEvent& event)
{
    const bool was_click = !has_dragged_ && event.key == 0;
    if (was_click && held_)
        (held_->kind == Handle::Kind::light ? light_ : sphere_) = held_->index;
    else if (was_click && drag_ != Drag::line)
        click(event);
    drag_ = Drag::none;
    held_.reset();
    flies_ = 0;
}

void Controller::move(const InputEvent& event)
{
    if (drag_ == Drag::none) {
        hovered_ = handle_at(handles(), event.x, event.y);
        return;
    }
    if (std::hypot(event.x - pressed_.x, event.y - pressed_.y) > click_slack) has_dragged_ = true;
    if (!has_dragged_) return;
    const double height = sight_.settings.size.height;
    const double right = (event.x - last_.x) / height, up = (last_.y - event.y) / height;
    // What is under the mouse goes with it; half a turn is the height of the picture.
    const double turn = 0.5 * full_turn_rad, look = sight_.camera.fov_deg * pi_d / 180;
    if (drag_ == Drag::orbit) set_camera(orbited(sight_.camera, -right * turn, -up * turn));
    if (drag_ == Drag::pan) set_camera(panned(sight_.camera, -right, -up));
    if (drag_ == Drag::look) set_camera(turned(sight_.camera, right * look, up * look));
    if (drag_ == Drag::handle) drag_handle(right, up);
    if (drag_ == Drag::line) split_->move_to(event.x / sight_.settings.size.width);
}

void Controller::wheel(const InputEvent& event)
{
    const auto at = handle_at(handles(), event.x, event.y);
    if (at)
        move_handle(*at, moved_along_view(sight_.camera, place_of(*at), step_of_wheel * event.amount));
    else
        set_camera(dollied(sight_.camera, std::pow(1 - step_of_wheel, event.amount)));
}

Vec3d Controller::place_of(const Handle& handle) const
{
    const SceneDescription& scene = *document_.scene();
    return handle.kind == Handle::Kind::light ? scene.lights[handle.index].position
                                              : scene.spheres[handle.index].center;
}

void Controller::drag_handle(double right, double up)
{
    move_handle(*held_, moved_in_view(sight_.camera, place_of(*held_), right, up));
}

void Controller::move_handle(const Handle& handle, Vec3d to)
{
    if (handle.kind == Handle::Kind::light) {
        light_ = handle.index;
        document_.move_light(handle.index, to);
    } else {
        document_.move_sphere(handle.index, to);
    }
    show();
}

void Controller::click(const InputEvent& event)
{
    const bool is_double = event.seconds - last_click_ < double_click;
    last_click_ = is_double ? -1 : event.seconds;
    select(event);
    if (!picked_) return;
    if (event.mods & mod_control) {
        CameraDescription camera = sight_.camera;
        camera.focus = picked_->depth;
        say(format_text("focus at %g", picked_->depth));
        set_camera(camera);
    } else if (is_double) {
        set_camera(centred(sight_.camera, picked_->point));
    }
}

void Controller::select(const InputEvent& event)
{
    picked_ = pick(*session_.renderer(), *document_.scene(), sight_.camera, sight_.settings.size, event.x, event.y);
    sphere_ = picked_ && picked_->sphere && document_.can_move(*picked_->sphere) ? picked_->sphere : std::nullopt;
    light_ = picked_ ? picked_->light : std::nullopt;
}

void Controller::act(const KeyAction& action)
{
    using enum Action;
    const auto toggle = [](bool& flag) { flag = !flag; };
    switch (action.action) {
        case still_eighth:
            return still(8);
        case still_half:
            return still(2);
        case still_full:
            return still(1);
        case deeper:
            return change_depth(1);
        case shallower:
            return change_depth(-1);
        case define_frame:
            frames_.define(action.frame, sight_.camera);
            has_new_frames_ = true;
            return say(format_text("key frame F%u is defined", action.frame + 1));
        case restore_frame:
            playing_since_.reset();
            if (!frames_.at(action.frame)) return say(format_text("there is no key frame F%u", action.frame + 1));
            return set_camera(*frames_.at(action.frame));
        case play:
            if (playing_since_)
                playing_since_.reset();
            else if (frames_.defined() > 0)
                playing_since_ = ticked_;
            return;
        case pause:
            toggle(is_paused_);
            if (split_) split_->pause(is_paused_);
            return session_.pause(is_paused_);
        case view_front:
            return set_camera(seen_along(sight_.camera, front_of(sight_.camera.up)));
        case view_side:
            return set_camera(seen_along(sight_.camera, {-1, 0, 0}));
        case view_top:
            // A little off the vertical, which has no direction that is up.
            return set_camera(orbited(seen_along(sight_.camera, front_of(sight_.camera.up)), 0, 0.5 * pi_d));
        case view_own:
            return set_camera(first_.camera);
        case Action::next_camera:
            return go_to_next_camera();
        case print_camera:
            host_.print(camera_table(sight_.camera));
            return host_.copy(camera_table(sight_.camera));
        case write_scene:
            return host_.save_scene(scene_text());
        case write_over:
            if (const std::string old = host_.save_over(scene_text()); !old.empty()) {
                document_.read_from(old);
                say("the file as it was is " + old);
            }
            return;
        case write_picture:
            return session_.write_picture([write = host_.write_picture, curve = curve_](
                                              const Film& f, const Renderer& r) { write(f, r, curve); });
        case next_shown:
            sight_.shown = static_cast<ShownAs>((static_cast<size_t>(sight_.shown) + 1) % enum_names<ShownAs>.size());
            say("shown: " + std::string(name_of(sight_.shown)));
            return show();
        case brighter:
            curve_.exposure_stops += static_cast<float>(third_of_a_stop);
            return;
        case darker:
            curve_.exposure_stops -= static_cast<float>(third_of_a_stop);
            return;
        case next_tonemap:
            curve_.tonemap =
                static_cast<ToneMap>((static_cast<size_t>(curve_.tonemap) + 1) % enum_names<ToneMap>.size());
            return say("tone map " + std::string(name_of(curve_.tonemap)));
        case toggle_handles:
            return toggle(shows_handles_);
        case remove:
            if (!light_) return say("no light is selected: click on its handle");
            document_.set_power(*light_, {});
            return show();
        case trace_pixel:
            return show_paths();
        case beside:
            return toggle_split();
        case Action::help:
            return toggle(shows_help_);
        case cancel:
            return session_.cancel_still();
        case close:
            wants_close_ = true;
    }
}

void Controller::still(uint32_t reduction)
{
    Sight sight = sight_;
    sight.shown = ShownAs::light;
    session_.render_still(
        std::move(sight), reduction,
        [write = host_.write_picture, curve = curve_](const Film& f, const Renderer& r) { write(f, r, curve); });
}

// Of the picture as it is shown; lines stay where they are in the scene when the camera moves.
void Controller::show_paths()
{
    if (!lines_->get().empty()) return lines_->set({});
    const PictureSize size = sight_.settings.size;
    if (!(last_.x >= 0 && last_.y >= 0 && last_.x < size.width && last_.y < size.height))
        return say("no pixel is under the mouse");
    const auto x = static_cast<uint32_t>(last_.x), y = static_cast<uint32_t>(last_.y);
    say(format_text("paths of pixel %u %u: lancer pixel %u %u prints them", x, y, x, y));
    session_.write_picture([lines = lines_, sight = sight_, x, y](const Film& film, const Renderer& renderer) {
        lines->set(paths_of_pixel(renderer, camera_of(renderer, sight, film), sight.settings.size, x, y, traced_paths));
    });
}

// From 0, which is no limit, to what is usual of the integrator.
void Controller::change_depth(int by)
{
    uint32_t& depth = sight_.settings.max_depth;
    if (depth == 0)
        depth = is_classic(sight_.settings.integrator) ? usual_depth_of_classic : usual_depth_of_path;
    else
        depth = static_cast<uint32_t>(std::clamp(static_cast<int>(std::min(depth, most_depth)) + by,
                                                 static_cast<int>(least_depth), static_cast<int>(most_depth)));
    say(format_text("Max depth is %u", depth));
    show();
}

void Controller::go_to_next_camera()
{
    const auto& cameras = document_.scene()->cameras;
    if (cameras.empty()) return say("the scene has no [camera.NAME]");
    const CameraDescription& camera = cameras[camera_++ % cameras.size()];
    say("camera " + camera.name);
    set_camera(camera);
}

void Controller::tick(double now)
{
    const double passed = std::clamp(now - ticked_, 0.0, 0.1);
    ticked_ = now;
    if (playing_since_) {
        const double time = (now - *playing_since_) / seconds_per_frame;
        set_camera(frames_.along(time));
        if (time >= frames_.defined() - 1) playing_since_.reset();
    }
    if (!is_flying()) return;
    const double way = passed * fly_speed * length(sight_.camera.target - sight_.camera.position);
    const auto held = [&](char key) { return (flies_ >> fly_keys.find(key) & 1) != 0 ? way : 0.0; };
    set_camera(flown(sight_.camera, {held('D') - held('A'), 0, held('W') - held('S')}));
}

std::vector<Handle> Controller::handles() const
{
    if (!shows_handles_) return {};
    return handles_of(*document_.scene(), sight_.camera, sight_.settings.size, sphere_);
}

}  // namespace lancer
