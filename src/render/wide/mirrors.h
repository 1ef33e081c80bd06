// Light sampling of a WideBatch by way of mirrors: see integrators/path/mirrored_light.h. Lights are sampled for eight
// vertices at once; few of them are seen in a mirror, so that the rest is done one by one.
#pragma once

#include "integrators/path/mirrored_light.h"
#include "render/wide/batch.h"

namespace lancer {

template <Shading shading>
inline void WideBatch<shading>::sample_mirrored(Vertices& v)
{
    LightQuery query;
    query.active = v.samples_light;
    if (query.active == 0) return;
    const AddressLanes address = numbers(v.path.key, depth_, Dim::mirror);
    const Vec2x8 number = address.get2(v.path.sample);
    Float8 rate{};
    for_each_lane(query.active, [&](uint32_t i) { rate[i] = mirror_rate(segment_of(v.path.path_flags, i)); });
    query.active &= movemask(number.y < rate);
    if (query.active == 0) return;
    if (learned_) rate = rate * v.light_rate;
    const Vec2x8 u = numbers(v.path.key, depth_, Dim::mirrored_light).get2(v.path.sample);
    // Lights are sampled from the images of the vertices.
    NonLambert& more = v.non_lambert;
    const Vec3x8 origin = v.origin, n = v.n, ns = v.ns, p = more.p;
    std::array<uint32_t, float_lanes> ids{};
    for_each_lane(query.active, [&](uint32_t i) {
        ids[i] = choose_mirror(view_.scene, number.x[i]);
        const PlanarMirror& mirror = view_.scene.mirrors[ids[i]];
        set_lane(v.origin, i, mirror.image_at(lane(origin, i))), set_lane(more.p, i, mirror.image_at(lane(p, i)));
        set_lane(v.n, i, mirror.image_of(lane(n, i))), set_lane(v.ns, i, mirror.image_of(lane(ns, i)));
    });
    sample_light(v, address, u, query);
    v.origin = origin, v.n = n, v.ns = ns, more.p = p;

    const LightSampleLanes& light = query.light;
    const AddressLanes alpha = numbers(v.path.key, depth_, Dim::shadow_alpha);
    for_each_lane(query.active & movemask(light.found), [&](uint32_t i) {
        const bool is_lambert = (more.lanes >> i & 1) == 0, infinite = (movemask(light.infinite) >> i & 1) != 0;
        Surface from{};
        from.n = from.side = lane(n, i), from.ns = lane(ns, i), from.origin = lane(origin, i);
        from.p = lane(p, i), from.p_error = lane(more.p_error, i);
        const auto color = [](Vec3 c) { return Color{c.x, c.y, c.z}; };
        const LightSample sample{.wi = lane(light.wi, i),
                                 .point = lane(light.point, i),
                                 .p_error = lane(light.p_error, i),
                                 .n = lane(light.n, i),
                                 .infinite = infinite,
                                 .radiance = color(lane(light.radiance, i)),
                                 .pdf = light.pdf[i] * rate[i],
                                 .delta = (movemask(light.delta) >> i & 1) != 0,
                                 .light = query.ids[i]};
        PathActions actions(w_.queue, v.path.slot[i]);
        request_mirrored(
            view_, ids[i], from, sample, color(lane(v.path.throughput, i)), path_.direct,
            [&](Vec3 wi) -> BsdfValue {
                if (is_lambert) return LambertBsdf{color(lane(v.albedo, i))}.eval({0, 0, v.cos_o[i]}, wi);
                return std::visit([&](const auto& bsdf) { return bsdf.eval(lane(more.wo, i), wi); }, *more.bsdf[i]);
            },
            [&](Ray& ray) {
                if (view_.scene.geometry.alpha_test.passes_through) ray.key = alpha.key(i, v.path.sample[i]);
            },
            actions);
    });
}

// follow_mirror() for the lanes of which it keeps anything. v.path: of the rays that have arrived.
template <Shading shading>
inline void WideBatch<shading>::follow_mirrors(Vertices& v)
{
    NonLambert& more = v.non_lambert;
    more.mirrored = 0, more.mirror_distance = more.mirrored_pdf = Float8{}, more.mirrored_normal = v.ns;
    if (depth_ == 0) return;
    const std::span<const Hit> hits = hits_of(v);
    const uint32_t lit = movemask(is_set(v.path.path_flags, has_sampled_light));
    for_each_lane(v.hit & more.only_delta & lit, [&](uint32_t i) {
        if (view_.scene.mirror_at(hits[i]) == 0) return;
        more.mirrored |= 1u << i;
        const bool is_first = segment_of(v.path.path_flags, i) == PathSegment::direct;
        more.mirrored_pdf[i] = v.path.pdf[i] / mirror_rate(is_first ? PathSegment::view : PathSegment::indirect);
        more.mirror_distance[i] = hits[i].t;
        if (!keeps_normals_) return;
        set_lane(more.mirrored_normal, i, mirror_image(w_.wide.normals_now[v.first + i], lane(v.n, i)));
    });
}

}  // namespace lancer
