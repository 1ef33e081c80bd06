// A block of eight triangles and its ray test: distance_to() of triangle_float.h in eight lanes.
#pragma once

#include <array>
#include <bit>

#include "geometry/edge_lanes.h"
#include "geometry/ray_lanes.h"
#include "geometry/triangle_float.h"

namespace lancer {

// Numbers are ascending. Unused lanes have NaN corners.
struct alignas(32) Bvh8Leaf {
    std::array<std::array<std::array<float, 8>, 3>, 3> corners;  // per corner: x, y, z
    std::array<uint32_t, 8> numbers;
};

// The nearest hit so far: a distance between two bounds of its float error, or exact. Initially the end of the ray.
struct Bvh8Nearest {
    float low, high;
    uint32_t number = UINT32_MAX;  // of the triangle; larger than any if there is none
    const Bvh8Leaf* block = nullptr;
    uint32_t lane = 0;  // lane in the block
};

// The hits of a block.
struct Bvh8Met {
    std::array<float, 8> t, error;  // distances and their errors; error 0: exact
};

// Precomputed data of a ray for leaf tests.
class LeafRay {
public:
    LeafRay() = default;
    [[gnu::always_inline]] explicit LeafRay(const Ray& ray) : order_(&axis_order(ray.dir)), ray_(&ray)
    {
        const Float4 org = (*order_)(org_and_t_min(ray)), dir = (*order_)(dir_and_t_max(ray));
        store4_aligned(org_.data(), org);
        store4_aligned(dir_.data(), dir);
        sz_ = 1 / dir[2];
        store4_aligned(slope_.data(), dir * sz_);
    }

    // Bit i: triangle i is hit, not before t_min and not behind the nearest hit, which itself may be missing in the
    // mask. Distances that float cannot order are compared in double, so that the final result does not depend on the
    // order.
    [[gnu::always_inline]] uint32_t meets(const Bvh8Leaf& leaf, Bvh8Nearest& nearest, Bvh8Met& met) const
    {
        const auto corner = [&](size_t k) {
            const auto along = [&](size_t axis) { return coordinate(leaf, k, axis) - broadcast(org_[axis]); };
            return Point{along(0), along(1), along(2)};
        };
        const Point a = corner(0), b = corner(1), c = corner(2);
        const Float8 sx = broadcast(slope_[0]), sy = broadcast(slope_[1]);
        const Float8 ax = fnmadd(sx, a.z, a.x), ay = fnmadd(sy, a.z, a.y);
        const Float8 bx = fnmadd(sx, b.z, b.x), by = fnmadd(sy, b.z, b.y);
        const Float8 cx = fnmadd(sx, c.z, c.x), cy = fnmadd(sy, c.z, c.y);
        // Without FMA: the edge function of a shared edge has the same magnitude for both triangles, and its sign is
        // correct or it is 0.
        const Float8 u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
        const Float8 least = min(u, min(v, w)), most = max(u, max(v, w)), zero{};
        uint32_t inside = movemask_le(zero, least) | movemask_le(most, zero);
        if (!inside) return 0;
        if (const uint32_t on_edge = inside & (movemask_eq(least, zero) | movemask_eq(most, zero)))
            inside &= ~on_edge | contain_origin(on_edge, {ax, ay, bx, by, cx, cy});
        return within(leaf, a, inside, nearest, met);
    }
    // Computes the exact distances of these lanes.
    void measure(const Bvh8Leaf& leaf, uint32_t lanes, Bvh8Met& met) const
    {
        for_each_lane(lanes, [&](uint32_t i) { met.t[i] = distance(leaf, i), met.error[i] = 0; });
    }

private:
    struct Point {
        Float8 x, y, z;  // along the sheared axes
    };
    // Lanes whose distance lies in the interval. Distances are computed in float from corner differences, which are
    // almost exact; in double where the float error bound is too large or the hit is too close to the ray's origin (the
    // plane of a sliver errs by more than the origin's offset).
    [[gnu::always_inline]] uint32_t within(const Bvh8Leaf& leaf, const Point& a, uint32_t lanes, Bvh8Nearest& nearest,
                                           Bvh8Met& met) const
    {
        const auto side = [&](size_t to, size_t axis) {
            return coordinate(leaf, to, axis) - coordinate(leaf, 0, axis);
        };
        const Float8 ex = side(1, 0), ey = side(1, 1), ez = side(1, 2);
        const Float8 gx = side(2, 0), gy = side(2, 1), gz = side(2, 2);
        const Float8 sx = broadcast(slope_[0]), sy = broadcast(slope_[1]);
        const Float8 n[3] = {ey * gz - ez * gy, ez * gx - ex * gz, ex * gy - ey * gx};
        const Float8 m[3] = {abs(ey * gz) + abs(ez * gy), abs(ez * gx) + abs(ex * gz), abs(ex * gy) + abs(ey * gx)};
        const Float8 scale = broadcast(sz_) / (n[0] * sx + n[1] * sy + n[2]);
        const Float8 distance = (n[0] * a.x + n[1] * a.y + n[2] * a.z) * scale;
        const Float8 of_place = m[0] * abs(a.x) + m[1] * abs(a.y) + m[2] * abs(a.z);
        const Float8 of_slope = m[0] * abs(sx) + m[1] * abs(sy) + m[2];
        const Float8 error =
            gamma(8) * abs(scale) * (of_place + abs(distance) * of_slope * broadcast(std::abs(dir_[2])));
        const Float8 low = distance - error, high = distance + error;
        lanes &= ~(movemask(high < broadcast(ray_->t_min)) | movemask(low > broadcast(nearest.high)));
        store8_anywhere(met.t.data(), distance);
        store8_anywhere(met.error.data(), error);
        uint32_t sure = lanes & movemask((error < distance * most_distance_error) & (low > broadcast(ray_->t_min)) &
                                         (high < broadcast(nearest.low)));
        if (uint32_t unsure = lanes & ~sure) {
            unsure &=
                ~movemask_eq(leaf.numbers, nearest.number);  // a triangle in several leaves is not compared with itself
            if (unsure) sure |= decide(leaf, unsure, nearest, met);
        }
        return sure;
    }
    // The same in double; the distance of the nearest hit becomes exact.
    uint32_t decide(const Bvh8Leaf& leaf, uint32_t lanes, Bvh8Nearest& nearest, Bvh8Met& met) const;
    // Distance of a triangle's plane.
    float distance(const Bvh8Leaf& leaf, uint32_t lane) const;

    Float8 coordinate(const Bvh8Leaf& leaf, size_t corner, size_t axis) const
    {
        return load8(leaf.corners[corner][order_->axes[axis]].data());
    }

    const AxisOrder* order_;
    alignas(16) std::array<float, 4> org_, dir_, slope_;  // in the order of the axes; slope: dir / dir.z
    float sz_;                                            // 1 / dir.z
    const Ray* ray_;
};

}  // namespace lancer
