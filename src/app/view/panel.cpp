// The panel of the controller: what it shows, and what its widgets change.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "app/console.h"
#include "app/view/camera_moves.h"
#include "app/view/controller.h"
#include "scene/description/render_options.h"

namespace lancer {
namespace {

enum PanelId : int {
    id_none,
    id_position,
    id_target,
    id_up,
    id_fov,
    id_lens,
    id_aperture,
    id_focus,
    id_integrator,
    id_accel,
    id_sampler,
    id_depth,
    id_spp,
    id_switches,
    id_shown,
    id_exposure,
    id_tonemap,
    id_light_power,
    id_light_position,
    id_light_direction,
    id_light_radius,
    id_sky_rotation,
    id_light,
    id_new_light,
    id_sphere_center,
    id_switch = 1000,    // the first of many
    id_material = 2000,  // the first of many
};

constexpr uint32_t handle_color = 0xff40c0ff, hovered_color = 0xff60ffff, selected_color = 0xff60ff60,
                   shade_color = 0xa0000000;

Widget heading(std::string label) { return {.kind = Widget::Kind::heading, .label = std::move(label)}; }
Widget text_of(std::string label) { return {.kind = Widget::Kind::text, .label = std::move(label)}; }
Widget vector_widget(PanelId id, std::string label, Vec3d v, double step)
{
    return {.kind = Widget::Kind::number,
            .id = id,
            .label = std::move(label),
            .value = {v.x, v.y, v.z},
            .count = 3,
            .step = step};
}
Widget number_widget(PanelId id, std::string label, double x, double step, double least, double most)
{
    return {.kind = Widget::Kind::number,
            .id = id,
            .label = std::move(label),
            .value = {x},
            .count = 1,
            .step = step,
            .least = least,
            .most = most};
}
template <class E>
Widget choice_widget(PanelId id, std::string label, E value)
{
    Widget w{.kind = Widget::Kind::choice, .id = id, .label = std::move(label), .value = {static_cast<double>(value)}};
    for (const std::string_view name : enum_names<E>) w.choices.emplace_back(name);
    return w;
}
Vec3d vector_in(const Widget& w) { return {w.value[0], w.value[1], w.value[2]}; }
Color color_in(const Widget& w)
{
    const auto positive = [](double x) { return static_cast<float>(std::max(0.0, x)); };
    return {positive(w.value[0]), positive(w.value[1]), positive(w.value[2])};
}

// What can be added: all but an environment, of which there is one.
std::vector<std::string> new_lights()
{
    std::vector<std::string> names{"a light"};
    for (size_t i = 0; i < static_cast<size_t>(LightType::environment); ++i)
        names.emplace_back(enum_names<LightType>[i]);
    return names;
}
// A new light above and before what the camera looks at, which a white surface there shows as 1.
LightDescription light_about(const CameraDescription& c, LightType type)
{
    const Vec3d back = c.position - c.target;
    const double far = 0.5 * length(back);
    LightDescription l;
    l.type = type;
    l.position = c.target + normalize(normalize(back) + 2.0 * normalize(c.up)) * far;
    l.direction = c.target - l.position;
    l.radius = 0.1 * far;
    const double area = pi_d * l.radius * l.radius, at_target = pi_d;
    const double power = type == LightType::directional ? at_target
                         : type == LightType::sphere    ? at_target * far * far / area
                                                        : at_target * far * far;
    const auto of_each = static_cast<float>(power);
    l.power = {of_each, of_each, of_each};
    return l;
}

// The value under the mouse.
std::string pixel_text(const ShownPicture& picture, PictureSize size, double x, double y)
{
    if (!(x >= 0 && y >= 0 && x < size.width && y < size.height) || picture.image.pixels.empty()) return "";
    const Window& data = picture.image.data;
    const auto at = [](double place, uint32_t full, int32_t have) {
        return std::min(have - 1, static_cast<int32_t>(place * have / full));
    };
    const Color c = picture.image.at(at(x, size.width, data.width()), at(y, size.height, data.height()));
    return format_text("   pixel %d %d: %.4g %.4g %.4g", static_cast<int>(x), static_cast<int>(y), double{c.r},
                       double{c.g}, double{c.b});
}

}  // namespace

void Controller::draw(const ShownPicture& picture, WindowFrame& frame) const
{
    const SceneDescription& scene = *document_.scene();
    const CameraDescription& c = sight_.camera;
    const RenderSettings& s = sight_.settings;
    const double far = length(c.target - c.position), step = 0.005 * far;
    auto& w = frame.widgets;
    w.clear(), frame.marks.clear();

    w.push_back(heading("Camera"));
    w.push_back(vector_widget(id_position, "position", c.position, step));
    w.push_back(vector_widget(id_target, "target", c.target, step));
    w.push_back(vector_widget(id_up, "up", c.up, 0.01));
    w.push_back(number_widget(id_fov, "fov", c.fov_deg, 0.1, 0.1, 179));
    w.push_back(choice_widget(id_lens, "type", c.type));
    if (c.type == CameraType::thin_lens) {
        w.push_back(number_widget(id_aperture, "aperture", c.aperture, 0.001 * far, 0, 1e30));
        w.push_back(number_widget(id_focus, "focus", c.focus.value_or(far), step, 1e-30, 1e30));
    }
    w.push_back(heading("Picture"));
    w.push_back(choice_widget(id_shown, "shown", sight_.shown));
    w.push_back(number_widget(id_exposure, "exposure", double{curve_.exposure_stops}, 0.02, -64, 64));
    w.push_back(choice_widget(id_tonemap, "tone map", curve_.tonemap));
    w.push_back(choice_widget(id_integrator, "integrator", s.integrator));
    w.push_back(choice_widget(id_accel, "accelerator", s.accel));
    w.push_back(choice_widget(id_sampler, "sampler", s.sampler));
    w.push_back(number_widget(id_depth, "max depth", s.max_depth, 0.1, 0, 1e6));
    w.push_back(number_widget(id_spp, "samples", s.spp, 1, 1, 1e6));
    draw_switches(w);
    if (split_) {
        w.push_back(heading("Beside each other"));
        for (std::string& line : split_->lines()) w.push_back(text_of(std::move(line)));
        for (Mark& mark : split_->marks(s.size)) frame.marks.push_back(std::move(mark));
    }

    w.push_back(heading("Lights"));
    std::vector<std::string> names{"none"};
    for (size_t i = 0; i < scene.lights.size(); ++i)
        names.push_back(std::to_string(i) + " " + std::string(name_of(scene.lights[i].type)));
    w.push_back({.kind = Widget::Kind::choice,
                 .id = id_light,
                 .label = "light",
                 .value = {light_ ? static_cast<double>(*light_ + 1) : 0},
                 .choices = names});
    w.push_back({.kind = Widget::Kind::choice, .id = id_new_light, .label = "add", .choices = new_lights()});
    if (light_ && *light_ < scene.lights.size()) {
        const LightDescription& l = scene.lights[*light_];
        w.push_back({.kind = Widget::Kind::color,
                     .id = id_light_power,
                     .label = "power",
                     .value = {l.power.r, l.power.g, l.power.b},
                     .step = 0.01 * std::max(0.1, double{max_component(l.power)}),
                     .least = 0});
        if (l.type == LightType::point || l.type == LightType::spot || l.type == LightType::sphere)
            w.push_back(vector_widget(id_light_position, "place", l.position, step));
        if (l.type == LightType::directional || l.type == LightType::spot)
            w.push_back(vector_widget(id_light_direction, "direction", l.direction, 0.01));
        if (l.type == LightType::sphere)
            w.push_back(number_widget(id_light_radius, "radius", l.radius, 0.1 * step, 1e-30, 1e30));
        if (!l.file.empty()) w.push_back(vector_widget(id_sky_rotation, "rotate", l.rotate_deg, 0.5));
    }
    if (picked_) {
        w.push_back(heading("Selected"));
        w.push_back(text_of(picked_->object + ", material " + picked_->material));
        w.push_back(text_of(format_text("at %.6g %.6g %.6g, depth %.6g", picked_->point.x, picked_->point.y,
                                        picked_->point.z, picked_->depth)));
        if (sphere_) w.push_back(vector_widget(id_sphere_center, "center", scene.spheres[*sphere_].center, step));
        int id = id_material;
        for (const MaterialNumber& n : document_.numbers_of(picked_->material)) {
            Widget number{.kind = n.count == 3 ? Widget::Kind::color : Widget::Kind::number,
                          .id = id++,
                          .label = n.key,
                          .value = {n.value[0], n.value[1], n.value[2]},
                          .count = n.count};
            number.least = std::isfinite(n.least) ? double{n.least} : -1e300;
            number.most = std::isfinite(n.most) ? double{n.most} : 1e300;
            w.push_back(std::move(number));
        }
    }

    for (const Handle& h : handles()) {
        const bool is_selected = h.kind == Handle::Kind::light ? light_ == h.index : sphere_ == h.index;
        const bool is_hovered = hovered_ == h || held_ == h;
        const uint32_t color = is_hovered ? hovered_color : is_selected ? selected_color : handle_color;
        frame.marks.push_back(
            {.kind = Mark::Kind::disc, .x0 = h.x, .y0 = h.y, .x1 = is_hovered ? 7.0 : 5.0, .color = shade_color});
        frame.marks.push_back(
            {.kind = Mark::Kind::disc, .x0 = h.x, .y0 = h.y, .x1 = is_hovered ? 5.0 : 3.0, .color = color});
        frame.marks.push_back({.kind = Mark::Kind::circle, .x0 = h.x, .y0 = h.y, .x1 = h.radius, .color = color});
    }

    for (Mark& line : marks_of(lines_->get(), c, s.size)) frame.marks.push_back(std::move(line));

    const SessionStatus status = session_.status();
    frame.picture_width = static_cast<int32_t>(s.size.width),
    frame.picture_height = static_cast<int32_t>(s.size.height);
    frame.status = status.reduction > 1 ? format_text("1/%u", status.reduction)
                                        : format_text("%u of %u samples", status.samples, s.spp);
    if (status.still >= 0) frame.status += format_text("   rendering into a file: %.0f %%", 100 * status.still);
    if (is_paused_) frame.status += "   paused";
    frame.status += pixel_text(picture, s.size, last_.x, last_.y);
    const std::string& said = status.problem.empty() ? message_ : status.problem;
    if (!said.empty()) frame.status += "   " + said;
    frame.overlay = shows_help_ ? key_help() : "";
}

// Of render options; --legacy, which chooses others with it, is none for a window that is open.
void Controller::draw_switches(std::vector<Widget>& widgets) const
{
    const auto toggle = [&](int id, std::string label, bool is_on) {
        widgets.push_back(
            {.kind = Widget::Kind::toggle, .id = id, .label = std::move(label), .value = {is_on ? 1.0 : 0.0}});
    };
    toggle(id_switches, "switches", shows_switches_);
    if (!shows_switches_) return;
    int id = id_switch;
    for (const RenderOption& option : render_options()) {
        const auto* field = std::get_if<SwitchField>(&option.field);
        if (field && field->member != &RenderSettings::legacy)
            toggle(id, std::string(option.name), sight_.settings.*field->member);
        ++id;
    }
}

void Controller::change(const Widget& widget)
{
    CameraDescription c = sight_.camera;
    RenderSettings& s = sight_.settings;
    const double x = widget.value[0];
    const auto chosen = [&]<class E>(E) { return static_cast<E>(static_cast<int>(x)); };
    switch (widget.id) {
        case id_position:
            c.position = vector_in(widget);
            break;
        case id_target:
            c.target = vector_in(widget);
            break;
        case id_up:
            c.up = vector_in(widget);
            break;
        case id_fov:
            c.fov_deg = std::clamp(x, 0.1, 179.0);
            break;
        case id_lens:
            c.type = chosen(c.type);
            break;
        case id_aperture:
            c.aperture = std::max(0.0, x);
            break;
        case id_focus:
            if (x > 0) c.focus = x;
            break;
        case id_exposure:
            curve_.exposure_stops = static_cast<float>(std::clamp(x, -64.0, 64.0));
            return;
        case id_tonemap:
            curve_.tonemap = chosen(curve_.tonemap);
            return;
        case id_light:
            light_ = x >= 1 ? std::optional(static_cast<size_t>(x) - 1) : std::nullopt;
            return;
        case id_shown:
            sight_.shown = chosen(sight_.shown);
            return show();
        case id_integrator:
            s.integrator = chosen(s.integrator);
            return show();
        case id_accel:
            s.accel = chosen(s.accel);
            return show();
        case id_sampler:
            s.sampler = chosen(s.sampler);
            return show();
        case id_depth:
            s.max_depth = static_cast<uint32_t>(std::clamp(x, 0.0, 1e6));
            return show();
        case id_switches:
            shows_switches_ = x != 0;
            return;
        case id_spp:
            s.spp = static_cast<uint32_t>(std::clamp(x, 1.0, 1e6));
            return show();
        case id_light_power:
            if (light_) document_.set_power(*light_, color_in(widget));
            return show();
        case id_light_position:
            if (light_) document_.move_light(*light_, vector_in(widget));
            return show();
        case id_light_direction:
            if (light_) document_.turn_light(*light_, vector_in(widget));
            return show();
        case id_light_radius:
            if (light_) document_.set_radius(*light_, x);
            return show();
        case id_sky_rotation:
            if (light_) document_.turn_sky(*light_, vector_in(widget));
            return show();
        case id_new_light:
            if (!(x >= 1)) return;
            light_ = document_.add_light(light_about(sight_.camera, static_cast<LightType>(static_cast<int>(x) - 1)));
            return show();
        case id_sphere_center:
            if (sphere_) document_.move_sphere(*sphere_, vector_in(widget));
            return show();
        default:
            if (widget.id >= id_switch && widget.id < id_material) {
                const RenderOption& option = render_options()[static_cast<size_t>(widget.id - id_switch)];
                s.*std::get<SwitchField>(option.field).member = x != 0;
                return show();
            }
            if (widget.id < id_material || !picked_) return;
            for (MaterialNumber& n : document_.numbers_of(picked_->material))
                if (n.key == widget.label) {
                    for (size_t i = 0; i < 3; ++i) n.value[i] = static_cast<float>(widget.value[i]);
                    document_.set_number(picked_->material, n);
                }
            return show();
    }
    // The axes of a view must be three: what has none is not taken.
    const Vec3d forward = c.target - c.position, right = cross(forward, c.up);
    if (length(right) > 1e-9 * length(forward) * length(c.up)) set_camera(c);
}

}  // namespace lancer
