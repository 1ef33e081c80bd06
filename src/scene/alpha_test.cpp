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
    if (!scene.traits[material].has_holes()) return false;  // another sphere or plane has
    ShadingPoint point{.textures = scene.textures.data()};
    if (scene.traits[material].opacity.texture != no_texture)
        point.uv = hit.kind == Kind::triangle ? texture_uv(scene.shading[hit.geometry], hit.primitive, hit.uv)
                                              : surface_at(scene, ray, hit).uv;
    const float opacity = opacity_at(scene, material, point);
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
        if (!s.uses(has_holes)) continue;
        meshes = true;
        ask.resize(scene.geometry.meshes[i].triangles.size());
        for (uint32_t t = 0; t < ask.size(); ++t) ask[t] = has_holes(s.material_of(t)) ? 1 : 0;
    }
    if (alpha_test.spheres || alpha_test.planes || meshes) {
        alpha_test.passes_through = passes_through;
        alpha_test.context = &scene;
    }
    scene.geometry.alpha_test = std::move(alpha_test);
}

float opacity_at(const Scene& scene, uint32_t material, const ShadingPoint& point)
{
    const FloatParam& opacity = scene.traits[material].opacity;
    if (opacity.texture == no_texture) return std::clamp(opacity.value, 0.0f, 1.0f);
    return std::clamp(point.finest().eval(opacity), 0.0f, 1.0f);
}

}  // namespace lancer
