// Vectors of two and three numbers. Vec3 is float, as stored and traced; Vec3d is double, for loading and for
// shapes whose intersection needs it.
#pragma once

#include <algorithm>
#include <cmath>

namespace lancer {

struct Vec2 {
    float x = 0, y = 0;
    friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
};
constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vec2 operator*(Vec2 a, float s) { return {a.x * s, a.y * s}; }

// Texture coordinates in double: on a plane they may be millions and must still resolve the position between two
// texels.
struct Vec2d {
    double x = 0, y = 0;

    constexpr Vec2d() = default;
    constexpr Vec2d(double a, double b) : x(a), y(b) {}
    constexpr Vec2d(Vec2 v) : x(v.x), y(v.y) {}
    friend constexpr bool operator==(const Vec2d&, const Vec2d&) = default;
};

template <class T>
struct Vec3T {
    T x{}, y{}, z{};

    constexpr T operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
    constexpr Vec3T& operator+=(Vec3T b) { return *this = {x + b.x, y + b.y, z + b.z}; }
    constexpr Vec3T& operator-=(Vec3T b) { return *this = {x - b.x, y - b.y, z - b.z}; }
    constexpr Vec3T& operator*=(T s) { return *this = {x * s, y * s, z * s}; }
    constexpr Vec3T& operator/=(T s) { return *this = {x / s, y / s, z / s}; }
    friend constexpr bool operator==(const Vec3T&, const Vec3T&) = default;
};

using Vec3 = Vec3T<float>;
using Vec3d = Vec3T<double>;

template <class T>
constexpr Vec3T<T> operator+(Vec3T<T> a, Vec3T<T> b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
constexpr Vec3T<T> operator-(Vec3T<T> a, Vec3T<T> b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
constexpr Vec3T<T> operator-(Vec3T<T> a)
{
    return {-a.x, -a.y, -a.z};
}
template <class T>
constexpr Vec3T<T> operator*(Vec3T<T> a, T s)
{
    return {a.x * s, a.y * s, a.z * s};
}
template <class T>
constexpr Vec3T<T> operator*(T s, Vec3T<T> a)
{
    return a * s;
}
template <class T>
constexpr Vec3T<T> operator/(Vec3T<T> a, T s)
{
    return {a.x / s, a.y / s, a.z / s};
}

template <class T>
constexpr T dot(Vec3T<T> a, Vec3T<T> b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
constexpr Vec3T<T> cross(Vec3T<T> a, Vec3T<T> b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T length(Vec3T<T> a)
{
    return std::sqrt(dot(a, a));
}
// The zero vector gives NaN; callers check where it can occur. Always inlined: passing vectors through memory stalls.
template <class T>
[[gnu::always_inline]] inline Vec3T<T> normalize(Vec3T<T> a)
{
    return a * (1 / length(a));
}
template <class T>
Vec3T<T> abs(Vec3T<T> a)
{
    return {std::abs(a.x), std::abs(a.y), std::abs(a.z)};
}
template <class T>
constexpr T max_component(Vec3T<T> a)
{
    return std::max(a.x, std::max(a.y, a.z));
}
template <class T>
bool is_finite(Vec3T<T> a)
{
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

constexpr Vec3d to_double(Vec3 a) { return {a.x, a.y, a.z}; }
constexpr Vec3 to_float(Vec3d a) { return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)}; }

inline constexpr float pi = 3.14159265358979323846f;
inline constexpr double pi_d = 3.14159265358979323846;

// The axis of the largest component.
template <class T>
int largest_axis(const Vec3T<T>& dir)
{
    const Vec3T<T> m = abs(dir);
    return m.x > m.y ? (m.x > m.z ? 0 : 2) : (m.y > m.z ? 1 : 2);
}

}  // namespace lancer
