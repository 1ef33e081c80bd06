// The rays that vertices of a WideBatch send on.
#pragma once

#include "render/wide_batch.h"

namespace lancer {

template <Shading shading>
inline void WideBatch<shading>::scatter(Vertices& v)
{
    const PathPlan& plan = view_.plan;
    const bool splits = depth_ == 0 && plan.parts > 1;
    const Float8 zero{}, no_end = all_lanes(std::numeric_limits<float>::infinity());
    Mask8 reflects = (v.cos_o > zero) & ~is_black(v.albedo);
    if ((bits(reflects) & v.hit) == 0) return;
    Lanes& next = v.path;  // from here on that of what is sent on
    Float8 spread{};
    if constexpr (looks_up) next.width = v.width, spread = next.spread;
    if (splits) {
        for_bits(v.hit, [&](uint32_t i) {
            next.sample[i] = next.sample[i] * plan.parts + w_.slots[next.slot[i]].sample % plan.of_path();
        });
        next.throughput = next.throughput / all_lanes(static_cast<float>(plan.split));
    }
    next.throughput = times(next.throughput, v.albedo);
    reflects &= ~is_black(next.throughput);
    if ((bits(reflects) & v.hit) == 0) return;
    const auto [q, is_certain] = survival(v, next.throughput);
    if (!is_certain) next.throughput = next.throughput / q;
    const FrameT<Float8> frame(v.ns);
    const AddressLanes address = numbers(next.key, depth_, Dim::bsdf);
    const AddressLanes roulette = numbers(next.key, depth_ + 1, Dim::roulette);
    for (uint32_t part = 0; part < (splits ? plan.split : 1); ++part, next.sample += 1u) {
        const Vec2x8 u = address.get2(next.sample);
        const Vec3x8 local = square_to_cosine_hemisphere(u.x, u.y);
        const Vec3x8 wi = normalize(frame.to_world(local));
        Mask8 goes = reflects & (local.z > zero) & ~(dot(wi, v.n) < zero);
        if (!is_certain) goes &= roulette.get2_x(next.sample) < q;
        const uint32_t wanted = bits(goes) & v.hit,
                       traceable = bits(is_traceable(v.origin, wi, all_lanes(Ray{}.t_min), no_end));
        spoil(wanted & ~traceable, next.slot);
        next.pdf = local.z * (1 / pi);
        if constexpr (looks_up) next.spread = opened(spread, next.pdf);
        next_.push(wanted & traceable, v.origin, wi, no_end, next);
        give_keys(next_, wanted & traceable, next, depth_ + 1, Dim::hole);
        if (keeps_normals_)
            for_bits(wanted & traceable, [&](uint32_t i) { w_.wide.normals_next.push_back(lane(v.ns, i)); });
    }
}

// With what probability roulette lets a ray go on to the next depth: see survives_roulette().
template <Shading shading>
inline typename WideBatch<shading>::Survival WideBatch<shading>::survival(const Vertices& v,
                                                                          const Vec3x8& throughput) const
{
    const bool is_deep = depth_ + 1 >= path_.roulette_depth;
    const Float8 cap = all_lanes(is_deep ? roulette_cap : 1.0f);
    if (view_.plan.worth.empty()) {
        if (!is_deep) return {cap, true};
        return {min(max(throughput.x, max(throughput.y, throughput.z)), cap), false};
    }
    const Vec3x8 part = times(throughput, v.path.worth);
    const Float8 of_pixel = sqrt(part.x * part.x + part.y * part.y + part.z * part.z);
    const Float8 of_path = of_pixel * static_cast<float>(view_.plan.parts > 1 ? view_.plan.split : 1);
    const Float8 q = min(max(roulette_rays * of_path, all_lanes(least_survival)), cap);
    return {q, (bits(q != all_lanes(1.0f)) & v.hit) == 0};
}

// The same where some lanes are not matt: their BSDFs are asked one by one, what follows is done for all.
template <Shading shading>
inline void WideBatch<shading>::scatter_any(Vertices& v)
{
    const PathPlan& plan = view_.plan;
    const Others& others = v.others;
    const Float8 zero{}, one = all_lanes(1.0f), no_end = all_lanes(std::numeric_limits<float>::infinity());
    const Mask8 reflects = (v.cos_o > zero) & ~is_black(v.albedo);
    const uint32_t sends = v.hit & (bits(reflects) | others.lanes);
    if (sends == 0) return;
    Lanes& next = v.path;  // from here on that of what is sent on
    uint32_t splits = 0;   // splits_at()
    if (plan.parts > 1) splits = sends & ~others.only_delta & ~bits(is_set(next.so_far, has_split));
    if (splits != 0) {
        for_bits(splits, [&](uint32_t i) {
            next.sample[i] = next.sample[i] * plan.parts + w_.slots[next.slot[i]].sample % plan.of_path();
        });
        const Mask8 split = lanes_of(splits);
        next.throughput = select(split, next.throughput / all_lanes(static_cast<float>(plan.split)), next.throughput);
        next.so_far |= reinterpret_cast<UInt8>(split) & has_split;
    }
    const Vec3x8 throughput = next.throughput;
    const Float8 eta_scale = next.eta_scale, spread = next.spread;
    next.width = v.width;
    // State::leg behind a lobe that spreads light and behind one that does not, and what else is the same of all parts.
    const auto leg = [](Leg l) { return UInt8{} + static_cast<uint32_t>(l); };
    const UInt8 leg_before = next.so_far >> leg_above;
    const Mask8 seen = leg_before == leg(Leg::view);
    Mask8 samples = lanes_of(samples_on_matt_ ? 255u : 0u);
    samples |= lanes_of(samples_ ? others.lanes & ~others.only_delta : 0u);
    const UInt8 spreading = (next.so_far & has_split) | (reinterpret_cast<UInt8>(samples) & has_sampled_light) |
                            select(seen, leg(Leg::direct), leg(Leg::indirect)) << leg_above;
    const UInt8 straight =
        (next.so_far & has_split) | was_specular | select(seen, leg(Leg::view), leg(Leg::indirect)) << leg_above;
    const FrameT<Float8> frame(v.ns);
    const AddressLanes address = numbers(next.key, depth_, Dim::bsdf);
    const AddressLanes roulette = numbers(next.key, depth_ + 1, Dim::roulette);
    for (uint32_t part = 0; part < (splits != 0 ? plan.split : 1); ++part, next.sample += 1u) {
        const uint32_t lanes = part == 0 ? sends : splits;
        const Vec2x8 u = address.get2(next.sample);
        Vec3x8 local = square_to_cosine_hemisphere(u.x, u.y), weight = v.albedo;
        Float8 eta = one;
        next.pdf = local.z * (1 / pi);
        uint32_t goes = lanes & bits(reflects & (local.z > zero)), delta = 0;
        if ((lanes & others.lanes) != 0) {
            const Float8 lobe = address.get1(next.sample);
            for_bits(lanes & others.lanes, [&](uint32_t i) {
                const auto sample = std::visit(
                    [&](const auto& bsdf) {
                        return bsdf.sample(lane(others.wo, i), lobe[i], {u.x[i], u.y[i]});
                    },
                    others.bsdf[i]);
                if (!sample) return;
                set_lane(local, i, sample->wi);
                set_lane(weight, i, {sample->weight.r, sample->weight.g, sample->weight.b});
                next.pdf[i] = sample->pdf, eta[i] = sample->eta;
                goes |= 1u << i, delta |= uint32_t{sample->delta} << i;
            });
        }
        const Vec3x8 wi = normalize(frame.to_world(local));
        const Mask8 behind = dot(wi, v.n) < zero;
        next.throughput = times(throughput, weight);
        goes &= bits(~(behind ^ (local.z < zero)) & ~is_black(weight) & ~is_black(next.throughput));
        if (goes == 0) continue;
        const Mask8 is_delta = lanes_of(delta);
        next.eta_scale = eta_scale * (eta * eta);
        next.so_far = select(is_delta, straight, spreading);
        next.spread = select(is_delta, smaller(one, spread), opened(spread, next.pdf));
        const Float8 q = survival_of_any(next.throughput, next);
        if ((bits(q != one) & goes) != 0) {
            goes &= bits((q == one) | (roulette.get2_x(next.sample) < q));
            next.throughput = next.throughput / q;
        }
        Vec3x8 origin = v.origin;
        for_bits(goes & bits(behind),
                 [&](uint32_t i) { set_lane(origin, i, ray_origin(*others.surface[i], lane(wi, i))); });
        const uint32_t traceable = bits(is_traceable(origin, wi, all_lanes(Ray{}.t_min), no_end));
        spoil(goes & ~traceable, next.slot);
        next_.push(goes & traceable, origin, wi, no_end, next);
        give_keys(next_, goes & traceable, next, depth_ + 1, Dim::hole);
        if (keeps_normals_)
            for_bits(goes & traceable, [&](uint32_t i) { w_.wide.normals_next.push_back(lane(v.ns, i)); });
    }
}

// See survives_roulette(). next: of the ray that is sent on.
template <Shading shading>
inline Float8 WideBatch<shading>::survival_of_any(const Vec3x8& throughput, const AnyPathLanes& next) const
{
    const bool is_deep = depth_ + 1 >= path_.roulette_depth;
    const Float8 cap = all_lanes(is_deep ? roulette_cap : 1.0f);
    Float8 by_throughput = cap;
    if (is_deep) by_throughput = min(max(throughput.x, max(throughput.y, throughput.z)) * next.eta_scale, cap);
    if (view_.plan.worth.empty()) return by_throughput;
    const Vec3x8 part = times(throughput, next.worth);
    const Float8 of_pixel = sqrt(part.x * part.x + part.y * part.y + part.z * part.z);
    const Float8 of_path = of_pixel * select(is_set(next.so_far, has_split),
                                             all_lanes(static_cast<float>(view_.plan.split)), all_lanes(1.0f));
    const Float8 by_pixel = min(max(roulette_rays * of_path * next.eta_scale, all_lanes(least_survival)), cap);
    const Mask8 seen = (next.so_far >> leg_above) == static_cast<uint32_t>(Leg::view);
    return select(seen, by_throughput, by_pixel);
}

}  // namespace lancer
