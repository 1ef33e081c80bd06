// All that an integrator can see of a scene. No accelerator: rays are asked for through PathActions.
#pragma once

#include <span>
#include <utility>

#include "core/sampler.h"
#include "integrators/path/sampling_plan.h"
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
    void triangle_interactions(std::span<const Hit> hits, std::span<TriangleInteraction> places) const
    {
        lancer::triangle_interactions(scene, hits, places);
    }

    // f gets the concrete BSDF of the place, so that all it calls on it is inlined. The one dispatch per hit. Where
    // the material is a mix, a number of the sampler decides which part it is.
    template <class F>
    auto with_bsdf(const Surface& s, const Sampler& sampler, uint32_t bounce, F&& f) const
    {
        return with_bsdf(
            s, [&] { return sampler.get1(bounce, Dim::mix); }, std::forward<F>(f));
    }
    // The same where number() gives that number, in [0, 1).
    template <class Number, class F>
    auto with_bsdf(const Surface& s, const Number& number, F&& f) const
    {
        uint32_t id = s.material;
        if (is_mix(id)) id = scene.scattering_material(id, scene.shading_point(s), number());
        return std::visit([&](const auto& material) { return f(bsdf_at(material, s)); }, scene.materials[id]);
    }
    // The same where all that is looked up there is known.
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
    // Where nothing is looked up a matt surface wants to know no more of the place.
    LambertBsdf bsdf_at(const Lambert& lambert, const Surface& s) const
    {
        if (lambert.albedo.texture != no_texture) [[unlikely]]
            return {textured_albedo(lambert, s)};
        return {lambert.albedo.value * s.vertex_color};
    }
    // Out of line, so that matt surfaces of one colour do not pay for what looking up wants of the stack.
    [[gnu::noinline]] Color textured_albedo(const Lambert& lambert, const Surface& s) const
    {
        return lambert.at(scene.shading_point(s)).albedo;
    }
    // What the classic integrators see of the place; of a mix, mixed.
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
    // Radiance of a ray that left the scene.
    Color environment(Vec3 dir) const { return scene.radiance_from(dir); }
    // The same for the camera and behind mirrors, where nothing samples it as a light: filtered, and with the glow of
    // lights.
    Color background(const Ray& ray, RayCone cone) const { return scene.radiance_seen(ray, cone); }

    // through: also lights behind the surface.
    std::optional<LightSample> sample_light(const Surface& from, const Sampler& sampler, uint32_t bounce,
                                            bool through) const
    {
        const Discrete& pick = scene.lights.pick;
        if (pick.empty()) return {};
        const Vec2 u = sampler.get2(bounce, Dim::light);
        if (!pick.can_remap()) return lancer::sample_light(scene, from, sampler.get1(bounce, Dim::light), u, through);
        const Discrete::Remapped s = pick.sample_remapped(u.x);
        return sample_chosen_light(scene, from, s.index, {s.u, u.y}, through);
    }
    bool has_constant_environment() const { return scene.has_constant_environment(); }
    // How many point and directional lights there are, and one of them, [0, n), as sample_light() gives it but for its
    // choice.
    uint32_t delta_lights() const { return scene.lights.deltas; }
    std::optional<LightSample> delta_light(const Surface& from, uint32_t i) const
    {
        return sample_given_light(scene, from, i, {});
    }
    // One of the others.
    std::optional<LightSample> sample_extended_light(const Surface& from, const Sampler& sampler, uint32_t bounce) const
    {
        return lancer::sample_extended_light(scene, from, sampler.get1(bounce, Dim::light),
                                             sampler.get2(bounce, Dim::light));
    }
    // The density with which that one finds a direction out of the scene.
    float pdf_extended_environment(Vec3 normal, Vec3 wi) const
    {
        const float pdf = pdf_environment(normal, wi);
        return pdf > 0 ? pdf / static_cast<float>(scene.lights.pick.share_from(scene.lights.deltas)) : 0;
    }
    bool has_media() const { return !scene.media.empty(); }
    // What tells the rays of a path apart where a surface stops a part of them; 0 in a scene without such surfaces.
    uint32_t alpha_key(const Sampler& sampler, uint32_t bounce, Dim dim) const
    {
        return scene.geometry.alpha_test.passes_through ? hash_alpha_key(sampler, bounce, dim) : 0;
    }
    // The same for a ray that has none yet. Costs a scene without holes no more than the question.
    void set_alpha_key(Ray& ray, const Sampler& sampler, uint32_t bounce, Dim dim) const
    {
        if (scene.geometry.alpha_test.passes_through) [[unlikely]]
            ray.key = hash_alpha_key(sampler, bounce, dim);
    }
    // Out of line, so that the hash does not stand in the kernel for each kind of ray.
    [[gnu::noinline]] static uint32_t hash_alpha_key(const Sampler& sampler, uint32_t bounce, Dim dim)
    {
        return sampler.key(bounce, dim);
    }
    float pdf_light(Vec3 from, Vec3 normal, Vec3 wi, const Surface& at) const
    {
        return lancer::pdf_light(scene, from, normal, wi, at);
    }
    float pdf_environment(Vec3 normal, Vec3 wi) const { return lancer::pdf_environment(scene, normal, wi); }
};

}  // namespace lancer
