// Eight triangles and a ray's test of them all at once: distance_to() of triangle_float.h in eight lanes.
#pragma once

#include <array>
#include <bit>

#include "core/lanes.h"
#include "geometry/triangle_float.h"

namespace lancer {

// Numbers ascend. Corners that are NaN stand for triangles that there are not.
struct alignas(32) Bvh8Leaf {
    std::array<std::array<std::array<float, 8>, 3>, 3> corners;  // of a corner x, then y, then z
    std::array<uint32_t, 8> numbers;
};

// What of a ray all leaves share.
class LeafRay {
public:
    explicit LeafRay(const Ray& ray) : ray_(ray)
    {
        // As ShearedRay, without branches: nobody can predict the largest axis of a ray.
        const std::array org{ray.org.x, ray.org.y, ray.org.z}, dir{ray.dir.x, ray.dir.y, ray.dir.z};
        const Vec3 m = abs(ray.dir);
        const size_t z = m.z > std::max(m.x, m.y) ? 2 : m.y > m.x;
        constexpr std::array<size_t, 5> around{0, 1, 2, 0, 1};
        axes_ = {around[z + 1], around[z + 2], z};
        const float sz = 1 / dir[z];
        sx_ = dir[axes_[0]] * sz, sy_ = dir[axes_[1]] * sz;
        org_ = {org[axes_[0]], org[axes_[1]], org[z]};
    }

    // Bit i: triangle i is met in [t_min, t_max], at distance t[i].
    uint32_t meets(const Bvh8Leaf& leaf, float t_max, std::array<float, 8>& t) const
    {
        const auto corner = [&](size_t k) {
            const auto& c = leaf.corners[k];
            return Point{load8(c[axes_[0]].data()) - all_lanes(org_[0]), load8(c[axes_[1]].data()) - all_lanes(org_[1]),
                         load8(c[axes_[2]].data()) - all_lanes(org_[2])};
        };
        const Point a = corner(0), b = corner(1), c = corner(2);
        const Float8 sx = all_lanes(sx_), sy = all_lanes(sy_);
        const Float8 ax = minus_product(sx, a.z, a.x), ay = minus_product(sy, a.z, a.y);
        const Float8 bx = minus_product(sx, b.z, b.x), by = minus_product(sy, b.z, b.y);
        const Float8 cx = minus_product(sx, c.z, c.x), cy = minus_product(sy, c.z, c.y);
        // Not fused: so the edge between two triangles is the same number with the other sign, and its sign is right
        // or it is 0.
        const Float8 u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
        const Float8 least = min(u, min(v, w)), most = max(u, max(v, w)), zero{};
        uint32_t inside = bits_le(zero, least) | bits_le(most, zero);
        if (!inside) return 0;
        if (const uint32_t on_edge = inside & (bits_eq(least, zero) | bits_eq(most, zero)))
            inside &= ~on_edge | confirm(on_edge, {ax, ay, bx, by, cx, cy});
        // Of the few that are left, in double: in float the plane of a needle errs by more than rays start off it.
        for (uint32_t left = inside; left; left &= left - 1) {
            const auto i = static_cast<size_t>(std::countr_zero(left));
            const auto at = [&](size_t k) {
                const auto& p = leaf.corners[k];
                return Vec3{p[0][i], p[1][i], p[2][i]};
            };
            t[i] = distance_to_plane(ray_.org, ray_.dir, static_cast<int>(axes_[2]), at(0), at(1), at(2));
            if (!(t[i] >= ray_.t_min && t[i] <= t_max)) inside &= ~(uint32_t{1} << i);
        }
        return inside;
    }

private:
    struct Point {
        Float8 x, y, z;  // along the sheared axes
    };
    struct Sheared {
        Float8 ax, ay, bx, by, cx, cy;
    };
    // Those of the lanes whose triangles contain the origin by the signs in double.
    static uint32_t confirm(uint32_t lanes, const Sheared& s);

    std::array<size_t, 3> axes_;  // the last is that along which the ray goes most
    std::array<float, 3> org_;    // along those
    float sx_, sy_;
    const Ray& ray_;
};

}  // namespace lancer
