// A block of four triangles and its ray test: the operations of triangle_float.h in the same order, and therefore with
// its bits.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "core/lanes/lanes.h"
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
    const float sx = r.sheared.sx, sy = r.sheared.sy;
    Float4 x[3], y[3], z[3];  // corners relative to the ray's origin, before the shear
    for (int k = 0; k < 3; ++k) {
        x[k] = load4_aligned(b.corner[k][r.axis[0]]) - r.org[0];
        y[k] = load4_aligned(b.corner[k][r.axis[1]]) - r.org[1];
        z[k] = load4_aligned(b.corner[k][r.axis[2]]) - r.org[2];
    }
    const Float4 ax = x[0] - sx * z[0], ay = y[0] - sy * z[0];
    const Float4 bx = x[1] - sx * z[1], by = y[1] - sy * z[1];
    const Float4 cx = x[2] - sx * z[2], cy = y[2] - sy * z[2];
    const Float4 u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
    const Float4 least = min(min(u, v), w), most = max(max(u, v), w);
    uint32_t met = movemask((least >= 0.0f) | (most <= 0.0f));
    if (met == 0) return 0;

    const uint32_t on_edge = movemask((least == 0.0f) | (most == 0.0f));
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
