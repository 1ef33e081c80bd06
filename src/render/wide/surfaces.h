// Surfaces at the hits of a WideBatch, and their materials.
#pragma once

#include "render/wide/batch.h"
#include "scene/shading_normal.h"

namespace lancer {

// The hit distances, as from_array().
inline Float8 distances(std::span<const Hit> hits, const std::array<size_t, float_lanes>& which)
{
    const auto t = [&](size_t i) { return hits[which[i]].t; };
    return Float8{t(0), t(1), t(2), t(3), t(4), t(5), t(6), t(7)};
}

// Sets normals and ray origin of the vertices, facing wo.
template <Shading shading>
inline void WideBatch<shading>::set_surface(const InteractionLanes& at, const Vec3x8& wo, Vertices& v)
{
    v.n = at.n, v.ns = at.ns;
    [[maybe_unused]] const Mask8 front = face_forward(v.n, v.ns, wo);
    v.origin = offset_origin(at.p, at.p_error, v.n, v.n);
    turn_to_ray(v.ns, wo);
    if constexpr (textured) v.found.front = movemask(front);
    if constexpr (any) v.non_lambert.p = at.p, v.non_lambert.p_error = at.p_error;
}

template <Shading shading>
inline void WideBatch<shading>::clear_surfaces(Vertices& v)
{
    const Float8 zero{};
    v.albedo = v.origin = {zero, zero, zero};
    v.n = v.ns = {zero, zero, broadcast(1.0f)};
    v.width = zero;
    v.found.front = 0;
    if constexpr (any) v.non_lambert.p = v.non_lambert.p_error = v.origin;
}

// Classifies each vertex by the data that it needs.
template <Shading shading>
inline void WideBatch<shading>::classify_surfaces(std::span<const Hit> hits, Vertices& v) const
{
    WideScene::LaneFlags triangle_flags;
    for_each_lane(v.hit, [&](uint32_t i) {
        const Hit& hit = hits[i];
        if (hit.kind == Kind::triangle && hit.instance == Hit::no_instance)
            triangle_flags.add(i, scene_.triangle_flags[v.material[i]]);
    });
    SurfaceQuery& found = v.found;
    found.drawn = triangle_flags.lanes(WideScene::is_drawn),
    found.straight = triangle_flags.lanes(WideScene::is_straight);
    found.fixed = triangle_flags.lanes(WideScene::is_fixed),
    found.mirroring = triangle_flags.lanes(WideScene::is_mirroring);
    if (scene_.has_colors)
        for_each_lane(found.fixed, [&](uint32_t i) {
            if (is_coloured(hits[i])) found.fixed &= ~(1u << i);
        });
    if (!prefetches_) return;
    prefetch_normals(view_.scene, hits, found.drawn);
    prefetch_uv_corners(view_.scene, hits, found.drawn & ~found.fixed);
}

// surface_at() for non-instanced triangles, without textures. Other lanes repeat the first such lane.
template <Shading shading>
inline void WideBatch<shading>::set_triangle_surfaces(uint32_t drawn, std::span<const Hit> hits, const Vec3x8& wo,
                                                      Vertices& v)
{
    HitIndices which;
    std::array<uint32_t, float_lanes> material;
    for (uint32_t i = 0; i < float_lanes; ++i) {
        which[i] = drawn >> i & 1 ? i : static_cast<size_t>(std::countr_zero(drawn));
        material[i] = v.material[which[i]];
    }
    v.albedo = scene_.albedo.at(from_array(material)).xyz;
    v.found.interactions = interactions_of(view_.scene, hits, which);
    set_surface(v.found.interactions, wo, v);
    v.width = v.path.width + v.path.spread * distances(hits, which);
}

// Computes the surfaces without reading textures.
template <Shading shading>
inline void WideBatch<shading>::find_surfaces(Vertices& v)
{
    const std::span<const Hit> hits = hits_of(v);
    const Vec3x8 wo = -directions_of_eight(&now_.rays()[v.first]);
    SurfaceQuery& found = v.found;
    found.wo = wo;
    if (found.drawn != 0)
        set_triangle_surfaces(found.drawn, hits, wo, v);
    else
        clear_surfaces(v);
    if (prefetches_) prefetch_uvs(view_.scene, hits, found.drawn & ~found.fixed);
    if constexpr (any) keep_reflections_outside(found.straight & found.mirroring, wo, v);
}

// Evaluates materials. Textures, instances, other shapes and normal maps are handled lane by lane.
template <Shading shading>
inline void WideBatch<shading>::lookup_materials(Vertices& v)
{
    const std::span<const Hit> hits = hits_of(v);
    const SurfaceQuery& found = v.found;
    if constexpr (any) lookup_bsdf(found.fixed, found.front, v);
    lookup_bsdf(found.straight & ~found.fixed, v, [&](uint32_t i, const auto& number, const auto& take) {
        const bool front = (found.front >> i & 1) != 0;
        Vec2 tangent{1, 0};
        if constexpr (any) {
            if (view_.scene.traits[v.material[i]].has_tangent) {
                const float time = now_.rays()[v.first + i].time;
                const Vec3 ns = lane(found.interactions.ns, i);
                tangent = local_tangent(tangent_frame_at(view_.scene, hits[i], time, ns), lane(v.ns, i));
            }
            if (only_turns(hits[i], v.material[i])) return lookup_turned(i, tangent, front, v);
        }
        ShadingPoint p = shading_point_at(view_.scene, hits[i], front, v.width[i], found.interactions.area[i]);
        p.tangent = tangent;
        view_.with_bsdf(v.material[i], p, number, take);
    });
    lookup_bsdf(v.hit & ~found.straight, v, [&](uint32_t i, const auto& number, const auto& take) {
        const RayCone cone{v.path.width[i], v.path.spread[i]};
        const Ray& ray = now_.rays()[v.first + i];
        const Surface s = (found.drawn >> i & 1) != 0 ? view_.surface_at(ray, hits[i], cone, found.interactions.of(i))
                                                      : view_.surface_at(ray, hits[i], cone);
        set_lane(v.n, i, s.n);
        set_lane(v.ns, i, s.ns);
        set_lane(v.origin, i, s.origin);
        v.width[i] = cone.width + cone.spread * s.t;
        if constexpr (any) set_lane(v.non_lambert.p, i, s.p), set_lane(v.non_lambert.p_error, i, s.p_error);
        if constexpr (any)
            if (only_turns(hits[i], v.material[i])) return lookup_turned(i, s.tangent, s.front, v);
        const WideScene::Fixed& fixed = scene_.fixed[v.material[i]];
        if (fixed.is && !is_coloured(hits[i]))
            std::visit(take, fixed.bsdf[s.front]);
        else
            view_.with_bsdf(s, number, take);
    });
    v.cos_o = dot(found.wo, v.ns);
    if constexpr (any) {
        v.non_lambert.wo = FrameT<Float8>(v.ns).to_local(found.wo);
        queues_.for_some(v.non_lambert.queued, v.non_lambert.lanes,
                         [&](auto& queue, const LaneQueue::Eight& of) { queue.put_wo(of, v.non_lambert.wo); });
        see_principled(v.non_lambert);
    }
}

// Light sampling and each part of a path that splits ask the same lobes.
template <Shading shading>
inline void WideBatch<shading>::see_principled(NonLambert& non_lambert)
{
    non_lambert.seen = 0;
    const uint32_t seen = non_lambert.lanes & ~non_lambert.queued.lanes() & movemask(non_lambert.wo.z > Float8{});
    for_each_lane(seen, [&](uint32_t i) {
        const auto* bsdf = std::get_if<PrincipledBsdf>(non_lambert.bsdf[i]);
        if (!bsdf) return;
        non_lambert.seen |= 1u << i;
        non_lambert.lobes[i] = bsdf->seen_from(lane(non_lambert.wo, i));
    });
}

// Calls f(bsdf, from) for a lane that is neither Lambertian nor queued. from: the first argument of the BSDF's eval()
// and sample().
template <Shading shading>
template <class F>
inline auto WideBatch<shading>::with_bsdf(const NonLambert& non_lambert, uint32_t i, const F& f)
{
    if ((non_lambert.seen >> i & 1) != 0)
        return f(*std::get_if<PrincipledBsdf>(non_lambert.bsdf[i]), *non_lambert.lobes[i]);
    const Vec3 wo = lane(non_lambert.wo, i);
    return std::visit([&](const auto& bsdf) { return f(bsdf, wo); }, *non_lambert.bsdf[i]);
}

// keep_reflection_outside() for lanes whose material is specular; few of them change.
template <Shading shading>
inline void WideBatch<shading>::keep_reflections_outside(uint32_t lanes, const Vec3x8& wo, Vertices& v)
{
    lanes &= movemask((v.ns.x != v.n.x) | (v.ns.y != v.n.y) | (v.ns.z != v.n.z));
    lanes &= ~movemask(MirrorImage(v.n, v.ns, wo).is_outside());
    for_each_lane(lanes, [&](uint32_t i) {
        set_lane(v.ns, i, keep_reflection_outside(lane(v.n, i), lane(v.ns, i), lane(wo, i)));
    });
}

// BSDFs that are the same everywhere: read from the table. The kind of each lane is unpredictable, so common data is
// set for all eight.
template <Shading shading>
inline void WideBatch<shading>::lookup_bsdf(uint32_t lanes, uint32_t front, Vertices& v)
{
    NonLambert& non_lambert = v.non_lambert;
    non_lambert.lanes = non_lambert.only_delta = non_lambert.transmits = 0;
    queues_.begin_eight(non_lambert.queued);
    if (lanes == 0) return;
    WideScene::LaneFlags flags;
    for (uint32_t i = 0; i < float_lanes; ++i) {
        const WideScene::Fixed& fixed = scene_.fixed[v.material[i]];
        const uint32_t side = front >> i & 1;
        non_lambert.bsdf[i] = &fixed.bsdf[side];
        flags.add(i, fixed.flags[side]);
    }
    non_lambert.lanes = lanes & flags.lanes(WideScene::is_non_lambert);
    non_lambert.only_delta = lanes & flags.lanes(WideScene::is_only_delta);
    non_lambert.transmits = lanes & flags.lanes(WideScene::is_transmissive);
    for_each_lane(lanes & flags.lanes(WideScene::is_queued),
                  [&](uint32_t i) { queues_.add(non_lambert.queued, i, *non_lambert.bsdf[i]); });
}

// of_bsdf: bsdf_flags().
template <Shading shading>
inline void WideBatch<shading>::add_flags(uint32_t i, uint32_t of_bsdf, NonLambert& non_lambert)
{
    WideScene::LaneFlags flags;
    flags.add(i, of_bsdf);
    non_lambert.lanes |= flags.lanes(WideScene::is_non_lambert);
    non_lambert.only_delta |= flags.lanes(WideScene::is_only_delta);
    non_lambert.transmits |= flags.lanes(WideScene::is_transmissive);
}

// Stores a BSDF that is not Lambertian.
template <Shading shading>
template <class B>
inline void WideBatch<shading>::lookup_bsdf(uint32_t i, const B& bsdf, Vertices& v)
{
    NonLambert& non_lambert = v.non_lambert;
    add_flags(i, bsdf_flags(bsdf), non_lambert);
    if (is_queued(bsdf)) {
        queues_.add(non_lambert.queued, i, bsdf);
        if (!by_mirrors_) return;
    }
    non_lambert.bsdf[i] = std::construct_at(&non_lambert.own[i].bsdf, bsdf);
}

// Stores the BSDF of a point whose material only_turns().
template <Shading shading>
inline void WideBatch<shading>::lookup_turned(uint32_t i, Vec2 tangent, bool front, Vertices& v)
{
    NonLambert& non_lambert = v.non_lambert;
    const WideScene::Fixed& fixed = scene_.fixed[v.material[i]];
    const auto& bsdf = *std::get_if<PrincipledBsdf>(&fixed.bsdf[front]);
    const Vec2 turn = bsdf.turn_of(tangent);
    if (!bsdf.is_queued || by_mirrors_) {
        PrincipledBsdf turned = bsdf;
        turned.turn(turn);
        return lookup_bsdf(i, turned, v);
    }
    add_flags(i, fixed.flags[front], non_lambert);
    queues_.add_turned(non_lambert.queued, i, bsdf, turn);
}

// Evaluates materials lane by lane: at(i, number, take) passes the BSDF of lane i to take(bsdf); number() selects the
// material of a mix.
template <Shading shading>
template <class At>
inline void WideBatch<shading>::lookup_bsdf(uint32_t lanes, Vertices& v, const At& at)
{
    if (lanes == 0) return;
    Float8 part_of_mix{};
    if (any && !view_.scene.mix_of.empty()) part_of_mix = numbers(v.path.key, depth_, Dim::mix).get1(v.path.sample);
    for_each_lane(lanes, [&](uint32_t i) {
        Color albedo;
        at(
            i, [&] { return part_of_mix[i]; },
            [&]<class B>(const B& bsdf) {
                if constexpr (std::is_same_v<B, LambertBsdf>)
                    albedo = bsdf.albedo;
                else if constexpr (any)
                    lookup_bsdf(i, bsdf, v);
            });
        set_lane(v.albedo, i, {albedo.r, albedo.g, albedo.b});
    });
}

// Finds the material of each vertex. Lanes without a hit repeat the first lane that has one.
template <Shading shading>
inline HitIndices WideBatch<shading>::find_materials(Vertices& v) const
{
    const std::span<const Hit> hits = hits_of(v);
    const auto some = static_cast<size_t>(std::countr_zero(v.hit));
    HitIndices which;
    std::array<uint32_t, float_lanes> material;
    v.shining = 0;
    for (uint32_t i = 0; i < float_lanes; ++i) {
        which[i] = v.hit >> i & 1 ? i : some;
        const Hit& hit = hits[which[i]];
        material[i] =
            textured ? view_.scene.material_of(hit) : view_.scene.shading[hit.geometry].material_of(hit.primitive);
        v.shining |= static_cast<uint32_t>(scene_.shines[material[i]]) << i;
    }
    v.material = from_array(material);
    return which;
}

// Processes the hits of n <= 8 rays. Returns false if no path continues.
template <Shading shading>
inline bool WideBatch<shading>::find_vertices(size_t first, size_t n, Vertices& v)
{
    v.first = first, v.count = n;
    now_.load(first, v.path);
    HitLanes hits(&w_.hits[first]);
    hits.exist &= first_lanes(n);
    v.hit = movemask(hits.exist);
    v.leaf_hint = hits.leaf_hint;
    add_background(~v.hit & ((1u << n) - 1), first, v.path);
    if (v.hit == 0) return false;
    const bool by_table = !textured && !scene_.flat.empty() && !are_last();
    std::optional<FlatTable::Found> found;
    HitIndices which;
    if (by_table) {
        found = scene_.flat.at(hits);
        v.material = found->material, v.shining = movemask(found->shines);
    } else {
        which = find_materials(v);
    }
    for_each_lane(v.hit & v.shining, [&](uint32_t i) { add_emission(first + i, v.path, i); });
    v.hit &= ~last_of(v.path);
    if (v.hit == 0) return false;
    if constexpr (textured) {
        classify_surfaces(hits_of(v), v);
    } else {
        const Vec3x8 wo = -directions_of_eight(&now_.rays()[first]);
        v.albedo = scene_.albedo.at(v.material).xyz;
        set_surface(by_table ? found->place : interactions_of(view_.scene, hits_of(v), which), wo, v);
        v.cos_o = dot(wo, v.ns);
    }
    return true;
}

}  // namespace lancer
