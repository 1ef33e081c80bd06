// Mappings from the unit square to other domains, with their densities.
#pragma once

#include "core/lanes/vec.h"

namespace lancer {

template <class T>
struct SinCosT {
    T sin, cos;
};
using SinCos = SinCosT<float>;

// Sine and cosine of 2 pi u for u in [0, 1]: quadrant and polynomial (the coefficients are those of Cephes' sinf and
// cosf), so that every machine gets the same bits. Error below 2^-23.
template <class T>
inline SinCosT<T> sin_cos_2pi(T u)
{
    const T t = u * 4.0f;
    const T q = nearest(t);
    const T a = (t - q) * 1.57079632679489661923f, a2 = a * a;
    const T s = a + a * a2 * (-1.6666654611e-1f + a2 * (8.3321608736e-3f - a2 * 1.9515295891e-4f));
    const T c = 1.0f - 0.5f * a2 +
                a2 * a2 * (4.166664568298827e-2f + a2 * (-1.388731625493765e-3f + a2 * 2.443315711809948e-5f));
    // Selects polynomial and sign without branches, which could not be predicted.
    const auto quadrant = to_whole(q);
    const auto odd = is_odd(quadrant);
    return {negated(select(odd, c, s), quadrant >> 1 & 1u), negated(select(odd, s, c), (quadrant + 1u) >> 1 & 1u)};
}

// Unit disk, uniform: Shirley and Chiu's concentric map.
inline Vec2 square_to_disk(Vec2 u)
{
    const float a = 2 * u.x - 1, b = 2 * u.y - 1;
    if (a == 0 && b == 0) return {};
    const bool wide = std::abs(a) > std::abs(b);
    const float r = wide ? a : b;
    const float turn = wide ? 0.125f * (b / a) : 0.25f - 0.125f * (a / b);  // angle / 2 pi
    const SinCos sc = sin_cos_2pi(turn < 0 ? turn + 1 : turn);
    return {r * sc.cos, r * sc.sin};
}

// Hemisphere around z, density cos / pi.
template <class T>
inline Vec3T<T> square_to_cosine_hemisphere(T u, T v)
{
    const T r = sqrt(u);
    const SinCosT<T> sc = sin_cos_2pi(v);
    return {r * sc.cos, r * sc.sin, sqrt(larger(T{}, 1.0f - u))};
}
inline Vec3 square_to_cosine_hemisphere(Vec2 u) { return square_to_cosine_hemisphere(u.x, u.y); }
template <class T>
inline T pdf_cosine_hemisphere(T cos_theta)
{
    return larger(T{}, cos_theta) * (1 / pi);
}

// By the cosine to z and a part of the azimuth, both in [0, 1].
inline Vec3 direction_at(float cos, float turn)
{
    const float r = std::sqrt((1 - cos) * (1 + cos));
    const SinCos sc = sin_cos_2pi(turn);
    return {r * sc.cos, r * sc.sin, cos};
}

// Barycentric weights of the second and third corner, uniform over the triangle: the low-distortion map of Heitz,
// "A Low-Distortion Map Between Triangle and Square", 2019. Density 1 / area.
// V: Vec2 or Vec2x8.
template <class V>
V square_to_triangle(const V& u)
{
    const auto above = u.x < u.y;
    const auto half = select(above, u.x, u.y) * 0.5f;
    return {select(above, half, u.x - half), select(above, u.y - half, half)};
}

// The point of the square that square_to_triangle() maps to these weights.
inline Vec2 triangle_to_square(Vec2 weights)
{
    const float sum = weights.x + weights.y;
    return weights.x < weights.y ? Vec2{2 * weights.x, sum} : Vec2{sum, 2 * weights.y};
}

// 1 - cos of the half angle of the cone under which a sphere is seen, given sin^2 of that angle in [0, 1]; without the
// cancellation that makes the plain formula useless for far or small spheres.
template <class T>
T one_minus_cos(T sin2)
{
    return sin2 / (1 + sqrt(larger(T{}, 1 - sin2)));
}

// Polar angle in the cone with the given 1 - cos(theta_max), uniform in solid angle: 1 - cos(theta) for u in [0, 1).
// Density 1 / (2 pi (1 - cos(theta_max))).
template <class T>
T square_to_cone(T u, T one_minus_cos_max)
{
    return u * one_minus_cos_max;
}
template <class T>
T pdf_cone(T one_minus_cos_max)
{
    return 1 / (2 * pi_d * one_minus_cos_max);
}

// Unit sphere, uniform, density 1 / (4 pi).
inline Vec3 square_to_sphere(Vec2 u)
{
    const float z = 1 - 2 * u.x;
    const float r = 2 * std::sqrt(std::max(0.0f, u.x * (1 - u.x)));
    const SinCos sc = sin_cos_2pi(u.y);
    return {r * sc.cos, r * sc.sin, z};
}
inline constexpr float pdf_sphere = 1 / (4 * pi);

}  // namespace lancer
