// A block of four triangles and its ray test: the operations of triangle_float.h in the same order, and therefore with
// its bits.
#pragma once

#include <immintrin.h>

#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "geometry/triangle_float.h"

namespace lancer {

struct alignas(32) TriangleBlock {
    static constexpr uint32_t size = 4;

    float corner[3][3][size];  // corner, axis, triangle
    uint32_t number[size];

    // Unused lanes are NaN, which no ray hits.
    TriangleBlock()
    {
        for (auto& c : corner)
            for (auto& axis : c) std::fill(std::begin(axis), std::end(axis), std::numeric_limits<float>::quiet_NaN());
        std::fill(std::begin(number), std::end(number), UINT32_MAX);
    }
    void set(uint32_t i, const std::array<Vec3, 3>& corners, uint32_t its_number)
    {
        for (uint32_t k = 0; k < 3; ++k)
            for (int axis = 0; axis < 3; ++axis) corner[k][axis][i] = corners[k][axis];
        number[i] = its_number;
    }
    Vec3 at(uint32_t k, uint32_t i) const { return {corner[k][0][i], corner[k][1][i], corner[k][2][i]}; }
};

// Precomputed data of a ray; axes in the order kx, ky, kz of the sheared ray.
struct BlockRay {
    ShearedRay sheared;
    int axis[3];
    float org[3];

    explicit BlockRay(const Ray& ray) : sheared(ray), axis{sheared.kx, sheared.ky, sheared.kz}
    {
        for (int k = 0; k < 3; ++k) org[k] = ray.org[axis[k]];
    }
};

// Mask of the triangles that the ray hits in [t_min, t_max], and their t.
inline uint32_t meets(const TriangleBlock& b, const BlockRay& r, float t_min, float t_max, float (&t)[4])
{
    const __m128 sx = _mm_set1_ps(r.sheared.sx), sy = _mm_set1_ps(r.sheared.sy), zero = _mm_setzero_ps();
    const __m128 ox = _mm_set1_ps(r.org[0]), oy = _mm_set1_ps(r.org[1]), oz = _mm_set1_ps(r.org[2]);
    __m128 x[3], y[3], z[3];  // corners relative to the ray's origin, before the shear
    for (int k = 0; k < 3; ++k) {
        x[k] = _mm_load_ps(b.corner[k][r.axis[0]]) - ox;
        y[k] = _mm_load_ps(b.corner[k][r.axis[1]]) - oy;
        z[k] = _mm_load_ps(b.corner[k][r.axis[2]]) - oz;
    }
    const __m128 ax = x[0] - sx * z[0], ay = y[0] - sy * z[0];
    const __m128 bx = x[1] - sx * z[1], by = y[1] - sy * z[1];
    const __m128 cx = x[2] - sx * z[2], cy = y[2] - sy * z[2];
    const __m128 u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
    const __m128 least = _mm_min_ps(_mm_min_ps(u, v), w), most = _mm_max_ps(_mm_max_ps(u, v), w);
    const __m128 inside = _mm_or_ps(_mm_cmpge_ps(least, zero), _mm_cmple_ps(most, zero));
    auto met = static_cast<uint32_t>(_mm_movemask_ps(inside));
    if (met == 0) return 0;

    const __m128 edge = _mm_or_ps(_mm_cmpeq_ps(least, zero), _mm_cmpeq_ps(most, zero));
    const auto on_edge = static_cast<uint32_t>(_mm_movemask_ps(edge));
    for (uint32_t left = met; left != 0; left &= left - 1) {
        const auto i = static_cast<uint32_t>(std::countr_zero(left));
        const Vec3 v0 = b.at(0, i), v1 = b.at(1, i), v2 = b.at(2, i);
        t[i] = distance_to_plane(r.sheared.org, r.sheared.dir, r.sheared.kz, v0, v1, v2);
        const bool in_reach = t[i] >= t_min && t[i] <= t_max;
        if (!in_reach || (on_edge >> i & 1 && !distance_to(r.sheared, v0, v1, v2))) met &= ~(1u << i);
    }
    return met;
}

}  // namespace lancer
