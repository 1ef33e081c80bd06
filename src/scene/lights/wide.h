// Light sampling for eight points at once, with the bits of sample_light().
#pragma once

#include "core/warp.h"
#include "scene/lights/sphere.h"
#include "scene/lights/triangle.h"
#include "scene/surface.h"
#include "scene/wide_scene.h"

namespace lancer {

struct LightSampleLanes {
    Mask8 found;  // the light illuminates the point
    Vec3x8 wi;    // unit
    Vec3x8 point, p_error, n;
    Vec3x8 radiance;
    Float8 pdf;             // per solid angle, including the selection
    Mask8 infinite, delta;  // as in LightSample
};
inline LightSampleLanes select(Mask8 m, const LightSampleLanes& yes, const LightSampleLanes& no)
{
    const auto chosen = [&](Mask8 a, Mask8 b) { return (m & a) | (~m & b); };
    return {chosen(yes.found, no.found),    select(m, yes.wi, no.wi),
            select(m, yes.point, no.point), select(m, yes.p_error, no.p_error),
            select(m, yes.n, no.n),         select(m, yes.radiance, no.radiance),
            select(m, yes.pdf, no.pdf),     chosen(yes.infinite, no.infinite),
            chosen(yes.delta, no.delta)};
}

// Samples points on triangle lights as seen from `origin`. ids: the selected lights. choice: their probabilities; null:
// by power.
inline void sample_triangles(const WideScene& scene, UInt8 ids, const Vec3x8& origin, const Vec2x8& u,
                             const Float8* choice, LightSampleLanes& s)
{
    using W = WideScene;
    const auto rows = [&](W::LightRow which) { return scene.lights.at(ids, which); };
    const Vec2x8 uv = square_to_triangle(u);
    const auto [a, rounding] = rows(W::corner_a);
    const PointOnTriangle<Float8> at(a, rows(W::corner_b).xyz, rows(W::corner_c).xyz, uv.x, uv.y, rounding);
    const auto [n, area] = rows(W::normal_area);
    const auto [front, by_power] = rows(W::front);
    const Float8 probability = choice ? *choice : by_power;
    s.point = at.p, s.p_error = at.p_error, s.n = n;
    const SeenTriangle<Float8> seen(at.p, n, origin);
    s.wi = seen.wi;
    s.radiance = front;
    const Mask8 before = seen.cos > Float8{};
    if (movemask(before) != 255) s.radiance = select(before, front, rows(W::back).xyz);
    s.pdf = seen.pdf(area) * probability;
    s.found = (seen.d2 > Float8{}) & (seen.cos != Float8{}) & (probability > Float8{}) & ~is_black(s.radiance);
    s.infinite = s.delta = Mask8{};
}

// Samples points on sphere lights as seen from `origin`; found where the origin is outside. choice: likewise.
inline void sample_sphere_lights(const WideScene& scene, UInt8 ids, const Vec3x8& origin, const Vec2x8& u,
                                 const Float8* choice, LightSampleLanes& s)
{
    Float8 rounding{};
    for (size_t i = 0; i < float_lanes; ++i) rounding[i] = scene.sphere_lights[ids[i]].rounding;
    const SinCosT<Float8> phi = sin_cos_2pi(u.y);
    std::array<Mask4, 2> inside;
    const auto four = [&](size_t from, const Vec3T<Float4>& org, Float4 ux, const SinCosT<Float4>& turn) {
        const auto row = [&](size_t i) { return load4(scene.sphere_lights[ids[from + i]].center_radius.data()); };
        const auto [center, radius] = transpose4(row);
        const Vec3T<Double4> to_center = center - to_double(org);
        inside[from / double_lanes] = dot(to_center, to_center) <= radius * radius;
        return sphere_seen_from_outside(center, radius, to_center, ux, turn);
    };
    const auto low = four(0, lower(origin), lower(u.x), {lower(phi.sin), lower(phi.cos)});
    const auto high = four(double_lanes, upper(origin), upper(u.x), {upper(phi.sin), upper(phi.cos)});
    s.found = lanes_of(~(movemask(inside[0]) | movemask(inside[1]) << double_lanes) & 255);
    s.wi = concat(low.wi, high.wi), s.point = concat(low.point, high.point), s.n = concat(low.n, high.n);
    s.p_error = sphere_point_error(rounding, s.point);
    const auto [color, by_power] = transpose([&](size_t i) { return load4(&scene.sphere_lights[ids[i]].radiance.x); });
    s.radiance = color, s.pdf = concat(low.pdf, high.pdf) * (choice ? *choice : by_power);
    s.infinite = s.delta = Mask8{};
}

}  // namespace lancer
