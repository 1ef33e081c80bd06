#include "io/scene_tables.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace lancer {
namespace {

constexpr int64_t max_int = 2147483647;

// A key that only some types of a thing have.
struct TypedKey {
    std::string_view key;
    NameList types;
};

std::string join(const NameList& names, const std::string& between)
{
    std::string text;
    for (const std::string_view name : names) text += (text.empty() ? "" : between) + in_quotes(name);
    return text;
}

void reject_keys_of_other_types(const TomlTable& table, std::string_view type, const std::vector<TypedKey>& keys)
{
    for (const auto& [key, types] : keys) {
        if (!table.has(key) || std::find(types.begin(), types.end(), type) != types.end()) continue;
        table.error(key, " needs type " + join(types, " or ") + ", not " + in_quotes(type));
    }
}

// References by name are looked up once all names are known.
struct NameUse {
    Location where;
    std::string name;
};

class SceneReader {
public:
    SceneReader(const TomlTable& root, const AssetFolder& assets, SceneDescription& scene)
        : root_(root), assets_(assets), scene_(scene)
    {
    }
    std::vector<MeshFile> read();

private:
    const TomlTable& root_;
    const AssetFolder& assets_;
    SceneDescription& scene_;
    std::vector<MeshFile> mesh_files_;
    std::vector<NameUse> material_uses_, mesh_uses_;
    std::map<std::string, uint32_t> mesh_lines_;  // of the names

    void read_version();
    void read_render(const TomlTable& table);
    void read_camera(const TomlTable& table);
    void read_material(const std::string& name, const TomlTable& table);
    void read_mesh(const TomlTable& table);
    void read_instance(const TomlTable& table);
    void read_sphere(const TomlTable& table);
    void read_plane(const TomlTable& table);
    void read_light(const TomlTable& table);
    TransformDescription read_transform(const TomlTable& table);
    std::string read_material_use(const TomlTable& table);
    void check_uses(const std::vector<NameUse>& uses, const NameList& known, const std::string& what,
                    const std::string& none);
};

void SceneReader::read_version()
{
    const std::optional<int64_t> version = root_.integer("version", INT64_MIN, INT64_MAX);
    if (version && *version != 1) {
        root_.error(root_.where("version"),
                    "version " + std::to_string(*version) + " of scene files is unknown; known: 1");
    }
}

void SceneReader::read_render(const TomlTable& table)
{
    table.allow({"integrator", "spp", "size", "max_depth", "seed", "filter", "sampler"});
    RenderDescription& render = scene_.render;
    render.where = table.where();
    render.integrator = table.text("integrator");
    render.filter = table.text("filter");
    render.sampler = table.text("sampler");
    render.spp = table.integer("spp", 1, max_int);
    render.max_depth = table.integer("max_depth", 0, max_int);
    render.seed = table.integer("seed", 0, INT64_MAX);
    render.size = table.size("size");
}

// Whether no plane is spanned by the two, up to what is left of it in single precision.
bool are_parallel(Vec3d a, Vec3d b)
{
    constexpr double least_sine = 1e-6;
    a /= max_component(abs(a));  // so that no square of a huge or tiny number leaves the range
    b /= max_component(abs(b));
    return length(cross(normalize(a), normalize(b))) < least_sine;
}

void SceneReader::read_camera(const TomlTable& table)
{
    table.allow({"type", "position", "target", "up", "fov", "aperture", "focus"});
    CameraDescription camera;
    camera.where = table.where();
    const NameList types{"pinhole", "thin_lens"};
    if (const std::optional<size_t> type = table.choice("type", types, 0)) {
        camera.type = *type == 0 ? CameraType::pinhole : CameraType::thin_lens;
        reject_keys_of_other_types(table, types[*type], {{"aperture", {"thin_lens"}}, {"focus", {"thin_lens"}}});
    }
    const std::optional<Vec3d> position = table.vector("position"), target = table.vector("target");
    camera.position = position.value_or(camera.position);
    camera.target = target.value_or(camera.target);
    camera.fov_deg = table.number("fov", half_turn).value_or(camera.fov_deg);
    camera.aperture = table.number("aperture", zero_or_more).value_or(camera.aperture);
    camera.focus = table.number("focus", above_zero);

    std::optional<Vec3d> up;
    if (table.holds_text("up")) {
        const std::optional<size_t> axis = table.choice("up", {"y", "z"}, 0);
        if (axis) up = *axis == 0 ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
    } else {
        up = table.vector("up");
    }
    camera.up = up.value_or(camera.up);
    scene_.camera = camera;

    // Where one was given and is wrong, its default must not be blamed as well.
    const bool is_read = (position || !table.has("position")) && (target || !table.has("target"));
    if (!is_read || (table.has("up") && !up)) return;
    const Vec3d view = camera.target - camera.position;
    if (view == Vec3d{}) {
        table.error(table.where(table.has("target") ? "target" : "position"),
                    "'position' and 'target' in [camera] must be different points");
    } else if (!is_finite(view)) {
        table.error(table.where("target"), "'position' and 'target' in [camera] are too far apart");
    } else if (camera.up == Vec3d{}) {
        table.error("up", " must not be the zero vector");
    } else if (are_parallel(view, camera.up)) {
        table.error("up", " must not be parallel to the view, from 'position' to 'target'");
    }
}

void SceneReader::read_material(const std::string& name, const TomlTable& table)
{
    table.allow({"type", "base_color", "ior", "emission", "emission_sides"});
    MaterialDescription material;
    material.name = name;
    material.where = table.where();
    const NameList types{"lambert", "mirror", "glass"};
    if (const std::optional<size_t> type = table.choice("type", types, 0)) {
        material.type = std::array{MaterialType::lambert, MaterialType::mirror, MaterialType::glass}[*type];
        reject_keys_of_other_types(table, types[*type], {{"ior", {"glass"}}});
    }
    // A mirror or glass that nobody tinted loses no light.
    const Color untold = material.type == MaterialType::lambert ? material.base_color : Color{1, 1, 1};
    material.base_color = table.color("base_color", reflectance).value_or(untold);
    material.ior = static_cast<float>(table.number("ior", index_of_refraction).value_or(material.ior));
    material.emission = table.color("emission", brightness).value_or(material.emission);
    material.emission_both_sides = table.choice("emission_sides", {"front", "both"}, 0).value_or(0) == 1;
    scene_.materials.push_back(std::move(material));
}

TransformDescription SceneReader::read_transform(const TomlTable& table)
{
    TransformDescription transform;
    transform.translate = table.vector("translate").value_or(transform.translate);
    transform.rotate_deg = table.vector("rotate").value_or(transform.rotate_deg);
    transform.scale = table.number_or_vector("scale", not_zero).value_or(transform.scale);
    return transform;
}

std::string SceneReader::read_material_use(const TomlTable& table)
{
    const std::optional<std::string> name = table.text("material");
    if (name) material_uses_.push_back({table.where("material"), *name});
    return name.value_or("");
}

void SceneReader::read_mesh(const TomlTable& table)
{
    table.allow({"name", "file", "material", "translate", "rotate", "scale"});
    MeshDescription mesh;
    mesh.where = table.where();
    mesh.name = table.text("name").value_or("");
    if (!mesh.name.empty()) {
        const Location where = table.where("name");
        const auto [first, is_new] = mesh_lines_.try_emplace(mesh.name, where.line);
        if (!is_new) {
            table.error(where, "another [[mesh]] is named " + in_quotes(mesh.name) + " already, in line " +
                                   std::to_string(first->second));
        }
    }
    mesh.material = read_material_use(table);
    mesh.transform = read_transform(table);
    scene_.meshes.push_back(std::move(mesh));

    MeshFile& mesh_file = mesh_files_.emplace_back();
    const std::optional<std::string> name = table.require("file") ? table.text("file") : std::nullopt;
    if (!name) return;
    const AssetFolder::Found found = assets_.find(*name);
    if (found.problem.empty()) {
        mesh_file = {table.where("file"), found};
    } else {
        table.error(table.where("file"), "mesh file " + in_quotes(*name) + " " + found.problem, found.kind);
    }
}

void SceneReader::read_instance(const TomlTable& table)
{
    table.allow({"mesh", "translate", "rotate", "scale"});
    InstanceDescription instance;
    instance.where = table.where();
    if (table.require("mesh")) {
        if (const std::optional<std::string> name = table.text("mesh")) {
            instance.mesh = *name;
            mesh_uses_.push_back({table.where("mesh"), *name});
        }
    }
    instance.transform = read_transform(table);
    scene_.instances.push_back(std::move(instance));
}

void SceneReader::read_sphere(const TomlTable& table)
{
    table.allow({"center", "radius", "material"});
    SphereDescription sphere;
    sphere.where = table.where();
    sphere.center = table.vector("center").value_or(sphere.center);
    sphere.radius = table.number("radius", above_zero).value_or(sphere.radius);
    sphere.material = read_material_use(table);
    scene_.spheres.push_back(std::move(sphere));
}

void SceneReader::read_plane(const TomlTable& table)
{
    table.allow({"point", "normal", "material"});
    PlaneDescription plane;
    plane.where = table.where();
    plane.point = table.vector("point").value_or(plane.point);
    plane.normal = table.vector("normal").value_or(plane.normal);
    const double size = length(plane.normal);
    if (!(size > 0)) table.error("normal", " must not be the zero vector");
    if (std::isinf(size)) table.error("normal", " is too long to be made a unit vector");
    plane.material = read_material_use(table);
    scene_.planes.push_back(std::move(plane));
}

void SceneReader::read_light(const TomlTable& table)
{
    const NameList types{"point", "sphere", "environment"};
    const std::vector<TypedKey> keys{{"position", {"point"}},
                                     {"intensity", {"point"}},
                                     {"center", {"sphere"}},
                                     {"radius", {"sphere"}},
                                     {"radiance", {"sphere", "environment"}}};
    NameList known{"type"};
    for (const TypedKey& k : keys) known.push_back(k.key);
    table.allow(known);

    LightDescription light;
    light.where = table.where();
    const std::optional<size_t> type = table.require("type") ? table.choice("type", types, 0) : std::nullopt;
    if (type) {
        light.type = std::array{LightType::point, LightType::sphere, LightType::environment}[*type];
        reject_keys_of_other_types(table, types[*type], keys);
        for (const auto& [key, owners] : keys) {
            if (std::find(owners.begin(), owners.end(), types[*type]) != owners.end()) table.require(key, types[*type]);
        }
    }
    light.position = table.vector("position").value_or(table.vector("center").value_or(light.position));
    light.radius = table.number("radius", above_zero).value_or(light.radius);
    const std::optional<Color> intensity = table.color("intensity", brightness);
    const std::optional<Color> radiance = table.color("radiance", brightness);
    light.power = intensity.value_or(radiance.value_or(light.power));
    scene_.lights.push_back(light);
}

void SceneReader::check_uses(const std::vector<NameUse>& uses, const NameList& known, const std::string& what,
                             const std::string& none)
{
    NameList sorted = known;
    std::sort(sorted.begin(), sorted.end());
    for (const NameUse& use : uses) {
        if (std::binary_search(sorted.begin(), sorted.end(), std::string_view(use.name))) continue;
        root_.error(use.where, "unknown " + what + " " + in_quotes(use.name) +
                                   (known.empty() ? "; " + none : suggestion(use.name, known)));
    }
}

std::vector<MeshFile> SceneReader::read()
{
    root_.allow({"version", "render", "camera", "mesh", "instance", "sphere", "plane", "light", "material"});
    read_version();
    if (const std::optional<TomlTable> render = root_.table("render")) read_render(*render);
    if (const std::optional<TomlTable> camera = root_.table("camera")) read_camera(*camera);
    for (const auto& [name, material] : root_.named_tables("material")) read_material(name, material);
    for (const TomlTable& mesh : root_.tables("mesh")) read_mesh(mesh);
    for (const TomlTable& instance : root_.tables("instance")) read_instance(instance);
    for (const TomlTable& sphere : root_.tables("sphere")) read_sphere(sphere);
    for (const TomlTable& plane : root_.tables("plane")) read_plane(plane);
    for (const TomlTable& light : root_.tables("light")) read_light(light);

    NameList materials, meshes;
    for (const MaterialDescription& material : scene_.materials) materials.push_back(material.name);
    for (const MeshDescription& mesh : scene_.meshes) {
        if (!mesh.name.empty()) meshes.push_back(mesh.name);
    }
    check_uses(material_uses_, materials, "material", "the file has no [material.NAME]");
    check_uses(mesh_uses_, meshes, "mesh", "the file has no [[mesh]] with a name");
    return std::move(mesh_files_);
}

}  // namespace

std::vector<MeshFile> read_scene_tables(const TomlTable& root, const AssetFolder& assets, SceneDescription& scene)
{
    return SceneReader(root, assets, scene).read();
}

}  // namespace lancer
