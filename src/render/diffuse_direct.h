// What vertices of a DiffuseBatch get from lamps: emission met by their rays, and light that is sampled.
#pragma once

#include "render/diffuse_batch.h"

namespace lancer {

template <bool looks_up>
inline void DiffuseBatch<looks_up>::add_emission(size_t i, const PathLanes& path, uint32_t in)
{
    State s;
    const Vec3 t = lane(path.throughput, in);
    s.ray = now_.rays()[i];
    s.throughput = {t.x, t.y, t.z};
    s.pdf = path.pdf[in];
    if (keeps_normals_ && depth_ > 0) s.normal = w_.diffuse.normals_now[i];
    s.light_sampled = samples_ && depth_ > 0;
    s.leg = leg();
    Steps steps(w_.queue, path.slot[in]);
    lancer::add_emission(view_, s, view_.surface_at(s.ray, w_.hits[i], {}), path_.direct, path_.parts, steps);
}

// View::sample_light()
template <bool looks_up>
inline LightSampleLanes DiffuseBatch<looks_up>::sample_light(const Vertices& v, const AddressLanes& address,
                                                             const Vec2x8& u)
{
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
    }
    const Vec3x8 radiance = times(times(v.path.throughput, f_cos), light.radiance) * (weight / light.pdf);
    const uint32_t wanted = bits(lit & ~is_black(radiance)) & v.hit;
    if (wanted == 0) return;
    // shadow_ray()
    const Float8 reach = length(light.point - v.origin) * gamma(16);
    const Vec3x8 end = offset_origin(light.point, light.p_error + Vec3x8{reach, reach, reach}, light.n, -light.wi);
    const Vec3x8 d = end - v.origin;
    const Float8 distance = length(d);
    const Vec3x8 dir = d / distance;
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
