#include "scene/alpha_test.h"

#include <algorithm>

#include "core/hash.h"
#include "scene/scene.h"

namespace lancer {
namespace {

// In [0, 1), of 24 bits: a number for each side of each surface that a ray meets.
float number_of(uint32_t key, const Hit& hit)
{
    const uint64_t which = static_cast<uint64_t>(hit.kind) << 1 | (hit.exit ? 1u : 0u);
    const uint64_t surface = mix_bits((uint64_t{hit.instance} << 32 | hit.geometry) + (which << 61));
    return static_cast<float>(mix_bits(surface ^ (uint64_t{key} << 32 | hit.primitive)) >> 40) * 0x1p-24f;
}

bool passes_through(const void* context, const Ray& ray, const Hit& hit)
{
    const Scene& scene = *static_cast<const Scene*>(context);
    const uint32_t material = scene.material_of(hit);
    const std::vector<float>* const alphas = hit.kind == Kind::triangle ? &scene.shading[hit.geometry].alphas : nullptr;
    const bool has_alphas = alphas && !alphas->empty();
    if (!scene.traits[material].has_holes() && !has_alphas) return false;  // another sphere or plane has
    ShadingPoint point{.textures = scene.textures.data()};
    if (scene.traits[material].opacity.texture != no_texture) {
        if (hit.kind == Kind::triangle) {
            const UvSets uvs = texture_uvs(scene.shading[hit.geometry], hit.primitive, hit.uv);
            point.uv = uvs.first, point.second_uv = uvs.second;
        } else {
            const Surface surface = surface_at(scene, ray, hit);
            point.uv = surface.uv, point.second_uv = surface.second_uv;
        }
    }
    float opacity = opacity_at(scene, material, point);
    if (has_alphas) opacity *= vertex_alpha(scene, hit.geometry, hit.primitive, hit.uv);
    if (opacity <= 0 || opacity >= 1) return opacity <= 0;
    return number_of(ray.key, hit) >= opacity;
}

}  // namespace

void bind_alpha_test(Scene& scene)
{
    const auto has_holes = [&](uint32_t material) { return scene.traits[material].has_holes(); };
    const auto any = [&](const std::vector<uint32_t>& materials) {
        return std::any_of(materials.begin(), materials.end(), has_holes);
    };
    AlphaTest alpha_test;
    alpha_test.spheres = any(scene.sphere_material);
    alpha_test.planes = any(scene.plane_material);
    bool meshes = false;
    for (size_t i = 0; i < scene.shading.size(); ++i) {
        const MeshShading& s = scene.shading[i];
        std::vector<uint8_t>& ask = alpha_test.meshes.emplace_back();
        if (!s.uses(has_holes) && s.alphas.empty()) continue;
        meshes = true;
        const Mesh& mesh = scene.geometry.meshes[i];
        const auto is_clear = [&](uint32_t corner) { return s.alphas[corner / mesh.rows] < 1; };
        ask.resize(mesh.triangles.size());
        for (uint32_t t = 0; t < ask.size(); ++t) {
            const auto& corners = mesh.triangles[t];
            const bool fades = !s.alphas.empty() && std::any_of(corners.begin(), corners.end(), is_clear);
            ask[t] = fades || has_holes(s.material_of(t)) ? 1 : 0;
        }
    }
    if (alpha_test.spheres || alpha_test.planes || meshes) {
        alpha_test.passes_through = passes_through;
        alpha_test.context = &scene;
    }
    scene.geometry.alpha_test = std::move(alpha_test);
}

float vertex_alpha(const Scene& scene, uint32_t mesh_index, uint32_t triangle, Vec2 uv)
{
    const std::vector<float>& alphas = scene.shading[mesh_index].alphas;
    if (alphas.empty()) return 1;
    const Mesh& mesh = scene.geometry.meshes[mesh_index];
    const auto alpha = [&](size_t k) { return alphas[mesh.triangles[triangle][k] / mesh.rows]; };
    return alpha(0) * std::max(0.0f, first_weight(uv)) + alpha(1) * uv.x + alpha(2) * uv.y;
}

float opacity_at(const Scene& scene, uint32_t material, const ShadingPoint& point)
{
    const FloatParam& opacity = scene.traits[material].opacity;
    if (opacity.texture == no_texture) return std::clamp(opacity.value, 0.0f, 1.0f);
    return std::clamp(point.finest().eval(opacity), 0.0f, 1.0f);
}

}  // namespace lancer
