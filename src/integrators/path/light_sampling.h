// Direct light: emission that a path meets, and light sampling. Multiple importance sampling by the power heuristic:
// Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, section 9.2.
#pragma once

#include "core/frame.h"
#include "core/sampler.h"
#include "integrators/path/sampling_plan.h"
#include "integrators/path_actions.h"
#include "materials/bsdf.h"
#include "scene/description/render_settings.h"
#include "scene/through_glass.h"

namespace lancer {

// Techniques for direct light. Without multiple importance sampling the result is unbiased except for emitters that one
// technique cannot find: BSDF sampling misses point lights.
struct DirectLight {
    bool nee = true;          // next-event estimation: a shadow ray to a sampled light at each vertex
    bool mis = true;          // combine it with BSDF sampling; off: nee where it is possible, else BSDF sampling
    bool always = false;      // nee also where BSDF sampling has the same density
    bool mirrors = true;      // nee also by way of Scene::mirrors
    bool near_lights = true;  // nee also from places along a ray in a medium that lamps near it choose

    static DirectLight of(const RenderSettings& s) { return {s.nee, s.mis, s.always_nee, s.mirror_nee}; }
};

// Parts of the light in the picture. The parts are additive: emitters, direct light and indirect light add up to the
// complete picture.
struct LightParts {
    bool emitters = true;  // seen by the camera, also by specular paths; includes the environment
    bool direct = true;    // from an emitter to the first diffuse or rough surface
    bool indirect = true;  // that such a surface receives by other surfaces, specular ones included

    LightParts() = default;
    explicit LightParts(const RenderSettings& s) : emitters(s.emitters), direct(s.direct), indirect(s.indirect) {}
    // Whether light at the end of a ray of this segment is part of the picture.
    bool has(PathSegment segment) const
    {
        return segment == PathSegment::view ? emitters : segment == PathSegment::direct ? direct : indirect;
    }
    bool has_all() const { return emitters && direct && indirect; }
};

// Power heuristic for a sample of density a > 0 that the other technique would have sampled with density b.
template <class T>
T power_heuristic(T a, T b)
{
    const T r = b / a;
    return 1.0f / (1.0f + r * r);
}

// MIS weight of a light sample. delta: BSDF sampling cannot hit the light; bool or a mask.
template <class T, class Mask>
T weight_of_light_sample(T pdf_light, T pdf_bsdf, const Mask& delta, DirectLight how)
{
    const T one = broadcast_to<T>(1);
    return how.mis ? select(delta, one, power_heuristic(pdf_light, pdf_bsdf)) : one;
}

inline Color times(Color a, Color b) { return a * b; }
// Contribution of a light sample. weight: weight_of_light_sample() divided by its density. Spectrum: Color, or Vec3x8
// with T = Float8.
template <class Spectrum, class T>
Spectrum sampled_light(const Spectrum& throughput, const Spectrum& f_cos, const Spectrum& radiance, T weight)
{
    return times(times(throughput, f_cos), radiance) * weight;
}

// MIS weight of emission hit by a BSDF sample. pdf_light: density of light sampling, 0 if it could not have found the
// light.
inline float weight_of_found(const PathState& s, DirectLight how, float pdf_light)
{
    if (pdf_light == 0) return 1;
    return how.mis ? power_heuristic(s.pdf, pdf_light) : 0;
}

template <class V>
void add_emission(const V& view, const PathState& s, const Surface& surface, DirectLight how, LightParts parts,
                  PathActions& actions)
{
    if (!parts.has(s.segment)) return;
    const Color e = view.emission(surface);
    if (is_black(e)) return;
    float pdf = 0;
    if (s.mirror_distance > 0) [[unlikely]]
        pdf = view.pdf_mirrored_light(s, surface);
    else if (s.light_sampled)
        pdf = view.pdf_light(s.vertex(), s.normal, s.ray.dir, surface, s.cell);
    actions.add(s.throughput * e * weight_of_found(s, how, pdf));
}

template <class V>
void add_environment(const V& view, const PathState& s, DirectLight how, LightParts parts, PathActions& actions)
{
    if (!parts.has(s.segment)) return;
    const Color e = s.specular ? view.background(s.ray, s.cone) : view.environment(s.ray.dir);
    if (is_black(e)) return;
    const float pdf = s.light_sampled ? view.pdf_environment(s.normal, s.ray.dir, s.cell) : 0;
    actions.add(s.throughput * e * weight_of_found(s, how, pdf));
}

// The shadow ray from the origin of rays at a surface to a sampled light. Both ends are moved off their surfaces by
// their rounding errors. The far end also allows for the error of the hit distance of the light's own triangle: two dot
// products, a cross product and a quotient in float.
template <class T>
struct ShadowSegment {
    Vec3T<T> dir;
    T distance;

    // light: a LightSample or its SIMD form.
    template <class Sample>
    [[gnu::always_inline]] ShadowSegment(const Vec3T<T>& org, const Sample& light)
    {
        const T reach = length(light.point - org) * gamma(16);
        const Vec3T<T> end =
            offset_origin(light.point, light.p_error + Vec3T<T>{reach, reach, reach}, light.n, -light.wi);
        const Vec3T<T> d = end - org;
        distance = length(d);
        dir = d / distance;
    }
};
inline Ray shadow_ray(Vec3 org, const LightSample& light)
{
    if (light.infinite) return {.org = org, .dir = light.wi};
    const ShadowSegment<float> to(org, light);
    return {.org = org, .dir = to.dir, .t_max = to.distance};
}

inline Ray shadow_ray(const Surface& from, const LightSample& light)
{
    return shadow_ray(ray_origin(from, light.wi), light);
}

// Whether shading and geometric normal agree on the side of a direction: a tilted shading normal must not let light
// through the surface.
template <class T>
auto sides_agree(const Vec3T<T>& side, const Vec3T<T>& wi, const T& local_z)
{
    return (dot(wi, side) < T{}) == (local_z < T{});
}
inline bool sides_agree(const Surface& surface, Vec3 wi, Vec3 wi_local)
{
    return sides_agree(surface.side, wi, wi_local.z);
}

// Whether next-event estimation is done at a vertex. Under a constant environment alone, light sampling and cosine-
// weighted BSDF sampling have the same density, so that a shadow ray would bring no more than another sample does,
// unless it is known which part of the sky is seen.
template <class V, class B>
bool samples_light(const V& view, const B& bsdf, DirectLight how)
{
    if (!how.nee || bsdf.only_delta()) return false;
    if constexpr (requires { B::samples_cosine; }) return how.always || !view.leaves_sky_to_cosine();
    return true;
}

// Whether a surface absorbs all light, as many emitters do.
template <class B>
bool scatters_nothing(const B& bsdf)
{
    if constexpr (requires { bsdf.albedo; }) return is_black(bsdf.albedo);
    return false;
}

// Whether the light of a sample may go on straight through surfaces: of lights that no ray meets through sheets of
// glass, and of all lights through surfaces that are not there.
template <class V>
bool needs_tint(const V& view, const LightSample& light)
{
    return (light.delta && view.scene.passes_glass) || view.scene.passes_bare;
}

// Next-event estimation at a vertex. cell: the density counts its rate; see LightChoice.
template <class V, class B>
void sample_direct(const V& view, const PathState& s, const Surface& surface, const Frame& frame, Vec3 wo,
                   const B& bsdf, const Sampler& sampler, DirectLight how, uint32_t cell, PathActions& actions)
{
    auto light = view.sample_light(surface, sampler, s.depth, bsdf.transmits(), cell);
    if (!light) return;
    light->pdf *= view.light_rate(cell);
    const Vec3 wi = frame.to_local(light->wi);
    if (!sides_agree(surface, light->wi, wi)) return;
    const BsdfValue f = bsdf.eval(wo, wi);
    if (is_black(f.f_cos)) return;
    const float weight = weight_of_light_sample(light->pdf, f.pdf, light->delta, how);
    Ray ray = shadow_ray(surface, *light);
    view.set_alpha_key(ray, sampler, s.depth, Dim::shadow_alpha);
    const Color radiance = sampled_light(s.throughput, f.f_cos, light->radiance, weight / light->pdf);
    if (needs_tint(view, *light)) [[unlikely]]
        return actions.tinted_shadow(ray, radiance, light->radiance, light->light, light->delta);
    actions.shadow(ray, radiance, light->light);
}

// What becomes of shadow rays to lights that BSDF sampling cannot hit: see TintsShadows. No other technique finds the
// light that goes straight through glass.
struct GlassShadows {
    template <class V>
    Color through(const V& view, const Ray& ray, const Surface& surface) const
    {
        return through_glass(view.scene, ray, surface);
    }
    static bool is_spent(Color) { return false; }
};

}  // namespace lancer
