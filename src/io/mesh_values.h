// What numbers of mesh files become, whichever format they stand in. What is unfit is kept until the end, as indices
// count it.
#pragma once

#include <cmath>
#include <limits>

#include "core/vec.h"

namespace lancer {

// Unit; zero for what is no direction.
inline Vec3 unit_normal(Vec3d n)
{
    const double size = max_component(abs(n));
    return size > 0 ? to_float(normalize(n / size)) : Vec3{};
}

// Of texture coordinates that are not two finite numbers of float.
inline constexpr Vec2 broken_uv{std::numeric_limits<float>::infinity(), 0};
inline bool is_broken(Vec2 uv) { return uv.x == broken_uv.x; }

inline Vec2 uv_of(double u, double v)
{
    constexpr double largest = std::numeric_limits<float>::max();
    const bool usable = std::abs(u) <= largest && std::abs(v) <= largest;
    return usable ? Vec2{static_cast<float>(u), static_cast<float>(v)} : broken_uv;
}

}  // namespace lancer
