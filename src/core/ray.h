// A ray, and where the next one starts.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/lanes/vec.h"

namespace lancer {

// Points org + t dir with t_min <= t <= t_max. dir is unit up to rounding.
// t_min is not 0 but far below what float can tell: a ray never hits where it starts, though the interval is closed.
struct Ray {
    Vec3 org;
    float t_min = 0x1p-60f;
    Vec3 dir;
    float t_max = std::numeric_limits<float>::infinity();
    uint32_t key = 0;  // address of the random numbers that decide whether half-transparent surfaces stop it
    // Hit::leaf_hint of what it starts on, of the accelerator that is asked: its search may begin there. Or nowhere.
    uint32_t leaf_hint = no_leaf_hint;
    static constexpr uint32_t no_leaf_hint = UINT32_MAX;
};

// Of coordinates: below the magnitude that Embree takes for infinite.
inline constexpr float largest_traceable = 1.8e18f;

// What accelerators accept: all finite but t_max.
inline bool is_traceable(const Ray& r)
{
    constexpr float limit = largest_traceable;
    const auto ok = [](Vec3 v) { return std::abs(v.x) < limit && std::abs(v.y) < limit && std::abs(v.z) < limit; };
    return ok(r.org) && ok(r.dir) && (r.dir.x != 0 || r.dir.y != 0 || r.dir.z != 0) && r.t_min >= 0 &&
           r.t_min < std::numeric_limits<float>::infinity() && r.t_max >= r.t_min;
}

// Bound of the relative error of n roundings in float: n u / (1 - n u), u = 2^-24.
// Higham, "Accuracy and Stability of Numerical Algorithms", section 3.1.
constexpr float gamma(int n)
{
    const float nu = static_cast<float>(n) * 0x1p-24f;
    return nu / (1 - nu);
}

// The next float beyond x in the direction of the sign of `by`; x itself where that is 0. std::nextafter() without its
// branches on signs, which no processor can predict where rays go all ways.
inline float next_towards(float x, float by)
{
    if (by == 0) return x;
    if (x == 0 || !(std::abs(x) < std::numeric_limits<float>::infinity()))
        return std::nextafter(x, std::copysign(std::numeric_limits<float>::infinity(), by));
    const int32_t bits = std::bit_cast<int32_t>(x);
    const int32_t outwards = ((bits ^ std::bit_cast<int32_t>(by)) >> 31) | 1;  // -1 where x and by differ in sign
    return std::bit_cast<float>(bits + outwards);
}

// The same of each lane. What is not finite stays as it is: no ray starts there.
inline Float8 next_towards(Float8 x, Float8 by)
{
    const Mask8 bits = reinterpret_cast<Mask8>(x), direction = reinterpret_cast<Mask8>(by);
    const Float8 zero{};
    // Unsigned, as the bits of -0 have no number below; what comes of them is not taken.
    const UInt8 outwards = reinterpret_cast<UInt8>(((bits ^ direction) >> 31) | 1);
    const Float8 next = reinterpret_cast<Float8>(reinterpret_cast<UInt8>(bits) + outwards);
    const Float8 from_zero = reinterpret_cast<Float8>((direction & INT32_MIN) | 1);
    const Mask8 stays = (by == zero) | ~(abs(x) < std::numeric_limits<float>::infinity());
    // By its bits: where denormals count as zero, they still have neighbours.
    return select(stays, x, select((bits << 1) == 0, from_zero, next));
}

// Origin of a ray that leaves a surface towards w: p moved along n by the bound `error` (absolute, per axis) of p's
// own rounding, then to the next number outwards. Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed.,
// section 6.8.6. n is unit; w decides the side.
template <class T>
[[gnu::always_inline]] inline Vec3T<T> offset_origin(Vec3T<T> p, Vec3T<T> error, Vec3T<T> n, Vec3T<T> w)
{
    const T d = dot(abs(n), error);
    const Vec3T<T> offset = n * select(dot(w, n) < T{}, -d, d);
    return {next_towards(p.x + offset.x, offset.x), next_towards(p.y + offset.y, offset.y),
            next_towards(p.z + offset.z, offset.z)};
}

}  // namespace lancer
