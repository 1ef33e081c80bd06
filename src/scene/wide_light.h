// Light sampling in scenes that are plain enough: sample_light() of eight places at once.
#pragma once

#include "core/warp.h"
#include "scene/wide_scene.h"

namespace lancer {

struct LightSampleLanes {
    Mask8 found;  // it sends light there
    Vec3x8 wi;    // unit
    Vec3x8 point, p_error, n;
    Vec3x8 radiance;
    Float8 pdf;  // per solid angle, choice of the light included
    // Only where lights are sampled one by one; triangles are neither.
    Mask8 infinite{}, delta{};  // as in LightSample
};

// A point on a light as seen from `origin`. ids: of the lights that were chosen. choice: with what probability, if not
// by power alone.
inline LightSampleLanes sample_lights(const WideScene& scene, const std::array<uint32_t, float_lanes>& ids,
                                      const Vec3x8& origin, const Vec2x8& u, const Float8* choice = nullptr)
{
    using L = WideScene::Light;
    const auto rows = [&](WideScene::Row L::*which) {
        std::array<const WideScene::Row*, float_lanes> of;
        for (size_t i = 0; i < of.size(); ++i) of[i] = &(scene.lights[ids[i]].*which);
        return turned(of);
    };
    const Vec2x8 uv = square_to_triangle(u);
    const PointOnTriangle<Float8> at(rows(&L::a).xyz, rows(&L::b).xyz, rows(&L::c).xyz, uv.x, uv.y);
    const auto [n, area] = rows(&L::n_area);
    const auto [front, by_power] = rows(&L::front);
    const Float8 probability = choice ? *choice : by_power;
    LightSampleLanes s;
    s.point = at.p, s.p_error = at.p_error, s.n = n;
    const Vec3x8 d = at.p - origin;
    const Float8 d2 = dot(d, d);
    s.wi = d / sqrt(d2);
    const Float8 cos = -dot(s.wi, n);
    s.radiance = select(cos > Float8{}, front, rows(&L::back).xyz);
    s.pdf = d2 / (abs(cos) * area) * probability;
    s.found = (d2 > Float8{}) & (cos != Float8{}) & (probability > Float8{}) & ~is_black(s.radiance);
    return s;
}

}  // namespace lancer
