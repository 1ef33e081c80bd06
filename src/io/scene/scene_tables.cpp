#include "io/scene/scene_tables.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "io/file_name.h"
#include "io/scene/background_tables.h"
#include "io/scene/camera_tables.h"
#include "io/scene/fog_table.h"
#include "io/scene/light_tables.h"
#include "io/scene/material_tables.h"
#include "io/scene/output_table.h"
#include "io/scene/render_table.h"
#include "io/scene/shape_tables.h"
#include "scene/description/presets.h"

namespace lancer {
namespace {

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
    void read_mesh(const TomlTable& table);
    void read_instance(const TomlTable& table);
    void read_sphere(const TomlTable& table);
    TransformDescription read_transform(const TomlTable& table);
    void check_uses(const std::vector<NameUse>& uses, const NameList& known, const std::string& what,
                    const std::string& none = "");
};

void SceneReader::read_version()
{
    const std::optional<int64_t> version = root_.integer("version", INT64_MIN, INT64_MAX);
    if (version && *version != 1) {
        root_.error(root_.where("version"),
                    "version " + std::to_string(*version) + " of scene files is unknown; known: 1");
    }
}

TransformDescription SceneReader::read_transform(const TomlTable& table)
{
    TransformDescription transform;
    transform.translate = table.vector("translate").value_or(transform.translate);
    transform.rotate_deg = table.vector("rotate").value_or(transform.rotate_deg);
    transform.scale = table.number_or_vector("scale", not_zero).value_or(transform.scale);
    return transform;
}

// An angle, or "off".
std::optional<Smoothing> read_smoothing(const TomlTable& table)
{
    if (table.holds_text("smooth") && table.choice("smooth", {"off"}, 1) == 0)
        return Smoothing{.faces = Smoothing::Faces::none};
    const std::optional<double> deg = table.holds_text("smooth") ? std::nullopt : table.number("smooth", 0, 180);
    if (!deg) return {};
    return Smoothing{.faces = Smoothing::Faces::all, .largest_deg = *deg};
}

constexpr int64_t most_levels_of_catmull_clark = 8;

// A level alone is that of all triangles; with an edge it is a bound.
SubdivisionDescription read_subdivision(const TomlTable& table)
{
    SubdivisionDescription s;
    const std::optional<double> edge = table.number("subdivision_edge", above_zero);
    const std::optional<int64_t> level = table.integer("subdivision_level", 0, SubdivisionDescription::most_levels);
    s.is_asked = edge || level;
    if (level) s.level = static_cast<uint32_t>(*level);
    s.edge_pixels = edge ? *edge : level ? 0 : s.edge_pixels;
    return s;
}

void SceneReader::read_mesh(const TomlTable& table)
{
    table.allow({"name", "file", "material", "vertex_colors", "smooth", "catmull_clark", "subdivision_edge",
                 "subdivision_level", "translate", "rotate", "scale"});
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
    mesh.material = read_material_use(table, material_uses_);
    const auto colors = table.choice("vertex_colors", {"srgb", "linear", "none"}, 0);
    mesh.subdivision = read_subdivision(table);
    mesh.transform = read_transform(table);
    scene_.meshes.push_back(std::move(mesh));

    MeshFile& mesh_file = mesh_files_.emplace_back();
    const std::optional<std::string> name = table.require("file") ? table.text("file") : std::nullopt;
    const VertexColors usual = name && is_gltf(*name) ? VertexColors::linear : VertexColors::srgb;
    scene_.meshes.back().vertex_colors =
        table.has("vertex_colors") ? static_cast<VertexColors>(colors.value_or(0)) : usual;
    if (!name) return;
    const auto levels =
        static_cast<uint32_t>(table.integer("catmull_clark", 0, most_levels_of_catmull_clark).value_or(0));
    const AssetFolder::Found found = assets_.find(*name);
    if (found.problem.empty()) {
        mesh_file = {table.where("file"), found, read_smoothing(table), levels};
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
    sphere.material = read_material_use(table, material_uses_);
    scene_.spheres.push_back(std::move(sphere));
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
    root_.allow({"version", "render", "camera", "mesh", "instance", "sphere", "plane", "water", "bubble", "triangle",
                 "pyramid", "light", "background", "fog", "material", "material_override", "texture", "output",
                 "animation"});
    read_version();
    if (const std::optional<TomlTable> render = root_.table("render")) scene_.render = read_render_table(*render);
    if (const std::optional<TomlTable> output = root_.table("output")) read_output_table(*output);  // for its mistakes
    read_cameras(root_, scene_);
    material_uses_ = read_materials(root_, assets_, scene_);
    for (const TomlTable& mesh : root_.tables("mesh")) read_mesh(mesh);
    for (const TomlTable& instance : root_.tables("instance")) read_instance(instance);
    for (const TomlTable& sphere : root_.tables("sphere")) read_sphere(sphere);
    for (NameUse& use : read_shapes(root_, scene_)) material_uses_.push_back(std::move(use));
    for (const TomlTable& light : root_.tables("light")) scene_.lights.push_back(read_light(light, assets_));
    read_background(root_, assets_, scene_);
    if (const std::optional<TomlTable> fog = root_.table("fog")) scene_.fog = read_fog(*fog);

    NameList meshes;
    for (const MeshDescription& mesh : scene_.meshes) {
        if (!mesh.name.empty()) meshes.push_back(mesh.name);
    }
    check_uses(material_uses_, names_of_materials(scene_), "material");
    check_uses(mesh_uses_, meshes, "mesh", "the file has no [[mesh]] with a name");
    return std::move(mesh_files_);
}

}  // namespace

std::vector<MeshFile> read_scene_tables(const TomlTable& root, const AssetFolder& assets, SceneDescription& scene)
{
    return SceneReader(root, assets, scene).read();
}

}  // namespace lancer
