// Rays, and the offset of ray origins from surfaces.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/lanes/vec.h"

namespace lancer {

// The points org + t dir with t_min <= t <= t_max. dir is a unit vector up to rounding. t_min is not 0 but far below
// the resolution of float: a ray never hits its own origin, although the interval is closed.
struct Ray {
    Vec3 org;
    float t_min = 0x1p-60f;
    Vec3 dir;
    float t_max = std::numeric_limits<float>::infinity();
    uint32_t key = 0;  // address of the random numbers of the stochastic alpha test
    // Hit::leaf_hint of the surface on which the ray starts, as the same accelerator returned it. The traversal may
    // start in that leaf. no_leaf_hint: it starts at the root.
    uint32_t leaf_hint = no_leaf_hint;
    static constexpr uint32_t no_leaf_hint = UINT32_MAX;
    // In [0, 1) between the shutter's opening and its closing; where things move, see geometry/motion.h.
    float time = 0;
};

// Upper limit of coordinates, below the magnitude that Embree treats as infinite.
inline constexpr float largest_traceable = 1.8e18f;

// Whether accelerators accept the ray: all numbers but t_max are finite, and the direction is not 0. T: float or
// Float8, for which the result is a mask.
template <class T>
auto is_traceable(const Vec3T<T>& org, const Vec3T<T>& dir, T t_min, T t_max)
{
    const T zero{}, limit = broadcast_to<T>(largest_traceable);
    const auto limited = [&](const Vec3T<T>& v) {
        return (abs(v.x) < limit) & (abs(v.y) < limit) & (abs(v.z) < limit);
    };
    return limited(org) & limited(dir) & ((dir.x != zero) | (dir.y != zero) | (dir.z != zero)) & (t_min >= zero) &
           (t_min < broadcast_to<T>(std::numeric_limits<float>::infinity())) & (t_max >= t_min);
}
inline bool is_traceable(const Ray& r) { return is_traceable(r.org, r.dir, r.t_min, r.t_max) != 0; }

// Bound of the relative error of n roundings in float: n u / (1 - n u), u = 2^-24.
// Higham, "Accuracy and Stability of Numerical Algorithms", section 3.1.
constexpr float gamma(int n)
{
    const float nu = static_cast<float>(n) * 0x1p-24f;
    return nu / (1 - nu);
}

// The next float after x in the direction of the sign of `by`; x itself where `by` is 0. It replaces std::nextafter(),
// whose branches on signs cannot be predicted for incoherent rays.
inline float next_towards(float x, float by)
{
    if (by == 0) return x;
    if (x == 0 || !(std::abs(x) < std::numeric_limits<float>::infinity()))
        return std::nextafter(x, std::copysign(std::numeric_limits<float>::infinity(), by));
    const int32_t bits = std::bit_cast<int32_t>(x);
    const int32_t outwards = ((bits ^ std::bit_cast<int32_t>(by)) >> 31) | 1;  // -1 where x and by differ in sign
    return std::bit_cast<float>(bits + outwards);
}

// The same for eight lanes. Values that are not finite stay unchanged.
inline Float8 next_towards(Float8 x, Float8 by)
{
    const Mask8 bits = reinterpret_cast<Mask8>(x), direction = reinterpret_cast<Mask8>(by);
    const Float8 zero{};
    // Unsigned arithmetic: the bits of -0 have no predecessor; the result for zeros is discarded below.
    const UInt8 outwards = reinterpret_cast<UInt8>(((bits ^ direction) >> 31) | 1);
    const Float8 next = reinterpret_cast<Float8>(reinterpret_cast<UInt8>(bits) + outwards);
    const Float8 from_zero = reinterpret_cast<Float8>((direction & INT32_MIN) | 1);
    const Mask8 stays = (by == zero) | ~(abs(x) < std::numeric_limits<float>::infinity());
    // Compares bits: with denormals-are-zero a denormal would compare equal to 0.
    return select(stays, x, select((bits << 1) == 0, from_zero, next));
}

// Origin of a ray that leaves a surface in direction w: p is moved along n by the bound `error` (absolute, per axis) of
// its rounding error, then to the next float outwards. n is a unit vector; w decides the side. Pharr, Jakob, Humphreys,
// "Physically Based Rendering", 4th ed., section 6.8.6.
template <class T>
[[gnu::always_inline]] inline Vec3T<T> offset_origin(Vec3T<T> p, Vec3T<T> error, Vec3T<T> n, Vec3T<T> w)
{
    const T d = dot(abs(n), error);
    const Vec3T<T> offset = n * select(dot(w, n) < T{}, -d, d);
    return {next_towards(p.x + offset.x, offset.x), next_towards(p.y + offset.y, offset.y),
            next_towards(p.z + offset.z, offset.z)};
}

}  // namespace lancer
