// The places that rays of a WideBatch meet, and what they are made of.
#pragma once

#include "render/wide_batch.h"
#include "scene/shading_normal.h"

namespace lancer {

// surface_at() of triangles that are drawn as they are and say nothing of their own. Returns on which of them rays come
// to the front.
template <Shading shading>
inline uint32_t WideBatch<shading>::place(std::span<const Hit> hits, const std::array<size_t, float_lanes>& which,
                                          const Vec3x8& wo, Vertices& v)
{
    std::array<const WideScene::Row*, float_lanes> albedo;
    for (uint32_t i = 0; i < float_lanes; ++i) albedo[i] = &scene_.albedo[v.material[which[i]]];
    v.albedo = turned(albedo).xyz;
    const auto four = [&](size_t from) {
        return places_of(view_.scene, hits, {which[from], which[from + 1], which[from + 2], which[from + 3]});
    };
    const PlacesOfFour low = four(0), high = four(4);
    const Vec3x8 p = joined(low.p, high.p), p_error = joined(low.p_error, high.p_error);
    v.n = joined(low.n, high.n), v.ns = joined(low.ns, high.ns);
    const Float8 zero{};
    const Mask8 front = dot(v.n, wo) > zero;
    v.n = select(front, v.n, -v.n), v.ns = select(front, v.ns, -v.ns);
    v.origin = offset_origin(p, p_error, v.n, v.n);
    const Float8 c = dot(v.ns, wo);
    if (bits(c < zero) != 0) v.ns = select(c < zero, normalize(v.ns - wo * (2.0f * c)), v.ns);
    if constexpr (any) v.others.p = p, v.others.p_error = p_error;
    return bits(front);
}

// Places of which something is to be looked up one after the other: what textures and maps say of them differs in how
// it is found. The others at once.
template <Shading shading>
inline void WideBatch<shading>::look_up(size_t first, std::span<const Hit> hits, const Vec3x8& wo, Vertices& v)
{
    uint32_t plain = 0;
    for_bits(v.hit, [&](uint32_t i) {
        const Hit& hit = hits[i];
        if (hit.kind == Kind::triangle && hit.instance == Hit::no_instance && scene_.fixed[v.material[i]].is &&
            view_.scene.shading[hit.geometry].colors.empty())
            plain |= 1u << i;
    });
    uint32_t front = 0;
    if (plain != 0) {
        std::array<size_t, float_lanes> which;
        for (uint32_t i = 0; i < float_lanes; ++i)
            which[i] = plain >> i & 1 ? i : static_cast<size_t>(std::countr_zero(plain));
        front = place(hits, which, wo, v);
        for (uint32_t i = 0; i < float_lanes; ++i) v.width[i] = hits[which[i]].t;
        v.width = v.path.width + v.path.spread * v.width;
    } else {
        const Float8 zero{};
        v.albedo = v.origin = {zero, zero, zero};
        v.n = v.ns = {zero, zero, all_lanes(1.0f)};
        v.width = zero;
        if constexpr (any) v.others.p = v.others.p_error = v.origin;
    }
    if constexpr (any) take_fixed(plain, front, wo, v);
    if ((v.hit & ~plain) != 0) look_up_each(v.hit & ~plain, first, hits, v);
}

// The materials of plain places, and what those that mirror want of the normal.
template <Shading shading>
inline void WideBatch<shading>::take_fixed(uint32_t plain, uint32_t front, const Vec3x8& wo, Vertices& v)
{
    v.others.lanes = v.others.only_delta = v.others.transmits = 0;
    for_bits(plain, [&](uint32_t i) {
        const AnyBsdf& bsdf = scene_.fixed[v.material[i]].bsdf[front >> i & 1];
        take_other(i, bsdf, v);
        if (view_.scene.traits[v.material[i]].mirrors && lane(v.ns, i) != lane(v.n, i))
            set_lane(v.ns, i, keep_reflection_outside(lane(v.n, i), lane(v.ns, i), lane(wo, i)));
    });
}

template <Shading shading>
inline void WideBatch<shading>::take_other(uint32_t i, const AnyBsdf& bsdf, Vertices& v)
{
    if (std::holds_alternative<LambertBsdf>(bsdf)) return;
    const uint32_t bit = 1u << i;
    v.others.bsdf[i] = &bsdf;
    v.others.lanes |= bit;
    std::visit(
        [&](const auto& b) {
            if (b.only_delta()) v.others.only_delta |= bit;
            if (b.transmits()) v.others.transmits |= bit;
        },
        bsdf);
}

template <Shading shading>
inline void WideBatch<shading>::look_up_each(uint32_t lanes, size_t first, std::span<const Hit> hits, Vertices& v)
{
    std::array<TrianglePlace, float_lanes> places;
    view_.triangle_places(hits, places);
    Float8 part_of_mix{};
    if constexpr (any)
        if (!view_.scene.mix_of.empty()) part_of_mix = numbers(v.path.key, depth_, Dim::mix).get1(v.path.sample);
    for_bits(lanes, [&](uint32_t i) {
        const RayCone cone{v.path.width[i], v.path.spread[i]};
        const Surface s = view_.surface_at(now_.rays()[first + i], hits[i], cone, places[i]);
        set_lane(v.n, i, s.n);
        set_lane(v.ns, i, s.ns);
        set_lane(v.origin, i, s.origin);
        v.width[i] = cone.width + cone.spread * s.t;
        Color albedo;
        if constexpr (any) {
            set_lane(v.others.p, i, s.p);
            set_lane(v.others.p_error, i, s.p_error);
            view_.with_bsdf(
                s, [&] { return part_of_mix[i]; },
                [&]<class B>(const B& bsdf) {
                    if constexpr (std::is_same_v<B, LambertBsdf>)
                        albedo = bsdf.albedo;
                    else
                        take_other(i, v.others.own[i] = bsdf, v);
                });
        } else if (const auto* lambert = std::get_if<Lambert>(&view_.scene.materials[s.material])) {
            albedo = view_.bsdf_at(*lambert, s).albedo;
        }
        set_lane(v.albedo, i, {albedo.r, albedo.g, albedo.b});
    });
}

}  // namespace lancer
