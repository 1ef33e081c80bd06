// Building blocks of path tracers: scattering, Russian roulette, and a vertex of a path made of these and of
// light_sampling.h.
#pragma once

#include "integrators/path/light_sampling.h"
#include "integrators/path/mirrored_light.h"

namespace lancer {

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
        // Next-event estimation, with the probability of its cell; see LightChoice.
        const float rate = samples ? view.light_rate(cell) : 0;
        if (rate == 1 || (rate > 0 && sampler.get1(s.depth, Dim::roulette) < rate)) {
            if (parts.has(segment_after(s.segment, false)))
                sample_direct(view, s, surface, frame, wo, bsdf, sampler, how, cell, actions);
            if (parts.indirect && how.mirrors && !view.scene.mirrors.empty() && !is_last(to_mirror(s))) [[unlikely]]
                sample_mirrored(view, s, surface, wo, bsdf, sampler, how, rate, actions);
        }
        const auto send = [&](PathState& n, const Sampler& numbers) {
            if (!scatter(view, s, n, surface, frame, wo, bsdf, numbers)) return false;
            if (!survives_roulette(n, numbers, roulette_depth, view.plan.split)) return false;
            follow_mirror(s, surface, how, n);
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
                n.sample = view.plan.first_number(s.sample, uint32_t{s.part}) + i;
                n.throughput /= static_cast<float>(view.plan.split);
                return send(n, sampler.of_sample(n.sample));
            });
    });
}

}  // namespace lancer
