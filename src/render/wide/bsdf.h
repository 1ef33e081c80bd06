// BSDF sampling of a WideBatch: the rays that continue paths.
#pragma once

#include <optional>

#include "render/wide/batch.h"

namespace lancer {

// Sampler index of the first part of paths that split. lanes: the active lanes.
template <Shading shading>
inline UInt8 WideBatch<shading>::of_first_part(const Lanes& path, uint32_t lanes) const
{
    const SamplingPlan& plan = view_.plan;
    UInt8 part{};
    if (plan.samples_per_path() > 1)
        for_each_lane(lanes, [&](uint32_t i) { part[i] = w_.slots[path.slot[i]].sample % plan.samples_per_path(); });
    return plan.first_number(path.sample, part);
}

template <Shading shading>
inline void WideBatch<shading>::scatter(Vertices& v)
{
    const SamplingPlan& plan = view_.plan;
    const bool splits = depth_ == 0 && plan.parts > 1;
    const Float8 zero{};
    Mask8 reflects = (v.cos_o > zero) & ~is_black(v.albedo);
    if ((movemask(reflects) & v.hit) == 0) return;
    Lanes& next = v.path;  // becomes the state of the next ray
    Float8 spread{};
    if constexpr (textured) next.width = v.width, spread = next.spread;
    if (splits) {
        next.sample = of_first_part(next, v.hit);
        next.throughput = next.throughput / broadcast(static_cast<float>(plan.split));
    }
    next.throughput = times(next.throughput, v.albedo);
    reflects &= ~is_black(next.throughput);
    if ((movemask(reflects) & v.hit) == 0) return;
    const Float8 q = survival(next);
    const bool is_certain = (movemask(q != broadcast(1.0f)) & v.hit) == 0;
    if (!is_certain) next.throughput = next.throughput / q;
    const FrameT<Float8> frame(v.ns);
    const AddressLanes address = numbers(next.key, depth_, Dim::bsdf);
    std::optional<AddressLanes> roulette;  // only computed if needed
    if (!is_certain) roulette = numbers(next.key, depth_ + 1, Dim::roulette);
    const uint32_t parts = splits ? plan.split : 1;
    for (uint32_t part = 0; part < parts; ++part, next.sample += 1u) {
        const Vec2x8 u = address.get2(next.sample);
        const Vec3x8 local = square_to_cosine_hemisphere(u.x, u.y);
        const Vec3x8 wi = normalize(frame.to_world(local));
        Mask8 goes = reflects & (local.z > zero) & ~(dot(wi, v.n) < zero);
        if (roulette) goes &= roulette->get2_x(next.sample) < q;
        next.pdf = pdf_cosine_hemisphere(local.z);
        if constexpr (textured) next.spread = opened(spread, next.pdf);
        if (learned_) next.pdf = next.pdf / v.light_rate;
        send(movemask(goes) & v.hit, v.origin, wi, v);
    }
}

// splits_at() for the lanes in `sends`: returns the lanes whose paths split, sets their flags and the sampler index of
// their first part.
template <Shading shading>
inline uint32_t WideBatch<shading>::split_any(uint32_t sends, const NonLambert& non_lambert, AnyPathLanes& path) const
{
    const SamplingPlan& plan = view_.plan;
    if (plan.parts == 1) return 0;
    const uint32_t splits = sends & ~non_lambert.only_delta & ~movemask(is_set(path.path_flags, has_split));
    if (splits == 0) return 0;
    const Mask8 split = lanes_of(splits);
    path.sample = select(split, of_first_part(path, splits), path.sample);
    path.throughput = select(split, path.throughput / broadcast(static_cast<float>(plan.split)), path.throughput);
    path.path_flags |= reinterpret_cast<UInt8>(split) & has_split;
    return splits;
}

// Computes the random numbers of BSDF sampling for the given lanes.
template <Shading shading>
inline void WideBatch<shading>::choose_part(const Vertices& v, ScatterState& g, uint32_t lanes)
{
    const AddressLanes address = numbers(v.path.key, depth_, Dim::bsdf);
    const bool has_non_lambert = (lanes & v.non_lambert.lanes) != 0;
    if (has_non_lambert) {
        const Vec3x8 u = address.get3(v.path.sample);
        g.u = {u.x, u.y}, g.lobe = u.z;
    } else {
        g.u = address.get2(v.path.sample);
    }
    g.cosine = square_to_cosine_hemisphere(g.u.x, g.u.y);
    queues_.for_some(v.non_lambert.queued, lanes,
                     [&](auto& queue, const LaneQueue::Eight& of) { queue.put_numbers(of, g.lobe, g.u, g.cosine); });
}

// Samples the BSDF of each lane: Lambertian lanes and those of the queues together, others one by one.
template <Shading shading>
inline typename WideBatch<shading>::BsdfSamples WideBatch<shading>::sample_any(const Vertices& v, const ScatterState& g,
                                                                               uint32_t lanes) const
{
    const NonLambert& non_lambert = v.non_lambert;
    const Float8 zero{};
    BsdfSamples s{.wi = g.cosine, .weight = v.albedo, .pdf = pdf_cosine_hemisphere(g.cosine.z), .eta = broadcast(1.0f)};
    s.lanes = lanes & ~non_lambert.lanes & movemask((v.cos_o > zero) & ~is_black(v.albedo) & (s.wi.z > zero));
    if ((lanes & non_lambert.lanes) == 0) return s;
    queues_.for_some(non_lambert.queued, lanes, [&](const auto& queue, const LaneQueue::Eight& of) {
        const BsdfSampleLanes sampled = queue.sampled(of);
        const uint32_t asked = lanes & of.lanes;
        const Mask8 is_asked = lanes_of(asked);
        s.wi = select(is_asked, sampled.wi, s.wi), s.weight = select(is_asked, sampled.weight, s.weight);
        s.pdf = select(is_asked, sampled.pdf, s.pdf), s.eta = select(is_asked, sampled.eta, s.eta);
        s.lanes |= asked & sampled.found & ~movemask(is_black(sampled.weight)), s.delta |= sampled.delta;
    });
    for_each_lane(lanes & non_lambert.lanes & ~non_lambert.queued.lanes(), [&](uint32_t i) {
        const auto sampled = with_bsdf(non_lambert, i, [&](const auto& bsdf, const auto& from) {
            return bsdf.sample(from, g.lobe[i], Vec2{g.u.x[i], g.u.y[i]});
        });
        if (!sampled || is_black(sampled->weight)) return;
        set_lane(s.wi, i, sampled->wi);
        set_lane(s.weight, i, {sampled->weight.r, sampled->weight.g, sampled->weight.b});
        s.pdf[i] = sampled->pdf, s.eta[i] = sampled->eta;
        s.lanes |= 1u << i, s.delta |= uint32_t{sampled->delta} << i;
    });
    return s;
}

// Prepares scattering; v.path becomes the state of the first part.
template <Shading shading>
inline void WideBatch<shading>::begin_scatter(Vertices& v, ScatterState& g)
{
    const NonLambert& non_lambert = v.non_lambert;
    Lanes& next = v.path;
    g.splits = 0, g.sends = v.hit & (non_lambert.lanes | movemask((v.cos_o > Float8{}) & ~is_black(v.albedo)));
    if (g.sends == 0) return;
    if (by_mirrors_) follow_mirrors(v);
    g.splits = split_any(g.sends, non_lambert, next);
    g.throughput = next.throughput, g.eta_scale = next.eta_scale, g.spread = next.spread;
    next.width = v.width;
    // The flags of a ray from a non-specular lobe and from a specular one.
    const UInt8 kept = next.path_flags & has_split;
    const Mask8 seen = (next.path_flags >> segment_shift) == static_cast<uint32_t>(PathSegment::view);
    const auto segment = [&](PathSegment from_view) {
        return select(seen, bits_of(from_view), bits_of(PathSegment::indirect));
    };
    const uint32_t sampled = (samples_on_matt_ ? ~non_lambert.lanes : 0) | (samples_ ? non_lambert.lanes : 0);
    g.spreading =
        kept | segment(PathSegment::direct) | (reinterpret_cast<UInt8>(lanes_of(sampled & 255)) & has_sampled_light);
    g.straight = kept | segment(PathSegment::view) | was_specular;
}

// scatter() where some lanes are not Lambertian; see send_on(). The parts of a path are processed in order, each for
// all paths of a batch together.
template <Shading shading>
inline void WideBatch<shading>::scatter_any(std::span<Vertices> vertices)
{
    uint32_t splits = 0;
    for (size_t i = 0; i < vertices.size(); ++i) {
        begin_scatter(vertices[i], non_lambert_.scatter_state[i]);
        splits |= non_lambert_.scatter_state[i].splits;
    }
    const uint32_t parts = splits == 0 ? 1 : view_.plan.split;
    for (uint32_t part = 0; part < parts; ++part) send_part(vertices, part);
}

// Only paths that split have more than a first part.
template <Shading shading>
inline void WideBatch<shading>::send_part(std::span<Vertices> vertices, uint32_t part)
{
    const auto lanes = [&](const ScatterState& g) { return part == 0 ? g.sends : g.splits; };
    for (size_t i = 0; i < vertices.size(); ++i)
        if (ScatterState& g = non_lambert_.scatter_state[i]; lanes(g) != 0) choose_part(vertices[i], g, lanes(g));
    queues_.for_all([](auto& queue) { queue.sample(); });
    for (size_t i = 0; i < vertices.size(); ++i)
        if (const ScatterState& g = non_lambert_.scatter_state[i]; lanes(g) != 0) finish_part(vertices[i], g, lanes(g));
}

// Samples one part and appends its rays; v.path becomes the state of the next part.
template <Shading shading>
inline void WideBatch<shading>::finish_part(Vertices& v, const ScatterState& g, uint32_t lanes)
{
    const Float8 zero{}, one = broadcast(1.0f);
    Lanes& next = v.path;
    const BsdfSamples s = sample_any(v, g, lanes);
    const Vec3x8 wi = normalize(FrameT<Float8>(v.ns).to_world(s.wi));
    const Mask8 behind = dot(wi, v.n) < zero, is_delta = lanes_of(s.delta);
    next.throughput = times(g.throughput, s.weight);
    uint32_t goes = s.lanes & movemask(~(behind ^ (s.wi.z < zero)) & ~is_black(next.throughput));
    if (goes != 0) {
        next.pdf = s.pdf;
        next.eta_scale = g.eta_scale * (s.eta * s.eta);
        next.path_flags = select(is_delta, g.straight, g.spreading);
        next.spread = spread_after(is_delta, g.spread, s.pdf);
        if (learned_) next.pdf = select(is_set(next.path_flags, has_sampled_light), next.pdf / v.light_rate, next.pdf);
        if (by_mirrors_) next.pdf = select(lanes_of(v.non_lambert.mirrored), v.non_lambert.mirrored_pdf, next.pdf);
        const Float8 q = survival(next);
        if ((movemask(q != one) & goes) != 0) {
            const AddressLanes roulette = numbers(next.key, depth_ + 1, Dim::roulette);
            goes &= movemask((q == one) | (roulette.get2_x(next.sample) < q));
            next.throughput = next.throughput / q;
        }
        Vec3x8 origin = v.origin;
        for_each_lane(goes & movemask(behind), [&](uint32_t i) { set_lane(origin, i, origin_behind(v, i)); });
        send(goes, origin, wi, v);
    }
    next.sample += 1u;
}

// Appends the rays of the given lanes with v.path as their state.
template <Shading shading>
inline void WideBatch<shading>::send(uint32_t lanes, const Vec3x8& origin, const Vec3x8& wi, const Vertices& v)
{
    const Float8 no_end = broadcast(std::numeric_limits<float>::infinity());
    const uint32_t traceable = movemask(is_traceable(origin, wi, broadcast(Ray{}.t_min), no_end));
    invalidate(lanes & ~traceable, v.path.slot);
    next_.push(lanes & traceable, origin, wi, no_end, v.path);
    next_.set_leaf_hints(lanes & traceable, v.leaf_hint);
    set_alpha_keys(next_, lanes & traceable, v.path, depth_ + 1, Dim::alpha);
    if (by_mirrors_) {
        if constexpr (any) {
            const NonLambert& m = v.non_lambert;
            w_.wide.mirror_distances_next.push(lanes & traceable, m.mirror_distance);
            if (keeps_normals_)
                w_.wide.normals_next.push(lanes & traceable, select(lanes_of(m.mirrored), m.mirrored_normal, v.ns));
        }
    } else if (keeps_normals_) {
        w_.wide.normals_next.push(lanes & traceable, v.ns);
    }
    if (keeps_cells_) w_.wide.cells_next.push(lanes & traceable, v.light_cell);
}

// Survival probability of Russian roulette for the rays of the next depth; see survival_by_pixel in
// integrators/path/transport.h.
template <Shading shading>
inline Float8 WideBatch<shading>::survival(const Lanes& next) const
{
    const bool is_deep = depth_ + 1 >= path_.roulette_depth;
    const Float8 one = broadcast(1.0f), split = broadcast(static_cast<float>(view_.plan.split));
    // On Lambertian surfaces all paths split at the first vertex, and no later ray belongs to the view segment.
    Float8 eta_scale = one, paths = view_.plan.parts > 1 ? split : one;
    Mask8 seen{};
    if constexpr (any) {
        eta_scale = next.eta_scale;
        paths = select(is_set(next.path_flags, has_split), split, one);
        seen = (next.path_flags >> segment_shift) == static_cast<uint32_t>(PathSegment::view);
    }
    const Float8 by_throughput = survival_by_throughput(next.throughput, eta_scale, is_deep);
    if (view_.plan.importance.empty()) return by_throughput;
    const Float8 by_pixel = survival_by_pixel(next.throughput, next.importance, paths, eta_scale, is_deep);
    return select(seen, by_throughput, by_pixel);
}

}  // namespace lancer
