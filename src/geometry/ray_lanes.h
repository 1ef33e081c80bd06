// Rays in registers: one, with its numbers as they lie in memory, the fourth lanes holding what comes behind; or eight.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <limits>
#include <span>

#include "core/lanes.h"
#include "core/ray.h"

namespace lancer {

static_assert(offsetof(Ray, t_min) == offsetof(Ray, org) + 12 && offsetof(Ray, t_max) == offsetof(Ray, dir) + 12);

inline Float4 org_and_t_min(const Ray& r) { return load4(&r.org.x); }
inline Float4 dir_and_t_max(const Ray& r) { return load4(&r.dir.x); }

// Eight rays, a number of each to a register.
struct RayOctet {
    Vec3T<Float8> org, dir;
    Float8 t_min, t_max;

    // One to eight of them; the last one fills the lanes that are left.
    explicit RayOctet(std::span<const Ray> rays)
    {
        const auto ray = [&](size_t i) -> const Ray& { return rays[std::min(i, rays.size() - 1)]; };
        const auto rows = [&](size_t i, auto of) {
            return _mm256_insertf128_ps(_mm256_castps128_ps256(of(ray(i))), of(ray(i + 4)), 1);
        };
        const auto turn = [&](auto of, Vec3T<Float8>& v, Float8& behind) {
            const __m256 a = rows(0, of), b = rows(1, of), c = rows(2, of), d = rows(3, of);
            const __m256 xy0 = _mm256_unpacklo_ps(a, b), zw0 = _mm256_unpackhi_ps(a, b);
            const __m256 xy2 = _mm256_unpacklo_ps(c, d), zw2 = _mm256_unpackhi_ps(c, d);
            v.x = _mm256_shuffle_ps(xy0, xy2, 0x44), v.y = _mm256_shuffle_ps(xy0, xy2, 0xee);
            v.z = _mm256_shuffle_ps(zw0, zw2, 0x44), behind = _mm256_shuffle_ps(zw0, zw2, 0xee);
        };
        turn([](const Ray& r) { return org_and_t_min(r); }, org, t_min);
        turn([](const Ray& r) { return dir_and_t_max(r); }, dir, t_max);
    }
};

// Of each ray whether accelerators accept it: is_traceable() of a single one.
inline Mask8 is_traceable(const Vec3T<Float8>& org, const Vec3T<Float8>& dir, Float8 t_min, Float8 t_max)
{
    const auto limited = [](const Vec3T<Float8>& v) {
        const Float8 limit = all_lanes(largest_traceable);
        return (abs(v.x) < limit) & (abs(v.y) < limit) & (abs(v.z) < limit);
    };
    const Float8 zero{};
    return limited(org) & limited(dir) & ((dir.x != zero) | (dir.y != zero) | (dir.z != zero)) & (t_min >= zero) &
           (t_min < all_lanes(std::numeric_limits<float>::infinity())) & (t_max >= t_min);
}
inline Mask8 is_traceable(const RayOctet& r) { return is_traceable(r.org, r.dir, r.t_min, r.t_max); }

// Writes the wanted rays, in order, and says how many; their keys stay what they are.
inline size_t store_rays(Ray* to, uint32_t wanted, const Vec3T<Float8>& org, const Vec3T<Float8>& dir, Float8 t_max)
{
    alignas(32) std::array<std::array<float, 4>, 2 * float_lanes> rows;  // of org, then of dir
    const auto turn = [&](const Vec3T<Float8>& v, Float8 behind, size_t first) {
        const __m256 xy0 = _mm256_unpacklo_ps(v.x, v.y), xy2 = _mm256_unpackhi_ps(v.x, v.y);
        const __m256 zw0 = _mm256_unpacklo_ps(v.z, behind), zw2 = _mm256_unpackhi_ps(v.z, behind);
        const auto store = [&](size_t i, __m256 two) {
            _mm_store_ps(rows[first + i].data(), _mm256_castps256_ps128(two));
            _mm_store_ps(rows[first + i + 4].data(), _mm256_extractf128_ps(two, 1));
        };
        store(0, _mm256_shuffle_ps(xy0, zw0, 0x44)), store(1, _mm256_shuffle_ps(xy0, zw0, 0xee));
        store(2, _mm256_shuffle_ps(xy2, zw2, 0x44)), store(3, _mm256_shuffle_ps(xy2, zw2, 0xee));
    };
    turn(org, all_lanes(Ray{}.t_min), 0);
    turn(dir, t_max, float_lanes);
    size_t count = 0;
    for (; wanted != 0; wanted &= wanted - 1, ++count) {
        const auto i = static_cast<size_t>(std::countr_zero(wanted));
        _mm_storeu_ps(&to[count].org.x, _mm_load_ps(rows[i].data()));
        _mm_storeu_ps(&to[count].dir.x, _mm_load_ps(rows[float_lanes + i].data()));
    }
    return count;
}

// The axes of a space in which a ray goes along the third one most; in the order of the hand.
struct alignas(16) AxisOrder {
    std::array<uint32_t, 4> axes;

    Float4 operator()(Float4 v) const
    {
        return _mm_permutevar_ps(v, _mm_load_si128(reinterpret_cast<const __m128i*>(axes.data())));
    }
};

// By largest_axis(), without branches: nobody can predict the largest axis of a ray.
inline const AxisOrder& axis_order(Vec3 dir)
{
    static constexpr std::array<AxisOrder, 4> of{{{{1, 2, 0, 3}}, {{2, 0, 1, 3}}, {{0, 1, 2, 3}}, {{0, 1, 2, 3}}}};
    const Vec3 m = abs(dir);
    const auto y = static_cast<size_t>(!(m.x > m.y)), z = static_cast<size_t>(!(std::max(m.x, m.y) > m.z));
    return of[y | z << 1];
}

}  // namespace lancer
