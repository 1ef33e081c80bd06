#include "scene/view/auto_view.h"

#include "scene/view/coarse_grid.h"
#include "scene/view/enclosure.h"
#include "scene/view/frame_fit.h"
#include "scene/view/sheet.h"
#include "scene/view/subject.h"
#include "scene/view/up_axis.h"
#include "scene/view/up_frame.h"
#include "scene/view/view_detail.h"

namespace lancer {
namespace {

constexpr double usual_elevation = 17, interior_fov = 60;  // degrees

bool are_parallel(Vec3d a, Vec3d b) { return length(cross(a, b)) < 1e-6 * length(a) * length(b); }

class Chooser {
public:
    Chooser(const SceneDescription& scene, const CameraDescription& camera, const ViewWish& wish, double aspect)
        : subject_(scene), wish_(wish), aspect_(aspect)
    {
        view_.camera = camera;
        if (subject_.is_usable()) grid_.emplace(subject_);
    }
    AutoView choose();

private:
    void choose_up();
    Vec3d choose_direction(const UpFrame& frame);
    void look_at_subject(Vec3d towards);
    void look_from_given_place(Vec3d towards);
    void say(const std::string& reason) { view_.reasons.push_back(reason); }

    const Subject subject_;
    std::optional<CoarseGrid> grid_;
    const ViewWish wish_;
    const double aspect_;
    AutoView view_;
    std::optional<Enclosure::Viewpoint> inside_;
};

Vec3d axis_of(UpChoice choice) { return choice == UpChoice::z ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0}; }

// Turns `up` where the view is along it.
void keep_upright(CameraDescription& c)
{
    const Vec3d towards = c.position - c.target;
    if (are_parallel(towards, c.up))
        c.up = UpFrame(c.up).upright_from(normalize(towards / max_component(abs(towards))));
}

void Chooser::choose_up()
{
    CameraDescription& c = view_.camera;
    if (c.missing.up) {
        c.up = axis_of(wish_.up);
        if (wish_.up == UpChoice::automatic && grid_)
            if (const UpGuess guess = guess_up(subject_, *grid_); guess.z) {
                c.up = {0, 0, 1};
                say("up is z, as " + guess.why + "; --up y for y");
            }
    }
    view_.up = UpFrame(c.up).up;
}

// Towards the viewer.
Vec3d Chooser::choose_direction(const UpFrame& frame)
{
    const std::optional<Vec3d> sheet = grid_ ? sheet_normal(subject_, *grid_, frame) : std::nullopt;
    const Enclosure enclosure = grid_ && !sheet ? find_enclosure(*grid_, frame) : Enclosure{};
    if (sheet) view_.kind = SubjectKind::sheet;
    if (enclosure.open_azimuth_deg) view_.kind = SubjectKind::open_box;
    if (enclosure.inside) view_.kind = SubjectKind::interior;
    if (wish_.direction) return frame.towards(wish_.direction->azimuth_deg, wish_.direction->elevation_deg);
    if (sheet) {
        say("a flat sheet, seen from its front");
        return *sheet;
    }
    if (enclosure.open_azimuth_deg) {
        say("a room, seen through its open side");
        return frame.towards(*enclosure.open_azimuth_deg, 0);
    }
    if (enclosure.inside) {
        inside_ = enclosure.inside;
        return normalize(-enclosure.inside->ahead);
    }
    return frame.towards(grid_ ? best_azimuth(*grid_, frame, usual_elevation) : 30, usual_elevation);
}

void Chooser::look_at_subject(Vec3d towards)
{
    CameraDescription& c = view_.camera;
    if (inside_ && c.missing.target) {
        say("a room, seen from inside along its length; --view front for a view from outside");
        c.position = subject_.to_file(inside_->position);
        c.target = subject_.to_file(inside_->position + inside_->ahead);
        if (c.missing.fov) c.fov_deg = interior_fov;
        return;
    }
    const Bounds& b = subject_.bounds();
    if (c.missing.target) c.target = b.empty() ? Vec3d{} : b.center();
    // Right for a subject without size; and it tells whether `up` suits the direction.
    c.position = c.target + towards * (5 * std::max(1.0, max_component(abs(c.target)) * 1e-6));
    keep_upright(c);
    if (subject_.is_usable()) fit_to_frame(c, subject_, towards, aspect_, !c.missing.target);
}

void Chooser::look_from_given_place(Vec3d towards)
{
    CameraDescription& c = view_.camera;
    const Bounds& b = subject_.bounds();
    c.target = b.empty() ? Vec3d{} : b.center();
    const double size = b.extent() > 0 ? b.extent() : 1;
    if (!(length(c.target - c.position) > 1e-6 * size)) c.target = c.position - towards * size;
    keep_upright(c);
}

AutoView Chooser::choose()
{
    CameraDescription& c = view_.camera;
    choose_up();
    const UpFrame frame(c.up);
    const bool needs_direction = c.missing.position || wish_.wants_kind;
    const Vec3d towards = needs_direction ? choose_direction(frame) : frame.towards(0, 0);
    if (c.missing.position) {
        look_at_subject(towards);
    } else if (c.missing.target) {
        look_from_given_place(towards);
    } else {
        keep_upright(c);
    }
    c.missing = {};
    return view_;
}

}  // namespace

AutoView choose_view(const SceneDescription& scene, const CameraDescription& camera, const ViewWish& wish,
                     double aspect)
{
    const bool has_place = !camera.missing.position && !camera.missing.target;
    if (!has_place || wish.wants_kind || (camera.missing.up && wish.up == UpChoice::automatic))
        return Chooser(scene, camera, wish, aspect).choose();
    AutoView view{.camera = camera, .up = {}, .kind = {}, .reasons = {}};
    if (camera.missing.up) view.camera.up = axis_of(wish.up);
    view.up = UpFrame(view.camera.up).up;
    keep_upright(view.camera);
    view.camera.missing = {};
    return view;
}

}  // namespace lancer
