// What vertices of a DiffuseBatch get from lamps: emission met by their rays, and light that is sampled.
#pragma once

#include "render/diffuse_batch.h"

namespace lancer {

// What the functions for one path want of it where ray i ended.
template <bool looks_up>
inline State DiffuseBatch<looks_up>::state_of(size_t i, const Lanes& path, uint32_t in) const
{
    State s;
    const Vec3 t = lane(path.throughput, in);
    s.ray = now_.rays()[i];
    s.throughput = {t.x, t.y, t.z};
    s.pdf = path.pdf[in];
    if constexpr (looks_up) s.cone = {path.width[in], path.spread[in]};
    s.specular = depth_ == 0;
    if (keeps_normals_ && depth_ > 0) s.normal = w_.diffuse.normals_now[i];
    s.light_sampled = samples_ && depth_ > 0;
    s.leg = leg();
    return s;
}

template <bool looks_up>
inline void DiffuseBatch<looks_up>::add_emission(size_t i, const Lanes& path, uint32_t in)
{
    const State s = state_of(i, path, in);
    Steps steps(w_.queue, path.slot[in]);
    lancer::add_emission(view_, s, view_.surface_at(s.ray, w_.hits[i], s.cone), path_.direct, path_.parts, steps);
}

// To lanes whose rays met nothing; `first`: the ray of the first lane.
template <bool looks_up>
inline void DiffuseBatch<looks_up>::add_sky(uint32_t missed, size_t first, const Lanes& path)
{
    if (missed == 0 || !path_.parts.has(leg())) return;
    if (!looks_up || (view_.scene.has_even_sky() && !samples_sky_)) {
        const Color sky = view_.scene.environment;
        if (is_black(sky)) return;
        return for_bits(missed, [&](uint32_t i) {
            const Vec3 t = lane(path.throughput, i);
            Steps(w_.queue, path.slot[i]).add(Color{t.x, t.y, t.z} * sky);
        });
    }
    for_bits(missed, [&](uint32_t i) {
        Steps steps(w_.queue, path.slot[i]);
        add_environment(view_, state_of(first + i, path, i), path_.direct, path_.parts, steps);
    });
}

// Rays of which only emission counts where they end, and no surface shines: what they meet is not asked for.
template <bool looks_up>
inline void DiffuseBatch<looks_up>::end_in_sky()
{
    w_.occluded.resize(now_.size());
    accel_.any(now_.rays(), w_.occluded);
    for (size_t first = 0; first < now_.size(); first += float_lanes) {
        Lanes path;
        now_.load(first, path);
        uint32_t missed = 0;
        for (size_t i = 0; i < std::min<size_t>(float_lanes, now_.size() - first); ++i)
            missed |= (w_.occluded[first + i] ? 0u : 1u) << i;
        add_sky(missed, first, path);
    }
}

// View::sample_light(), one lane after the other.
template <bool looks_up>
inline LightSampleLanes DiffuseBatch<looks_up>::sample_any_light(const Vertices& v, const AddressLanes& address,
                                                                 const Vec2x8& u)
{
    Float8 number{};
    if (!view_.scene.lights.pick.stretches()) number = address.get1(v.path.sample);
    LightSampleLanes s{};
    uint32_t found = 0, infinite = 0, delta = 0;
    Surface from{};
    for_bits(v.hit & bits((v.cos_o > Float8{}) & ~is_black(v.albedo)), [&](uint32_t i) {
        from.n = from.side = lane(v.n, i), from.ns = lane(v.ns, i), from.origin = lane(v.origin, i);
        const auto pick = [&] { return number[i]; };
        const auto light = view_.sample_light(from, {u.x[i], u.y[i]}, pick, false);
        if (!light) return;
        const Color& radiance = light->radiance;
        set_lane(s.wi, i, light->wi), set_lane(s.point, i, light->point), set_lane(s.p_error, i, light->p_error);
        set_lane(s.n, i, light->n), set_lane(s.radiance, i, {radiance.r, radiance.g, radiance.b});
        s.pdf[i] = light->pdf;
        const uint32_t bit = 1u << i;
        found |= bit;
        if (light->infinite) infinite |= bit;
        if (light->delta) delta |= bit;
    });
    s.found = lanes_of(found), s.infinite = lanes_of(infinite), s.delta = lanes_of(delta);
    return s;
}

// View::sample_light()
template <bool looks_up>
inline LightSampleLanes DiffuseBatch<looks_up>::sample_light(const Vertices& v, const AddressLanes& address,
                                                             const Vec2x8& u)
{
    if constexpr (looks_up)
        if (scene_.lights.empty()) return sample_any_light(v, address, u);
    const Discrete& pick = view_.scene.lights.pick;
    if (pick.stretches()) {
        Discrete::StretchedLanes chosen{{}, u.x};
        if (pick.size() > 1) chosen = pick.stretch(u.x);
        return sample_lights(scene_, chosen.index, v.origin, {chosen.u, u.y});
    }
    const Float8 number = address.get1(v.path.sample);
    std::array<uint32_t, float_lanes> ids{};
    if (!view_.scene.lights.tree) {
        for (uint32_t i = 0; i < float_lanes; ++i) ids[i] = pick.sample(lengthened(number[i], Vec2{u.x[i], u.y[i]}));
        return sample_lights(scene_, ids, v.origin, u);
    }
    std::array<double, float_lanes> numbers;
    for (uint32_t i = 0; i < float_lanes; ++i) numbers[i] = lengthened(number[i], Vec2{u.x[i], u.y[i]});
    std::array<LightTree::Choice, float_lanes> choices{};
    view_.scene.lights.tree->choose(v.origin, v.ns, numbers, v.hit, choices);
    Float8 probability{};
    for (uint32_t i = 0; i < float_lanes; ++i) ids[i] = choices[i].light, probability[i] = choices[i].probability;
    return sample_lights(scene_, ids, v.origin, u, &probability);
}

template <bool looks_up>
inline void DiffuseBatch<looks_up>::sample_direct(const Vertices& v)
{
    const AddressLanes address = numbers(v.path.key, depth_, Dim::light);
    const Vec2x8 u = address.get2(v.path.sample);
    const LightSampleLanes light = sample_light(v, address, u);
    const Float8 zero{}, cos_i = dot(light.wi, v.ns);
    const Float8 pdf = cos_i * (1 / pi);
    const Vec3x8 f_cos = v.albedo * pdf;
    const Mask8 lit = light.found & (dot(light.wi, v.n) > zero) & (cos_i > zero) & (v.cos_o > zero) & ~is_black(f_cos);
    if ((bits(lit) & v.hit) == 0) return;
    Float8 weight = all_lanes(1.0f);
    if (path_.direct.mis) {
        const Float8 r = pdf / light.pdf;
        weight = 1.0f / (1.0f + r * r);
        if constexpr (looks_up) weight = select(light.delta, all_lanes(1.0f), weight);
    }
    const Vec3x8 radiance = times(times(v.path.throughput, f_cos), light.radiance) * (weight / light.pdf);
    const uint32_t wanted = bits(lit & ~is_black(radiance)) & v.hit;
    if (wanted == 0) return;
    // shadow_ray()
    const Float8 reach = length(light.point - v.origin) * gamma(16);
    const Vec3x8 end = offset_origin(light.point, light.p_error + Vec3x8{reach, reach, reach}, light.n, -light.wi);
    const Vec3x8 d = end - v.origin;
    Float8 distance = length(d);
    Vec3x8 dir = d / distance;
    if constexpr (looks_up) {
        dir = select(light.infinite, light.wi, dir);
        distance = select(light.infinite, all_lanes(std::numeric_limits<float>::infinity()), distance);
    }
    const uint32_t traceable = bits(is_traceable(v.origin, dir, all_lanes(Ray{}.t_min), distance));
    spoil(wanted & ~traceable, v.path.slot);
    shadows_.push(wanted & traceable, v.origin, dir, distance, {radiance, v.path.slot});
    give_keys(shadows_, wanted & traceable, v.path, depth_, Dim::shadow_hole);
}

template <bool looks_up>
inline void DiffuseBatch<looks_up>::add_unoccluded()
{
    w_.occluded.resize(shadows_.size());
    accel_.any(shadows_.rays(), w_.occluded);
    counters_.shadow_rays += shadows_.size();
    for (size_t first = 0; first < shadows_.size(); first += float_lanes) {
        ShadowLanes shadow;
        shadows_.load(first, shadow);
        for (size_t i = 0; i < std::min<size_t>(float_lanes, shadows_.size() - first); ++i) {
            if (w_.occluded[first + i]) continue;
            const Vec3 brought = lane(shadow.radiance, i);
            w_.queue.radiance[shadow.slot[i]] += Color{brought.x, brought.y, brought.z};
        }
    }
}

}  // namespace lancer
