// The places that rays of a WideBatch meet, and what they are made of.
#pragma once

#include "render/wide/batch.h"
#include "scene/shading_normal.h"

namespace lancer {

// As together().
inline Float8 distances(std::span<const Hit> hits, const std::array<size_t, float_lanes>& which)
{
    const auto t = [&](size_t i) { return hits[which[i]].t; };
    return Float8{t(0), t(1), t(2), t(3), t(4), t(5), t(6), t(7)};
}

// To the side that rays come to, against wo.
template <Shading shading>
inline void WideBatch<shading>::turn(const PlaceLanes& at, const Vec3x8& wo, Vertices& v)
{
    v.n = at.n, v.ns = at.ns;
    [[maybe_unused]] const Mask8 front = face_forward(v.n, v.ns, wo);
    v.origin = offset_origin(at.p, at.p_error, v.n, v.n);
    turn_to_ray(v.ns, wo);
    if constexpr (looks_up) v.found.front = bits(front);
    if constexpr (any) v.others.p = at.p, v.others.p_error = at.p_error;
}

template <Shading shading>
inline void WideBatch<shading>::place_nowhere(Vertices& v)
{
    const Float8 zero{};
    v.albedo = v.origin = {zero, zero, zero};
    v.n = v.ns = {zero, zero, all_lanes(1.0f)};
    v.width = zero;
    v.found.front = 0;
    if constexpr (any) v.others.p = v.others.p_error = v.origin;
}

// Of each vertex what is to be looked up.
template <Shading shading>
inline void WideBatch<shading>::find_kinds(std::span<const Hit> hits, Vertices& v) const
{
    WideScene::Facts of_drawn;
    for_bits(v.hit, [&](uint32_t i) {
        const Hit& hit = hits[i];
        if (hit.kind == Kind::triangle && hit.instance == Hit::no_instance)
            of_drawn.add(i, scene_.of_drawn[v.material[i]]);
    });
    LookedUp& found = v.found;
    found.drawn = of_drawn.lanes(WideScene::is_drawn), found.straight = of_drawn.lanes(WideScene::is_straight);
    found.fixed = of_drawn.lanes(WideScene::is_fixed), found.mirroring = of_drawn.lanes(WideScene::is_mirroring);
    if (scene_.has_colors)
        for_bits(found.fixed, [&](uint32_t i) {
            if (!view_.scene.shading[hits[i].geometry].colors.empty()) found.fixed &= ~(1u << i);
        });
    if (!fetches_) return;
    fetch_normals(view_.scene, hits, found.drawn);
    fetch_uv_corners(view_.scene, hits, found.drawn & ~found.fixed);
}

// surface_at() of triangles that are drawn as they are, before anything is looked up. Other lanes do as the first that
// is such a one.
template <Shading shading>
inline void WideBatch<shading>::place_drawn(uint32_t drawn, std::span<const Hit> hits, const Vec3x8& wo, Vertices& v)
{
    EightHits which;
    std::array<uint32_t, float_lanes> material;
    for (uint32_t i = 0; i < float_lanes; ++i) {
        which[i] = drawn >> i & 1 ? i : static_cast<size_t>(std::countr_zero(drawn));
        material[i] = v.material[which[i]];
    }
    v.albedo = scene_.albedo.at(together(material)).xyz;
    v.found.places = places_of(view_.scene, hits, which);
    turn(v.found.places, wo, v);
    v.width = v.path.width + v.path.spread * distances(hits, which);
}

// Where vertices are, and what is known of them without looking anything up.
template <Shading shading>
inline void WideBatch<shading>::find_place(Vertices& v)
{
    const std::span<const Hit> hits = hits_of(v);
    const Vec3x8 wo = -directions_of_eight(&now_.rays()[v.first]);
    LookedUp& found = v.found;
    found.wo = wo;
    if (found.drawn != 0)
        place_drawn(found.drawn, hits, wo, v);
    else
        place_nowhere(v);
    if (fetches_) fetch_uvs(view_.scene, hits, found.drawn & ~found.fixed);
    if constexpr (any) bend_back(found.straight & found.mirroring, wo, v);
}

// What vertices are made of. Textures are asked one after the other, and so is where on other things than triangles
// that are drawn as they are a place is, and what maps that tilt it make of it.
template <Shading shading>
inline void WideBatch<shading>::look_up(Vertices& v)
{
    const std::span<const Hit> hits = hits_of(v);
    const LookedUp& found = v.found;
    if constexpr (any) take_fixed(found.fixed, found.front, v);
    take_each(found.straight & ~found.fixed, v, [&](uint32_t i, const auto& number, const auto& take) {
        const bool front = (found.front >> i & 1) != 0;
        const ShadingPoint p = shading_point_at(view_.scene, hits[i], front, v.width[i], found.places.area[i]);
        view_.with_bsdf(v.material[i], p, number, take);
    });
    take_each(v.hit & ~found.straight, v, [&](uint32_t i, const auto& number, const auto& take) {
        const RayCone cone{v.path.width[i], v.path.spread[i]};
        const Ray& ray = now_.rays()[v.first + i];
        const Surface s = (found.drawn >> i & 1) != 0 ? view_.surface_at(ray, hits[i], cone, found.places.of(i))
                                                      : view_.surface_at(ray, hits[i], cone);
        set_lane(v.n, i, s.n);
        set_lane(v.ns, i, s.ns);
        set_lane(v.origin, i, s.origin);
        v.width[i] = cone.width + cone.spread * s.t;
        if constexpr (any) set_lane(v.others.p, i, s.p), set_lane(v.others.p_error, i, s.p_error);
        view_.with_bsdf(s, number, take);
    });
    v.cos_o = dot(found.wo, v.ns);
    if constexpr (any) {
        v.others.wo = FrameT<Float8>(v.ns).to_local(found.wo);
        if (v.others.plastic.lanes != 0) others_.plastic.put_wo(v.others.plastic, v.others.wo);
    }
}

// What lanes whose materials mirror want of the shading normal; few of them change it.
template <Shading shading>
inline void WideBatch<shading>::bend_back(uint32_t lanes, const Vec3x8& wo, Vertices& v)
{
    lanes &= bits((v.ns.x != v.n.x) | (v.ns.y != v.n.y) | (v.ns.z != v.n.z));
    lanes &= ~bits(MirrorImage(v.n, v.ns, wo).is_outside());
    for_bits(lanes,
             [&](uint32_t i) { set_lane(v.ns, i, keep_reflection_outside(lane(v.n, i), lane(v.ns, i), lane(wo, i))); });
}

// The first that are taken. Of which kind each is cannot be foretold: what all have in common is done for all eight.
template <Shading shading>
inline void WideBatch<shading>::take_fixed(uint32_t lanes, uint32_t front, Vertices& v)
{
    Others& others = v.others;
    others.lanes = others.only_delta = others.transmits = 0;
    others.plastic = others_.plastic.begin_eight();
    if (lanes == 0) return;
    WideScene::Facts facts;
    for (uint32_t i = 0; i < float_lanes; ++i) {
        const WideScene::Fixed& fixed = scene_.fixed[v.material[i]];
        const uint32_t side = front >> i & 1;
        others.bsdf[i] = &fixed.bsdf[side];
        facts.add(i, fixed.facts[side]);
    }
    others.lanes = lanes & facts.lanes(WideScene::is_other);
    others.only_delta = lanes & facts.lanes(WideScene::is_only_delta);
    others.transmits = lanes & facts.lanes(WideScene::is_open);
    for_bits(lanes & facts.lanes(WideScene::is_plastic),
             [&](uint32_t i) { others_.plastic.add(others.plastic, i, *std::get_if<PlasticBsdf>(others.bsdf[i])); });
}

// One that is not Lambert's.
template <Shading shading>
template <class B>
inline void WideBatch<shading>::take_own(uint32_t i, const B& bsdf, Vertices& v)
{
    Others& others = v.others;
    WideScene::Facts facts;
    facts.add(i, facts_of(bsdf));
    others.lanes |= facts.lanes(WideScene::is_other);
    others.only_delta |= facts.lanes(WideScene::is_only_delta);
    others.transmits |= facts.lanes(WideScene::is_open);
    if constexpr (std::is_same_v<B, PlasticBsdf>) {
        others_.plastic.add(others.plastic, i, bsdf);
    } else {
        others.own[i] = bsdf;
        others.bsdf[i] = &others.own[i];
    }
}

// The materials of places: at(i, number, take) gives that of lane i to take(bsdf); number() chooses of a mix.
template <Shading shading>
template <class At>
inline void WideBatch<shading>::take_each(uint32_t lanes, Vertices& v, const At& at)
{
    if (lanes == 0) return;
    Float8 part_of_mix{};
    if (any && !view_.scene.mix_of.empty()) part_of_mix = numbers(v.path.key, depth_, Dim::mix).get1(v.path.sample);
    for_bits(lanes, [&](uint32_t i) {
        Color albedo;
        at(
            i, [&] { return part_of_mix[i]; },
            [&]<class B>(const B& bsdf) {
                if constexpr (std::is_same_v<B, LambertBsdf>)
                    albedo = bsdf.albedo;
                else if constexpr (any)
                    take_own(i, bsdf, v);
            });
        set_lane(v.albedo, i, {albedo.r, albedo.g, albedo.b});
    });
}

// Of each vertex the material, one by one. Lanes without a hit do as the first that has one.
template <Shading shading>
inline EightHits WideBatch<shading>::find_materials(Vertices& v) const
{
    const std::span<const Hit> hits = hits_of(v);
    const auto some = static_cast<size_t>(std::countr_zero(v.hit));
    EightHits which;
    std::array<uint32_t, float_lanes> material;
    v.shining = 0;
    for (uint32_t i = 0; i < float_lanes; ++i) {
        which[i] = v.hit >> i & 1 ? i : some;
        const Hit& hit = hits[which[i]];
        material[i] =
            looks_up ? view_.scene.material_of(hit) : view_.scene.shading[hit.geometry].material_of(hit.primitive);
        v.shining |= static_cast<uint32_t>(scene_.shines[material[i]]) << i;
    }
    v.material = together(material);
    return which;
}

// What n rays, at most eight, meet. False where no path goes on. Of what stands behind the last of them nothing is
// taken.
template <Shading shading>
inline bool WideBatch<shading>::arrive(size_t first, size_t n, Vertices& v)
{
    v.first = first, v.count = n;
    now_.load(first, v.path);
    HitLanes hits(&w_.hits[first]);
    hits.exist &= first_lanes(n);
    v.hit = bits(hits.exist);
    v.start = hits.place;
    add_sky(~v.hit & ((1u << n) - 1), first, v.path);
    if (v.hit == 0) return false;
    const bool by_table = !looks_up && !scene_.flat.empty() && !are_last();
    std::optional<FlatTable::Found> found;
    EightHits which;
    if (by_table) {
        found = scene_.flat.at(hits);
        v.material = found->material, v.shining = bits(found->shines);
    } else {
        which = find_materials(v);
    }
    for_bits(v.hit & v.shining, [&](uint32_t i) { add_emission(first + i, v.path, i); });
    v.hit &= ~last_of(v.path);
    if (v.hit == 0) return false;
    if constexpr (looks_up) {
        find_kinds(hits_of(v), v);
    } else {
        const Vec3x8 wo = -directions_of_eight(&now_.rays()[first]);
        v.albedo = scene_.albedo.at(v.material).xyz;
        turn(by_table ? found->place : places_of(view_.scene, hits_of(v), which), wo, v);
        v.cos_o = dot(wo, v.ns);
    }
    return true;
}

}  // namespace lancer
