#include "scene/diffuse_scene.h"

#include <algorithm>

namespace lancer {
namespace {

using Row = DiffuseScene::Row;

bool is_plain(const Scene& scene)
{
    const Geometry& g = scene.geometry;
    return g.spheres.empty() && g.planes.empty() && g.instances.empty() && !g.holes.let_pass && scene.mixes.empty() &&
           scene.media.empty() && !scene.environment_map && !scene.background && !scene.glow && !scene.legacy &&
           !scene.terminator_fix;
}

bool is_plain(const Scene& scene, uint32_t material)
{
    const auto* lambert = std::get_if<Lambert>(&scene.materials[material]);
    const MaterialTraits& traits = scene.traits[material];
    return lambert && lambert->albedo.texture == no_texture && !traits.tilts() && !traits.has_holes() &&
           scene.emission[material].radiance.texture == no_texture;
}

// Whether all lights are flat triangles, or the sky is the only one.
bool has_plain_lights(const Scene& scene)
{
    const std::vector<Light>& lights = scene.lights.lights;
    if (lights.size() == 1 && std::holds_alternative<EnvironmentLight>(lights[0])) return true;
    return std::all_of(lights.begin(), lights.end(), [](const Light& light) {
        const auto* triangle = std::get_if<TriangleLight>(&light);
        return triangle && triangle->area > 0;
    });
}

Row row(Vec3 v, float w = 0) { return {v.x, v.y, v.z, w}; }
Row row(Color c, float w = 0) { return {c.r, c.g, c.b, w}; }

DiffuseScene::Light table_of(const Scene& scene, uint32_t id)
{
    const auto& light = std::get<TriangleLight>(scene.lights.lights[id]);
    const Mesh& mesh = scene.geometry.meshes[light.mesh];
    const auto& corners = mesh.triangles[light.triangle];
    const Emission& emission = scene.emission[scene.shading[light.mesh].material_of(light.triangle)];
    return {row(mesh.positions[corners[0]]),
            row(mesh.positions[corners[1]]),
            row(mesh.positions[corners[2]]),
            row(light.n, light.area),
            row(emission.towards(true), scene.lights.pick.probability(id)),
            row(emission.towards(false))};
}

}  // namespace

std::optional<DiffuseScene> DiffuseScene::of(const Scene& scene)
{
    if (!is_plain(scene) || !has_plain_lights(scene)) return {};
    for (const MeshShading& mesh : scene.shading) {
        if (!mesh.colors.empty()) return {};
        if (mesh.face_material.empty() && !is_plain(scene, mesh.material)) return {};
        std::vector<bool> seen(scene.materials.size());
        for (const uint32_t material : mesh.face_material) {
            if (seen[material]) continue;
            if (!is_plain(scene, material)) return {};
            seen[material] = true;
        }
    }
    DiffuseScene d;
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        const auto* lambert = std::get_if<Lambert>(&scene.materials[i]);
        d.albedo.push_back(row(lambert ? lambert->albedo.value : Color{}));
        d.shines.push_back(!scene.emission[i].is_dark());
    }
    if (scene.environment_light == Scene::none)
        for (uint32_t id = 0; id < scene.lights.lights.size(); ++id) d.lights.push_back(table_of(scene, id));
    return d;
}

}  // namespace lancer
