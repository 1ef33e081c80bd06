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
        sz_ = 1 / dir[z];
        sx_ = dir[axes_[0]] * sz_, sy_ = dir[axes_[1]] * sz_;
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
        return within(leaf, a, inside, t_max, t);
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

    // Of the lanes those that meet their planes in [t_min, t_max]. In float by differences of the corners, which are
    // almost exact; where its own bound of the error is too wide for that, or the place too close to where the ray
    // starts (the plane of a needle errs by more than rays start off it), in double.
    uint32_t within(const Bvh8Leaf& leaf, const Point& a, uint32_t lanes, float t_max, std::array<float, 8>& t) const
    {
        const auto side = [&](size_t to, size_t axis) {
            return load8(leaf.corners[to][axes_[axis]].data()) - load8(leaf.corners[0][axes_[axis]].data());
        };
        const Float8 ex = side(1, 0), ey = side(1, 1), ez = side(1, 2);
        const Float8 gx = side(2, 0), gy = side(2, 1), gz = side(2, 2);
        const Float8 sx = all_lanes(sx_), sy = all_lanes(sy_);
        const Float8 n[3] = {ey * gz - ez * gy, ez * gx - ex * gz, ex * gy - ey * gx};
        const Float8 m[3] = {abs(ey * gz) + abs(ez * gy), abs(ez * gx) + abs(ex * gz), abs(ex * gy) + abs(ey * gx)};
        const Float8 scale = all_lanes(sz_) / (n[0] * sx + n[1] * sy + n[2]);
        const Float8 distance = (n[0] * a.x + n[1] * a.y + n[2] * a.z) * scale;
        const Float8 of_place = m[0] * abs(a.x) + m[1] * abs(a.y) + m[2] * abs(a.z);
        const Float8 of_slope = m[0] * abs(sx) + m[1] * abs(sy) + m[2];
        const Float8 error =
            gamma(8) * abs(scale) * (of_place + abs(distance) * of_slope * all_lanes(std::abs(1 / sz_)));
        const Float8 low = distance - error, high = distance + error, reach = all_lanes(t_max);
        lanes &= ~(bits(high < all_lanes(ray_.t_min)) | bits(low > reach));
        _mm256_storeu_ps(t.data(), distance);
        uint32_t met = lanes & bits((error < distance * 0x1p-17f) & (low > all_lanes(ray_.t_min)) & (high < reach));
        for (uint32_t unsure = lanes & ~met; unsure; unsure &= unsure - 1) {
            const auto i = static_cast<size_t>(std::countr_zero(unsure));
            const auto at = [&](size_t k) {
                const auto& p = leaf.corners[k];
                return Vec3{p[0][i], p[1][i], p[2][i]};
            };
            t[i] = distance_to_plane(ray_.org, ray_.dir, static_cast<int>(axes_[2]), at(0), at(1), at(2));
            met |= uint32_t{t[i] >= ray_.t_min && t[i] <= t_max} << i;
        }
        return met;
    }

    std::array<size_t, 3> axes_;  // the last is that along which the ray goes most
    std::array<float, 3> org_;    // along those
    float sx_, sy_, sz_;
    const Ray& ray_;
};

}  // namespace lancer
