// Linear RGB with Rec. 709 primaries: radiance (W / m^2 sr), intensity (W / sr) or a reflectance in [0, 1].
#pragma once

#include <algorithm>
#include <cmath>

namespace lancer {

struct Color {
    float r = 0, g = 0, b = 0;

    constexpr Color& operator+=(Color o) { return *this = {r + o.r, g + o.g, b + o.b}; }
    constexpr Color& operator*=(Color o) { return *this = {r * o.r, g * o.g, b * o.b}; }
    constexpr Color& operator*=(float s) { return *this = {r * s, g * s, b * s}; }
    constexpr Color& operator/=(float s) { return *this = {r / s, g / s, b / s}; }
    friend constexpr bool operator==(const Color&, const Color&) = default;
};

constexpr Color operator+(Color a, Color b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
constexpr Color operator-(Color a, Color b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
constexpr Color operator*(Color a, Color b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
constexpr Color operator*(Color a, float s) { return {a.r * s, a.g * s, a.b * s}; }
constexpr Color operator*(float s, Color a) { return a * s; }
constexpr Color operator/(Color a, float s) { return {a.r / s, a.g / s, a.b / s}; }

// Rec. 709 luminance.
constexpr float luminance(Color c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }
constexpr double luminance(double r, double g, double b) { return 0.2126 * r + 0.7152 * g + 0.0722 * b; }
constexpr float max_component(Color c) { return std::max(c.r, std::max(c.g, c.b)); }
// From a at t = 0 to b at t = 1: a itself where both are the same, and never below 0 for a, b >= 0 and t in [0, 1].
constexpr float mix(float a, float b, float t) { return a + (b - a) * t; }
constexpr double mix(double a, double b, double t) { return a + (b - a) * t; }
constexpr Color mix(Color a, Color b, float t) { return {mix(a.r, b.r, t), mix(a.g, b.g, t), mix(a.b, b.b, t)}; }
constexpr bool is_black(Color c) { return c.r == 0 && c.g == 0 && c.b == 0; }
inline bool is_finite(Color c) { return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b); }

}  // namespace lancer
