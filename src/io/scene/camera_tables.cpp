#include "io/scene/camera_tables.h"

#include <cmath>

namespace lancer {
namespace {

// Whether no plane is spanned by the two, up to what is left of it in single precision.
bool are_parallel(Vec3d a, Vec3d b)
{
    constexpr double least_sine = 1e-6;
    a /= max_component(abs(a));  // so that no square of a huge or tiny number leaves the range
    b /= max_component(abs(b));
    return length(cross(normalize(a), normalize(b))) < least_sine;
}

// What is missing is chosen so that it suits the rest.
void check_view(const CameraDescription& camera, const TomlTable& table)
{
    if (!camera.missing.up && camera.up == Vec3d{}) return table.error("up", " must not be the zero vector");
    if (camera.missing.position || camera.missing.target) return;
    const Vec3d view = camera.target - camera.position;
    if (view == Vec3d{}) {
        table.error(table.where(table.has("target") ? "target" : "position"),
                    "'position' and 'target' in " + table.label() + " must be different points");
    } else if (!is_finite(view)) {
        table.error(table.where("target"), "'position' and 'target' in " + table.label() + " are too far apart");
    } else if (!camera.missing.up && are_parallel(view, camera.up)) {
        table.error("up", " must not be parallel to the view, from 'position' to 'target'");
    }
}

// The keys that only some types of camera have.
const std::vector<TypedKey> lens_keys{{"aperture", {"thin_lens"}}, {"focus", {"thin_lens"}}};

CameraDescription read_camera(const TomlTable& table, const CameraDescription& base)
{
    CameraDescription camera = base;
    camera.where = table.where();
    const NameList types{enum_names<CameraType>.begin(), enum_names<CameraType>.end()};
    if (const std::optional<size_t> type = table.choice("type", types, static_cast<size_t>(base.type))) {
        camera.type = static_cast<CameraType>(*type);
        table.reject_keys_of_other_types(types[*type], lens_keys);
    }
    const std::optional<Vec3d> position = table.vector("position"), target = table.vector("target");
    camera.position = position.value_or(camera.position);
    camera.target = target.value_or(camera.target);
    camera.fov_deg = table.number("fov", half_turn).value_or(camera.fov_deg);
    const auto note = [&](bool& missing, const char* key) { missing = missing && !table.has(key); };
    note(camera.missing.position, "position");
    note(camera.missing.target, "target");
    note(camera.missing.up, "up");
    note(camera.missing.fov, "fov");
    camera.aperture = table.number("aperture", zero_or_more).value_or(camera.aperture);
    camera.inside = table.text("inside").value_or(camera.inside);
    const std::optional<double> focus = table.number("focus", above_zero);
    if (focus) camera.focus = focus;
    if (camera.type == CameraType::pinhole) camera.aperture = 0, camera.focus.reset();

    const std::optional<Vec3d> up = read_up(table);
    camera.up = up.value_or(camera.up);

    // Where one was given and is wrong, its default must not be blamed as well.
    const bool is_read = (position || !table.has("position")) && (target || !table.has("target"));
    if (is_read && (up || !table.has("up"))) check_view(camera, table);
    return camera;
}

}  // namespace

std::optional<Vec3d> read_up(const TomlTable& table)
{
    if (!table.holds_text("up")) return table.vector("up");
    const std::optional<size_t> axis = table.choice("up", {"y", "z"}, 0);
    if (!axis) return {};
    return *axis == 0 ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
}

void read_cameras(const TomlTable& root, SceneDescription& scene)
{
    const std::optional<TomlTable> table = root.table("camera");
    if (!table) return;
    const NameList keys{"type", "position", "target", "up", "fov", "aperture", "focus", "inside"};
    table->allow_besides_tables(keys);
    CameraDescription base;
    base.missing = {.position = true, .target = true, .up = true, .fov = true};
    if (!table->has_only_tables()) scene.camera = base = read_camera(*table, base);
    for (const auto& [name, named] : table->tables_within("camera")) {
        named.allow(keys);
        CameraDescription camera = read_camera(named, base);
        camera.name = name;
        scene.cameras.push_back(std::move(camera));
    }
    if (!scene.camera && !scene.cameras.empty()) scene.camera = scene.cameras.front();
}

}  // namespace lancer
