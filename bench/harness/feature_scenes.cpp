#include "harness/feature_scenes.h"

#include <algorithm>

#include "harness/generate.h"
#include "harness/meshes.h"
#include "render/aov.h"

namespace lancer::bench {
namespace {

MaterialDescription lambert(const std::string& name, Color albedo)
{
    MaterialDescription m;
    m.name = name, m.base_color = albedo;
    return m;
}

// Behind a wall, and small.
const Vec3d behind{0, 0, -1.01};

MeshDescription speck(const MaterialDescription& material, bool smooth = false)
{
    MeshData data;
    data.positions = {behind, behind + Vec3d{1e-3, 0, 0}, behind + Vec3d{0, 1e-3, 0}};
    data.triangles = data.uv_triangles = {{0, 1, 2}};
    data.uvs = {{0, 0}, {1, 0}, {0, 1}};
    if (smooth) data.normals = {{0, 0, 1}, {0.1f, 0, 0.99f}, {0, 0.1f, 0.99f}}, data.normal_triangles = data.triangles;
    data.materials = {material};
    MeshDescription mesh;
    mesh.data = std::make_shared<const MeshData>(std::move(data));
    return mesh;
}
void add_speck(SceneDescription& d, const std::function<void(MaterialDescription&)>& change)
{
    MaterialDescription m = lambert("speck", {0.5f, 0.5f, 0.5f});
    change(m);
    d.meshes.push_back(speck(m));
}
TextureUse texture(TextureType type)
{
    TextureDescription t;
    t.type = type;
    t.waves = {{0.01, 0.3, 0.2, 0}};
    return t;
}
// So dim that it is in every table and never chosen.
void add_light(SceneDescription& d, LightType type)
{
    LightDescription l;
    l.type = type, l.position = behind - Vec3d{0, 0, 0.01}, l.radius = 1e-3, l.power = {1e-20f, 1e-20f, 1e-20f};
    d.lights.push_back(l);
}

}  // namespace

Base make_base(const std::string& name, uint64_t triangles)
{
    MeshData room = *make_room(std::max<uint64_t>(triangles, 40'000));
    if (triangles == 0) room.triangles.resize(12);  // its walls
    room.materials = {lambert("wall", {0.7f, 0.7f, 0.7f})};
    MeshData panel;
    panel.positions = {{-0.4, 0.98, -0.4}, {0.4, 0.98, -0.4}, {0.4, 0.98, 0.4}, {-0.4, 0.98, 0.4}};
    panel.triangles = {{0, 1, 2}, {0, 2, 3}};
    panel.materials = {lambert("panel", {})};
    panel.materials[0].emission = {8, 8, 8};
    SceneDescription d;
    for (MeshData* mesh : {&room, &panel})
        d.meshes.emplace_back().data = std::make_shared<const MeshData>(std::move(*mesh));
    d.camera = camera_at({0.1, 0.2, 0.95}, {0, 0, 0}, 70);
    return {name, std::move(d)};
}

std::vector<Feature> features()
{
    const auto scene = [](auto f) { return [f](SceneDescription& d, RenderSettings&, Film&) { f(d); }; };
    const auto material = [&](MaterialType type, float roughness = 0) {
        return scene([=](SceneDescription& d) {
            add_speck(d, [=](MaterialDescription& m) { m.type = type, m.roughness = roughness; });
        });
    };
    const auto light = [&](LightType type) { return scene([=](SceneDescription& d) { add_light(d, type); }); };
    const auto worn = [&](auto change) { return scene([=](SceneDescription& d) { add_speck(d, change); }); };
    return {
        {"textures", worn([](MaterialDescription& m) { m.base_color_map = texture(TextureType::checker); })},
        {"bump maps", worn([](MaterialDescription& m) { m.bump_map = texture(TextureType::waves); })},
        {"normal maps", worn([](MaterialDescription& m) { m.normal_map = texture(TextureType::checker); })},
        {"cut-outs", worn([](MaterialDescription& m) { m.opacity = 0.5f; })},
        {"vertex normals", scene([](SceneDescription& d) {
             d.meshes.push_back(speck(lambert("speck", {1, 1, 1}), true));
         })},
        {"spheres", scene([](SceneDescription& d) {
             SphereDescription& sphere = d.spheres.emplace_back();
             sphere.center = behind, sphere.radius = 1e-3;
         })},
        {"planes", scene([](SceneDescription& d) {
             PlaneDescription& plane = d.planes.emplace_back();
             plane.point = behind, plane.normal = {0, 0, 1};
         })},
        {"instances", scene([](SceneDescription& d) {
             d.meshes.push_back(speck(lambert("speck", {1, 1, 1})));
             d.meshes.back().name = "speck";
             d.instances.emplace_back().mesh = "speck";
         })},
        {"media", worn([](MaterialDescription& m) {
             m.type = MaterialType::glass, m.absorption = {1, 1, 1};
         })},
        {"scattering", worn([](MaterialDescription& m) {
             m.type = MaterialType::glass, m.scattering = {1, 1, 1};
         })},
        {"mirror", material(MaterialType::mirror)},
        {"metal", material(MaterialType::metal, 0.3f)},
        {"glass", material(MaterialType::glass)},
        {"plastic", material(MaterialType::plastic, 0.3f)},
        {"interface", material(MaterialType::interface)},
        {"mixes", scene([](SceneDescription& d) {
             MaterialDescription mix = lambert("mix", {});
             mix.type = MaterialType::mix, mix.first = "a", mix.second = "b";
             d.materials.insert(d.materials.end(), {lambert("a", {1, 1, 1}), lambert("b", {0, 0, 0}), mix});
             d.meshes.push_back(speck(lambert("", {})));
             d.meshes.back().material = "mix";
         })},
        {"point lights", light(LightType::point)},
        {"directional lights", light(LightType::directional)},
        {"sphere lights", light(LightType::sphere)},
        {"constant environment", light(LightType::environment)},
        {"thin lens",
         scene([](SceneDescription& d) { d.camera->type = CameraType::thin_lens, d.camera->aperture = 1e-9; })},
        {"wide filter", [](SceneDescription&, RenderSettings& p,
                           Film&) { p.give(&RenderSettings::filter, FilterKind::blackman_harris); }},
        {"AOVs", [](SceneDescription&, RenderSettings&, Film& f) { f.keep_aovs(layout_of(all_aovs())); }},
        {"replicates",
         [](SceneDescription&, RenderSettings& p, Film& f) {
             p.give(&RenderSettings::replicates, 4);
             f.replicates.resize(4 * f.pixels.size());
         }},
    };
}

}  // namespace lancer::bench
