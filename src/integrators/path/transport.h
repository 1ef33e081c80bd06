// Building blocks of path tracers: weighted emission, light sampling, scattering, Russian roulette. Multiple importance
// sampling by the power heuristic: Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, section
// 9.2.
#pragma once

#include "core/frame.h"
#include "core/sampler.h"
#include "integrators/path_actions.h"
#include "integrators/view.h"
#include "materials/bsdf.h"
#include "scene/description/render_settings.h"
#include "scene/through_glass.h"

namespace lancer {

// Techniques for direct light. Without multiple importance sampling the result is unbiased except for emitters that one
// technique cannot find: BSDF sampling misses point lights.
struct DirectLight {
    bool nee = true;      // next-event estimation: a shadow ray to a sampled light at each vertex
    bool mis = true;      // combine it with BSDF sampling; off: nee where it is possible, else BSDF sampling
    bool always = false;  // nee also where BSDF sampling has the same density

    static DirectLight of(const RenderSettings& s) { return {s.nee, s.mis, s.always_nee}; }
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
    const float pdf = s.light_sampled ? view.pdf_light(s.ray.org, s.normal, s.ray.dir, surface, s.cell) : 0;
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

// The shadow ray from a surface to a sampled light. Both ends are moved off their surfaces by their rounding errors.
// The far end also allows for the error of the hit distance of the light's own triangle: two dot products, a cross
// product and a quotient in float.
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
inline Ray shadow_ray(const Surface& from, const LightSample& light)
{
    const Vec3 org = ray_origin(from, light.wi);
    if (light.infinite) return {.org = org, .dir = light.wi};
    const ShadowSegment<float> to(org, light);
    return {.org = org, .dir = to.dir, .t_max = to.distance};
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
// weighted BSDF sampling have the same density, so that a shadow ray would bring no more than another sample does.
template <class V, class B>
bool samples_light(const V& view, const B& bsdf, DirectLight how)
{
    if (!how.nee || bsdf.only_delta()) return false;
    if constexpr (requires { B::samples_cosine; }) return how.always || !view.has_constant_environment();
    return true;
}

// Whether a surface absorbs all light, as many emitters do.
template <class B>
bool scatters_nothing(const B& bsdf)
{
    if constexpr (requires { bsdf.albedo; }) return is_black(bsdf.albedo);
    return false;
}

// Next-event estimation at a vertex, with the probability of its cell; see LightChoice.
template <class V, class B>
void sample_direct(const V& view, const PathState& s, const Surface& surface, const Frame& frame, Vec3 wo,
                   const B& bsdf, const Sampler& sampler, DirectLight how, uint32_t cell, PathActions& actions)
{
    const float rate = view.light_rate(cell);
    if (rate < 1 && !(sampler.get1(s.depth, Dim::roulette) < rate)) return;
    auto light = view.sample_light(surface, sampler, s.depth, bsdf.transmits(), cell);
    if (!light) return;
    light->pdf *= rate;
    const Vec3 wi = frame.to_local(light->wi);
    if (!sides_agree(surface, light->wi, wi)) return;
    const BsdfValue f = bsdf.eval(wo, wi);
    if (is_black(f.f_cos)) return;
    const float weight = weight_of_light_sample(light->pdf, f.pdf, light->delta, how);
    Ray ray = shadow_ray(surface, *light);
    view.set_alpha_key(ray, sampler, s.depth, Dim::shadow_alpha);
    const Color radiance = sampled_light(s.throughput, f.f_cos, light->radiance, weight / light->pdf);
    if (light->delta && view.scene.passes_glass) [[unlikely]]
        return actions.tinted_shadow(ray, radiance, light->radiance, light->light);
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

// Ray cone after scattering: a delta lobe keeps the spread (curved mirrors are treated as flat, which only makes
// textures sharper); other lobes widen it to a sixteenth of the sample's solid angle.
template <class T>
T opened(T spread, T pdf)
{
    return smaller(broadcast_to<T>(1), larger(spread, 0.25f / sqrt(pdf)));
}
// delta: whether a delta lobe sampled the direction; bool or a mask. pdf: its density.
template <class T, class Mask>
T spread_after(const Mask& delta, T spread, T pdf)
{
    return select(delta, smaller(broadcast_to<T>(1), spread), opened(spread, pdf));
}
inline RayCone scattered(RayCone cone, float t, const BsdfSample& sample)
{
    return {cone.width + cone.spread * t, spread_after(sample.delta, cone.spread, sample.pdf)};
}

inline PathSegment segment_after(PathSegment segment, bool delta)
{
    if (segment != PathSegment::view) return PathSegment::indirect;
    return delta ? PathSegment::view : PathSegment::direct;
}

// Turns n, a copy of s, into the ray of a BSDF sample. Returns false if there is no sample or it carries no light.
template <class V>
bool send_on(const V& view, const PathState& s, PathState& n, const Surface& surface, const Frame& frame,
             const std::optional<BsdfSample>& b, const Sampler& sampler)
{
    if (!b || is_black(b->weight)) return false;
    const Vec3 wi = normalize(frame.to_world(b->wi));
    if (!sides_agree(surface, wi, b->wi)) return false;
    n.ray = {.org = ray_origin(surface, wi), .dir = wi, .leaf_hint = surface.leaf_hint};
    view.set_alpha_key(n.ray, sampler, n.depth + 1, Dim::alpha);
    n.throughput *= b->weight;
    if (is_black(n.throughput)) return false;
    n.pdf = b->pdf;
    n.normal = surface.ns;
    n.eta_scale *= b->eta * b->eta;
    n.specular = b->delta;
    n.segment = segment_after(s.segment, b->delta);
    n.cone = scattered(s.cone, surface.t, *b);
    ++n.depth;
    return true;
}

// Samples the BSDF and does the same.
template <class V, class B>
bool scatter(const V& view, const PathState& s, PathState& n, const Surface& surface, const Frame& frame, Vec3 wo,
             const B& bsdf, const Sampler& sampler)
{
    const auto b = bsdf.sample(wo, sampler.get1(s.depth, Dim::bsdf), sampler.get2(s.depth, Dim::bsdf));
    return send_on(view, s, n, surface, frame, b, sampler);
}

// The survival probability of Russian roulette is capped, which ends lossless loops after about a thousand bounces.
inline constexpr float roulette_rays = 3.5f, least_survival = 0.02f, roulette_cap = 0.999f;

// Russian roulette by the energy that the path carries. At the first vertices paths survive (is_deep is false): ending
// them there costs several times the samples in bright scenes. T: float or Float8.
template <class T>
T survival_by_throughput(const Vec3T<T>& t, T eta_scale, bool is_deep)
{
    if (!is_deep) return broadcast_to<T>(1);
    return smaller(broadcast_to<T>(roulette_cap), larger(t.x, larger(t.y, t.z)) * eta_scale);
}
// Adjoint-driven Russian roulette, by the expected contribution relative to the pixel's radiance, so that dark pixels
// keep rays that bright ones can do without: Herholz et al., "Adjoint-Driven Russian Roulette and Splitting in Light
// Transport Simulation", 2016. The constants were fitted on four scenes; a factor of 1.5 changes the error at equal
// time by a few per cent. importance: see SamplingPlan; paths: number of rays into which the path has split.
template <class T>
T survival_by_pixel(const Vec3T<T>& t, const Vec3T<T>& importance, T paths, T eta_scale, bool is_deep)
{
    const Vec3T<T> part{t.x * importance.x, t.y * importance.y, t.z * importance.z};
    const T contribution = sqrt(part.x * part.x + part.y * part.y + part.z * part.z) * paths;
    return smaller(broadcast_to<T>(is_deep ? roulette_cap : 1.0f),
                   larger(broadcast_to<T>(least_survival), roulette_rays * contribution * eta_scale));
}
inline Vec3 as_vector(Color c) { return {c.r, c.g, c.b}; }
// Ends a path by chance and weighs the surviving ones. Rays of the view segment use the throughput alone: what they see
// is what the pixel shows. Unbiased. split: SamplingPlan::split.
inline bool survives_roulette(PathState& s, const Sampler& sampler, uint32_t first_depth, uint32_t split)
{
    const bool is_deep = s.depth >= first_depth;
    const float q = s.importance.r < 0 || s.segment == PathSegment::view
                        ? survival_by_throughput(as_vector(s.throughput), s.eta_scale, is_deep)
                        : survival_by_pixel(as_vector(s.throughput), as_vector(s.importance),
                                            static_cast<float>(s.has_split ? split : 1), s.eta_scale, is_deep);
    if (q == 1) return true;
    if (!(sampler.get2(s.depth, Dim::roulette).x < q)) return false;
    s.throughput /= q;
    return true;
}

// Whether a path splits at a vertex: at its first one that is not specular. Most of the variance arises behind it, and
// the rays before it are shared.
template <class B>
bool splits_at(const PathState& s, const B& bsdf)
{
    return !s.has_split && !bsdf.only_delta();
}

// One vertex of a path tracer: emission, next-event estimation, BSDF sampling. is_last(next): whether only emission
// counts at the end of the next ray.
template <class V, class IsLast>
void trace_vertex(const V& view, const PathState& s, const Surface& surface, const Sampler& sampler, DirectLight how,
                  LightParts parts, uint32_t roulette_depth, const IsLast& is_last, PathActions& actions)
{
    add_emission(view, s, surface, how, parts, actions);
    if (s.last) return;
    view.with_bsdf(surface, sampler, s.depth, [&](const auto& bsdf) {
        if (scatters_nothing(bsdf)) return;
        const Frame frame(surface.ns);
        const Vec3 wo = frame.to_local(-s.ray.dir);
        const bool samples = samples_light(view, bsdf, how);
        const uint32_t cell = samples ? view.light_cell(surface) : 0;
        if (samples && parts.has(segment_after(s.segment, false)))
            sample_direct(view, s, surface, frame, wo, bsdf, sampler, how, cell, actions);
        const auto send = [&](PathState& n, const Sampler& numbers) {
            if (!scatter(view, s, n, surface, frame, wo, bsdf, numbers)) return false;
            if (!survives_roulette(n, numbers, roulette_depth, view.plan.split)) return false;
            n.light_sampled = samples && !n.specular;
            if (n.light_sampled) n.pdf /= view.light_rate(cell), n.cell = cell;
            n.last = is_last(n) || (n.segment == PathSegment::direct && !parts.indirect);
            return true;
        };
        if (view.plan.parts == 1 || !splits_at(s, bsdf))
            return actions.next_from(s, [&](PathState& n) { return send(n, sampler); });
        for (uint32_t i = 0; i < view.plan.split; ++i)
            actions.next_from(s, [&](PathState& n) {
                n.has_split = true;
                n.sample = view.plan.first_number(s.sample, s.part) + i;
                n.throughput /= static_cast<float>(view.plan.split);
                return send(n, sampler.of_sample(n.sample));
            });
    });
}

}  // namespace lancer
