// What an integrator sees of a scene. It does not contain the accelerator: integrators request rays through
// PathActions.
#pragma once

#include <optional>
#include <span>
#include <utility>

#include "core/sampler.h"
#include "integrators/path/sampling_plan.h"
#include "integrators/path_actions.h"
#include "materials/material.h"
#include "scene/scene.h"
#include "scene/surface.h"

namespace lancer {

struct View {
    const Scene& scene;
    const SamplingPlan& plan;

    Surface surface_at(const Ray& ray, const Hit& hit, RayCone cone) const
    {
        return lancer::surface_at(scene, ray, hit, cone);
    }
    Surface surface_at(const Ray& ray, const Hit& hit, RayCone cone, const TriangleInteraction& place) const
    {
        return lancer::surface_at(scene, ray, hit, cone, place);
    }
    // See scene/triangle_interaction.h.
    void triangle_interactions(std::span<const Ray> rays, std::span<const Hit> hits,
                               std::span<TriangleInteraction> interactions) const
    {
        lancer::triangle_interactions(scene, rays, hits, interactions);
    }

    // Calls f with the concrete BSDF of the point, so that its functions are inlined: the one dispatch per hit. Of a
    // mix, a random number selects the material.
    template <class F>
    auto with_bsdf(const Surface& s, const Sampler& sampler, uint32_t bounce, F&& f) const
    {
        return with_bsdf(
            s, [&] { return sampler.get1(bounce, Dim::mix); }, std::forward<F>(f));
    }
    // The same; number() returns that random number in [0, 1).
    template <class Number, class F>
    auto with_bsdf(const Surface& s, const Number& number, F&& f) const
    {
        uint32_t id = s.material;
        if (is_mix(id)) id = scene.scattering_material(id, scene.shading_point(s), number());
        return std::visit([&](const auto& material) { return f(bsdf_at(material, s)); }, scene.materials[id]);
    }
    // The same with a given ShadingPoint.
    template <class Number, class F>
    auto with_bsdf(uint32_t id, const ShadingPoint& p, const Number& number, F&& f) const
    {
        if (is_mix(id)) id = scene.scattering_material(id, p, number());
        return std::visit([&](const auto& material) { return f(material.at(p)); }, scene.materials[id]);
    }
    bool is_mix(uint32_t material) const { return !scene.mix_of.empty() && scene.mix_of[material] != Scene::none; }
    template <class Material>
    auto bsdf_at(const Material& material, const Surface& s) const
    {
        return material.at(scene.shading_point(s));
    }
    // A Lambertian surface without textures needs no ShadingPoint.
    LambertBsdf bsdf_at(const Lambert& lambert, const Surface& s) const
    {
        if (lambert.albedo.texture != no_texture) [[unlikely]]
            return {textured_albedo(lambert, s)};
        return {lambert.albedo.value * s.vertex_color};
    }
    // The albedo of a Lambertian surface without textures that is no mix; else nothing.
    std::optional<Color> plain_albedo(const Surface& s) const
    {
        if (is_mix(s.material)) return {};
        const Lambert* const matt = std::get_if<Lambert>(&scene.materials[s.material]);
        if (!matt || matt->albedo.texture != no_texture) return {};
        return matt->albedo.value * s.vertex_color;
    }
    // Not inlined, so that surfaces without textures do not pay for its stack frame.
    [[gnu::noinline]] Color textured_albedo(const Lambert& lambert, const Surface& s) const
    {
        return lambert.at(scene.shading_point(s)).albedo;
    }
    // Phong parameters of the point for the classic integrators, mixed for mixes.
    Phong phong(const Surface& s) const { return scene.phong(s.material, scene.shading_point(s)); }
    Color emission(const Surface& s) const
    {
        const Emission& e = scene.emission[s.material];
        if (e.is_dark()) return {};
        if (e.radiance.texture != no_texture) [[unlikely]]
            return textured_emission(e, s);
        return e.plain_towards(s.front);
    }
    [[gnu::noinline]] Color textured_emission(const Emission& e, const Surface& s) const
    {
        return e.towards(s.front, scene.shading_point(s));
    }
    // Radiance of the environment in direction `dir`, as light sampling sees it.
    Color environment(Vec3 dir) const { return scene.radiance_from(dir); }
    // The same for rays from the camera and from mirrors, which light sampling does not cover: filtered, and with the
    // glow of lights.
    Color background(const Ray& ray, RayCone cone) const { return scene.radiance_seen(ray, cone); }

    // Samples a light as seen from `from`; nothing if no light can be sampled there. through: also lights behind the
    // surface. cell: light_cell(from).
    std::optional<LightSample> sample_light(const Surface& from, const Sampler& sampler, uint32_t bounce, bool through,
                                            uint32_t cell) const
    {
        if (scene.lights.pick.empty()) return {};
        const Vec2 u = sampler.get2(bounce, Dim::light);
        const auto pick = [&] { return sampler.get1(bounce, Dim::light); };
        if (plan.light_choice.chooses()) {
            const auto [option, probability] = plan.light_choice.choose(cell, pick());
            return sample_option(from, option, probability, u, through, cell);
        }
        return sample_light_by_power(from, pick, u, through);
    }
    // The same without LightChoice. pick(): a number in [0, 1) that selects the light, unless u does.
    template <class Pick>
    std::optional<LightSample> sample_light_by_power(const Surface& from, const Pick& pick, Vec2 u, bool through) const
    {
        const Discrete& lights = scene.lights.pick;
        if (!lights.can_remap()) return lancer::sample_light(scene, from, pick(), u, through);
        const Discrete::Remapped s = lights.sample_remapped(u.x);
        return sample_chosen_light(scene, from, s.index, {s.u, u.y}, through);
    }
    // Samples what LightChoice chose with the given probability.
    std::optional<LightSample> sample_option(const Surface& from, uint32_t option, float probability, Vec2 u,
                                             bool through, uint32_t cell) const
    {
        const bool is_tile = plan.light_choice.is_tile(option);
        if (!is_tile && !(plan.light_choice.has_tiles && option == scene.environment_light))
            return sample_chosen_light(scene, from, option, probability, u, through);
        std::optional<LightSample> s =
            is_tile ? sample_sky(scene, from, SkyTiles::sample(option - plan.light_choice.lights, u), through)
                    : sample_given_light(scene, from, option, u, through);
        if (!s) return s;
        s->pdf = s->pdf * choice_of_sky(cell) + plan.light_choice.pdf_of_tiles(cell, s->wi);
        if (!(s->pdf > 0)) s.reset();
        return s;
    }
    // Probability that LightChoice chooses the whole sky, not a tile of it; only if it chooses.
    float choice_of_sky(uint32_t cell) const
    {
        const uint32_t sky = scene.environment_light;
        return sky == Scene::none ? 0 : plan.light_choice.probability(cell, sky);
    }
    // See LightChoice.
    uint32_t light_cell(const Surface& surface) const
    {
        return plan.light_choice.empty() ? 0 : plan.light_choice.cell_of(surface.origin, surface.n);
    }
    // Probability of light sampling.
    float light_rate(uint32_t cell) const { return plan.light_choice.empty() ? 1 : plan.light_choice.rate(cell); }
    // Whether the only light is the constant environment as a whole, as BSDF sampling by the cosine finds it as well.
    bool leaves_sky_to_cosine() const { return scene.has_constant_environment() && !plan.light_choice.has_tiles; }
    // Number of point and directional lights, and light i of these as sample_light() returns it, without the
    // probability of its selection.
    uint32_t delta_lights() const { return scene.lights.deltas; }
    std::optional<LightSample> delta_light(const Surface& from, uint32_t i) const
    {
        return sample_given_light(scene, from, i, {});
    }
    // Samples one of the other lights.
    std::optional<LightSample> sample_extended_light(const Surface& from, const Sampler& sampler, uint32_t bounce) const
    {
        return lancer::sample_extended_light(scene, from, sampler.get1(bounce, Dim::light),
                                             sampler.get2(bounce, Dim::light));
    }
    // Density of sample_extended_light() for a direction to the environment.
    float pdf_extended_environment(Vec3 normal, Vec3 wi) const
    {
        const float pdf = lancer::pdf_environment(scene, normal, wi);
        return pdf > 0 ? pdf / static_cast<float>(scene.lights.pick.share_from(scene.lights.deltas)) : 0;
    }
    bool has_media() const { return !scene.media.empty(); }
    // Whether a vertex of that normal is one where a medium scattered. The wide kernel keeps no normals that it can do
    // without, but has no media.
    bool is_of_medium(Vec3 normal) const { return scene.scatters && normal == Vec3{}; }
    // Ray::key for the stochastic alpha test; 0 in scenes without cut-outs.
    uint32_t alpha_key(const Sampler& sampler, uint32_t bounce, Dim dim) const
    {
        return scene.geometry.alpha_test.passes_through ? hash_alpha_key(sampler, bounce, dim) : 0;
    }
    // Sets Ray::key of a new ray; scenes without cut-outs pay one test.
    void set_alpha_key(Ray& ray, const Sampler& sampler, uint32_t bounce, Dim dim) const
    {
        if (scene.geometry.alpha_test.passes_through) [[unlikely]]
            ray.key = hash_alpha_key(sampler, bounce, dim);
    }
    // Not inlined: the hash would be repeated in the kernel for each kind of ray.
    [[gnu::noinline]] static uint32_t hash_alpha_key(const Sampler& sampler, uint32_t bounce, Dim dim)
    {
        return sampler.key(bounce, dim);
    }
    // Samples a light as seen from a place in a medium, whose choice LightChoice does not know.
    std::optional<LightSample> sample_light_in_medium(Vec3 place, const Sampler& sampler, uint32_t bounce) const
    {
        return lancer::sample_light_from(scene, place, sampler.get1(bounce, Dim::light),
                                         sampler.get2(bounce, Dim::light));
    }
    // Density with which sample_light() finds what a ray hits; from a place in a medium, whose normal is 0, with which
    // sample_light_in_medium() does. cell: light_cell() of the surface that it left.
    float pdf_light(Vec3 from, Vec3 normal, Vec3 wi, const Surface& at, uint32_t cell) const
    {
        if (at.light == Scene::none) return 0;
        if (plan.light_choice.chooses() && !is_of_medium(normal))
            return lancer::pdf_light(scene, from, wi, at, plan.light_choice.probability(cell, at.light));
        return lancer::pdf_light(scene, from, normal, wi, at);
    }
    // The same by way of a mirror, if s.mirror_distance > 0: seen from the image of the last vertex behind it.
    float pdf_mirrored_light(const PathState& s, const Surface& at) const
    {
        const Vec3 image = s.ray.org - s.ray.dir * s.mirror_distance;
        return lancer::pdf_light(scene, image, s.normal, s.ray.dir, at) / static_cast<float>(scene.mirrors.size());
    }
    // The same of a ray that leaves the scene.
    float pdf_environment(Vec3 normal, Vec3 wi, uint32_t cell) const
    {
        const LightChoice& choice = plan.light_choice;
        if (!choice.chooses() || is_of_medium(normal)) return lancer::pdf_environment(scene, normal, wi);
        const float whole = choice_of_sky(cell);
        return (whole > 0 ? lancer::pdf_environment(scene, normal, wi, whole) : 0) + choice.pdf_of_tiles(cell, wi);
    }
};

}  // namespace lancer
