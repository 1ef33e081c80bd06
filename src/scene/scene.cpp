#include "scene/scene.h"

#include <algorithm>

#include "materials/material.h"
#include "scene/build/scene_builder.h"
#include "scene/environment/background.h"
#include "scene/environment/environment.h"

namespace lancer {

Scene::Scene() = default;
Scene::Scene(const Scene&) = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(const Scene&) = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

SceneBuilder Scene::begin(const SceneDescription& description, const RenderSettings& settings, Diagnostics& diagnostics,
                          const RasterSource& images)
{
    return {description, settings, diagnostics, images};
}

Scene Scene::build(const SceneDescription& description, const RenderSettings& settings, Diagnostics& diagnostics,
                   const RasterSource& images)
{
    return begin(description, settings, diagnostics, images).finish_by_value(diagnostics);
}

MaterialType Scene::type_of(uint32_t material) const
{
    return std::visit([](const auto& m) { return m.type; }, materials[material]);
}

bool Scene::lets_through(uint32_t material) const
{
    const Material& any = materials[material];
    const Principled* const principled = std::get_if<Principled>(&any);
    return std::holds_alternative<Glass>(any) || std::holds_alternative<Interface>(any) ||
           (principled && principled->transmission.value > 0);
}

bool Scene::lets_through() const
{
    for (uint32_t i = 0; i < materials.size(); ++i)
        if (lets_through(i)) return true;
    return false;
}

bool Scene::has_emitters() const
{
    return !delta_lights.empty() ||
           std::any_of(emission.begin(), emission.end(), [](const Emission& e) { return !e.is_dark(); });
}

bool Scene::catches_shadows() const
{
    return std::any_of(traits.begin(), traits.end(), [](const MaterialTraits& t) { return t.catches_shadows; });
}

Color Scene::radiance_from(Vec3 dir) const
{
    const Color c = environment_map ? environment_map->eval(dir) : environment;
    return background ? c + background->eval(dir) : c;
}

Color Scene::radiance_seen(const Ray& ray, RayCone cone) const
{
    Color c = environment_map ? environment_map->eval(ray.dir) : environment;
    if (background) c += background->eval(ray.dir, cone.spread);
    if (glow) c += glow_of_lights(*this, ray.org, ray.dir);
    return c;
}

ShadingPoint Scene::shading_point(const Surface& s) const
{
    return {.front = s.front,
            .uv = s.uv,
            .uv_width = s.uv_width,
            .uv_along = s.uv_along,
            .textures = textures.data(),
            .vertex_color = s.vertex_color,
            .eta = s.eta,
            .tangent = s.tangent,
            .second_uv_width = s.second_uv_width,
            .second_uv = s.second_uv};
}

uint32_t Scene::scattering_material(uint32_t material, const ShadingPoint& point, float u) const
{
    while (!mix_of.empty() && mix_of[material] != none) {
        const Mix& mix = mixes[mix_of[material]];
        const float w = std::clamp(point.eval(mix.weight), 0.0f, 1.0f);
        const bool second = u < w;
        // What is left of u decides among the parts of a part.
        u = std::min(second ? u / w : (u - w) / (1 - w), 1 - 0x1p-24f);
        material = second ? mix.second : mix.first;
    }
    return material;
}

Phong Scene::phong(uint32_t material, const ShadingPoint& point) const
{
    if (!mix_of.empty() && mix_of[material] != none) {
        const Mix& m = mixes[mix_of[material]];
        return mix(std::clamp(point.eval(m.weight), 0.0f, 1.0f), phong(m.first, point), phong(m.second, point));
    }
    return std::visit([&](const auto& m) { return m.phong(point); }, materials[material]);
}

uint64_t Scene::triangle_count() const
{
    uint64_t n = 0;
    for (const Mesh& m : geometry.meshes) n += m.triangles.size();
    return n;
}

uint8_t Scene::group_of_light(uint32_t light) const
{
    if (light == none) return light_groups.of_sky;
    const auto of_material = [&](uint32_t material) { return light_groups.of_material[material]; };
    return std::visit(
        [&]<class L>(const L& l) {
            if constexpr (is_delta_light<L>)
                return light_groups.of_delta[light];
            else if constexpr (std::is_same_v<L, SphereLight>)
                return of_material(sphere_material[l.sphere]);
            else if constexpr (std::is_same_v<L, TriangleLight>)
                return of_material(shading[l.mesh].material_of(l.triangle));
            else
                return light_groups.of_sky;
        },
        lights.lights[light]);
}

}  // namespace lancer
