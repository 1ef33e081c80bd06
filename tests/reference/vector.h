// Vectors and colours of the reference integrator, in double. None of it is shared with the program that it judges.
#pragma once

#include <cmath>
#include <numbers>

namespace reference {

inline constexpr double pi = std::numbers::pi;

struct Vec {
    double x = 0, y = 0, z = 0;
};
constexpr Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec operator-(Vec a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec operator*(Vec a, double s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr Vec operator*(double s, Vec a) { return a * s; }
constexpr double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec cross(Vec a, Vec b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double norm(Vec a) { return std::sqrt(dot(a, a)); }
inline Vec unit(Vec a) { return a * (1 / norm(a)); }
// w mirrored about the unit vector n.
constexpr Vec mirror_image(Vec w, Vec n) { return 2 * dot(w, n) * n - w; }

// Two directions that make a right-handed frame with a unit z. Hughes and Moeller, "Building an Orthonormal Basis from
// a Unit Vector", JGT 4(4), 1999.
struct Basis {
    Vec x, y, z;

    explicit Basis(Vec axis) : z(axis)
    {
        x = unit(std::abs(z.x) > std::abs(z.z) ? Vec{-z.y, z.x, 0} : Vec{0, -z.z, z.y});
        y = cross(z, x);
    }
    Vec to_world(Vec v) const { return v.x * x + v.y * y + v.z * z; }
    Vec to_local(Vec v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
};

struct Rgb {
    double r = 0, g = 0, b = 0;
};
constexpr Rgb operator+(Rgb a, Rgb b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
constexpr Rgb operator-(Rgb a, Rgb b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
constexpr Rgb operator*(Rgb a, Rgb b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
constexpr Rgb operator*(Rgb a, double s) { return {a.r * s, a.g * s, a.b * s}; }
constexpr Rgb operator*(double s, Rgb a) { return a * s; }
constexpr Rgb& operator+=(Rgb& a, Rgb b) { return a = a + b; }
constexpr Rgb grey(double v) { return {v, v, v}; }
constexpr double largest(Rgb a) { return a.r > a.g ? (a.r > a.b ? a.r : a.b) : (a.g > a.b ? a.g : a.b); }
constexpr bool black(Rgb a) { return a.r == 0 && a.g == 0 && a.b == 0; }
// Rec. 709.
constexpr double luminance(Rgb c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

}  // namespace reference
