// Rays in SIMD registers: one ray as it lies in memory, or eight rays as structure of arrays.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include "core/lanes/lanes.h"
#include "core/lanes/pack.h"
#include "core/ray.h"

namespace lancer {

static_assert(offsetof(Ray, t_min) == offsetof(Ray, org) + 12 && offsetof(Ray, t_max) == offsetof(Ray, dir) + 12);

inline Float4 org_and_t_min(const Ray& r) { return load4(&r.org.x); }
inline Float4 dir_and_t_max(const Ray& r) { return load4(&r.dir.x); }

// Eight rays as structure of arrays.
struct RayPacket {
    Vec3T<Float8> org, dir;
    Float8 t_min, t_max;

    // One to eight rays; the last one fills the remaining lanes.
    explicit RayPacket(std::span<const Ray> rays)
        : RayPacket(rays.size(), [&](size_t i) -> const Ray& { return rays[i]; })
    {
    }
    // The rays with these indices, likewise.
    RayPacket(std::span<const Ray> rays, std::span<const uint32_t> which)
        : RayPacket(which.size(), [&](size_t i) -> const Ray& { return rays[which[i]]; })
    {
    }

private:
    template <class At>
    RayPacket(size_t count, const At& at)
    {
        const auto ray = [&](size_t i) -> const Ray& { return at(std::min(i, count - 1)); };
        const auto turn = [&](auto of, Vec3T<Float8>& v, Float8& behind) {
            const RowLanes rows = transpose([&](size_t i) { return of(ray(i)); });
            v = rows.xyz, behind = rows.w;
        };
        turn([](const Ray& r) { return org_and_t_min(r); }, org, t_min);
        turn([](const Ray& r) { return dir_and_t_max(r); }, dir, t_max);
    }
};

// Directions of eight consecutive rays.
inline Vec3T<Float8> directions_of_eight(const Ray* rays)
{
    return transpose([&](size_t i) { return dir_and_t_max(rays[i]); }).xyz;
}

inline Mask8 is_traceable(const RayPacket& r) { return is_traceable(r.org, r.dir, r.t_min, r.t_max); }

// Writes the selected rays, in order, and returns their number; their keys stay unchanged. to: room for eight rays;
// entries behind the last one are undefined.
inline size_t store_rays(Ray* to, uint32_t wanted, const Vec3T<Float8>& org, const Vec3T<Float8>& dir, Float8 t_max)
{
    const Packing packing(wanted);
    const auto turn = [&](const Vec3T<Float8>& v, Float8 behind, auto&& number) {
        const std::array<Float8, 4> columns{packing(v.x), packing(v.y), packing(v.z), behind};
        const std::array<Float8, 4> pairs = transpose4x4(columns);  // of ray i and ray i + 4
        for (size_t i = 0; i < pairs.size(); ++i) {
            store4(number(to[i]), lower(pairs[i]));
            store4(number(to[i + 4]), upper(pairs[i]));
        }
    };
    turn(org, broadcast(Ray{}.t_min), [](Ray& r) { return &r.org.x; });
    turn(dir, packing(t_max), [](Ray& r) { return &r.dir.x; });
    return static_cast<size_t>(std::popcount(wanted));
}

// Sets Ray::leaf_hint of rays that store_rays() wrote; without a loop over their unpredictable number. to: likewise.
inline void store_leaf_hints(Ray* to, uint32_t wanted, UInt8 start)
{
    const UInt8 packed = Packing(wanted)(start);
    for (size_t i = 0; i < float_lanes; ++i) to[i].leaf_hint = packed[i];
}

// A right-handed order of the axes in which the third one is the ray's largest.
struct alignas(16) AxisOrder {
    std::array<uint32_t, 4> axes;

    Float4 operator()(Float4 v) const { return permute(v, load4_aligned(axes.data())); }
};

// By largest_axis(), without branches, which could not be predicted.
inline const AxisOrder& axis_order(Vec3 dir)
{
    static constexpr std::array<AxisOrder, 4> of{{{{1, 2, 0, 3}}, {{2, 0, 1, 3}}, {{0, 1, 2, 3}}, {{0, 1, 2, 3}}}};
    const Vec3 m = abs(dir);
    const auto y = static_cast<size_t>(!(m.x > m.y)), z = static_cast<size_t>(!(std::max(m.x, m.y) > m.z));
    return of[y | z << 1];
}

}  // namespace lancer
