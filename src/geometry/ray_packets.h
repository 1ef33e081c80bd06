// Packets of eight rays with the same largest axis, so that a triangle is permuted once for all of them.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "geometry/ray_lanes.h"

namespace lancer {

// Eight rays in a space whose third axis is their common largest one; see ShearedRay in triangle_float.h.
struct ShearedPacket {
    RayPacket rays;              // in world space
    Mask8 valid;                 // active and traceable lanes
    std::array<size_t, 3> axes;  // as in AxisOrder
    Vec3x8 org;
    Float8 sx, sy, sz;  // shear of the ray, and 1 / dir.z
    Vec3x8 length;      // absolute values of dir

    // One to eight rays with the same largest_axis().
    ShearedPacket(std::span<const Ray> all, std::span<const uint32_t> which)
        : rays(all, which), valid(is_traceable(rays) & first_lanes(which.size()))
    {
        const auto& order = axis_order(all[which[0]].dir).axes;
        axes = {order[0], order[1], order[2]};
        const auto turned = [&](const Vec3x8& v) {
            const std::array<Float8, 3> a{v.x, v.y, v.z};
            return Vec3x8{a[axes[0]], a[axes[1]], a[axes[2]]};
        };
        org = turned(rays.org);
        const Vec3x8 dir = turned(rays.dir);
        sz = 1.0f / dir.z, sx = dir.x * sz, sy = dir.y * sz;
        length = {abs(dir.x), abs(dir.y), abs(dir.z)};
    }
};

// Calls f(which) for packets of one to eight rays with the same largest_axis() until all rays are covered.
template <class F>
void for_each_packet(std::span<const Ray> rays, const F& f)
{
    constexpr size_t most = 512;
    std::array<std::array<uint32_t, most>, 3> of_axis;
    for (size_t first = 0; first < rays.size(); first += most) {
        std::array<size_t, 3> count{};
        for (size_t i = first; i < std::min(first + most, rays.size()); ++i) {
            const size_t axis = axis_order(rays[i].dir).axes[2];
            of_axis[axis][count[axis]++] = static_cast<uint32_t>(i);
        }
        for (size_t axis = 0; axis < 3; ++axis)
            for (size_t i = 0; i < count[axis]; i += float_lanes)
                f(std::span<const uint32_t>(of_axis[axis]).subspan(i, std::min<size_t>(float_lanes, count[axis] - i)));
    }
}

}  // namespace lancer
