#include "materials/textures/procedural.h"

#include <algorithm>
#include <cmath>

namespace lancer {
namespace {

double looked_up(double x, float scale, float offset)
{
    return x * static_cast<double>(scale) + static_cast<double>(offset);
}

double fraction(double x) { return x - std::floor(x); }

// Part of an interval around x in which the fractional part is less than `width`.
double covered(double x, double extent, double width)
{
    if (std::isinf(extent)) return width;
    const double a = fraction(x - 0.5 * extent), b = a + extent;
    if (!(b > a)) return fraction(x) < width ? 1 : 0;
    const double cells = std::floor(b);
    return std::clamp((cells * width + std::min(b - cells, width) - std::min(a, width)) / extent, 0.0, 1.0);
}

// 1 at the origin, 0 where the distance to the power of 0.6 exceeds `reach`.
double fading(double x, double y, double reach) { return std::max(reach - std::pow(x * x + y * y, 0.3), 0.0) / reach; }

// Area of the intersection of the rectangle (x0, x1) x (y0, y1) with the triangle x >= 0, y >= 0, x + y <= side.
double area_in_triangle(double x0, double x1, double y0, double y1, double side)
{
    if (!(side > 0)) return 0;
    if (x0 >= 0 && y0 >= 0 && x1 + y1 <= side) return (x1 - x0) * (y1 - y0);
    const auto below = [side](double x, double y) {
        const double a = std::clamp(x, 0.0, side), b = std::clamp(y, 0.0, side);
        if (a + b <= side) return a * b;
        return 0.5 * (side * side - (side - a) * (side - a) - (side - b) * (side - b));
    };
    return below(x1, y1) - below(x0, y1) - below(x1, y0) + below(x0, y0);
}

constexpr double two_pi = 2 * pi_d;

}  // namespace

Color Grid::eval(Vec2d uv, Footprint footprint) const
{
    const double x = looked_up(uv.x, scale.x, offset.x), y = looked_up(uv.y, scale.y, offset.y);
    const auto w = static_cast<double>(width);
    double part;
    if (faded) {
        const double near = fading(x, y, 20);
        part = near * (fraction(x) < w || fraction(y) < w ? 1 : 0) + (1 - near) * w;
    } else {
        const auto extent = [&](float along, float factor) {
            return std::hypot(static_cast<double>(footprint.width), static_cast<double>(along)) *
                   static_cast<double>(std::abs(factor));
        };
        part = 1 - (1 - covered(x, extent(footprint.along.x, scale.x), w)) *
                       (1 - covered(y, extent(footprint.along.y, scale.y), w));
    }
    return ground + (band - ground) * static_cast<float>(part);
}

Color Rim::eval(Vec2d uv, Footprint footprint) const
{
    const auto w = static_cast<double>(width), half = 0.5 * static_cast<double>(faded ? 0 : footprint.width);
    const double x = uv.x, y = 1 - uv.y;
    const double x0 = x - half, x1 = x + half, y0 = y - half, y1 = y + half;
    const double whole = area_in_triangle(x0, x1, y0, y1, 1);
    float part = x < w || y < w || 1 - x - y < w ? 1 : 0;
    if (whole > 0) {
        const double inner = area_in_triangle(x0 - w, x1 - w, y0 - w, y1 - w, 1 - 3 * w);
        part = static_cast<float>(std::clamp(1 - inner / whole, 0.0, 1.0));
    }
    return {part, part, part};
}

Waves::Waves(const std::vector<Wave>& waves, Vec2 scale, Vec2 offset, bool faded)
    : scale_(scale), offset_(offset), faded_(faded)
{
    for (const Wave& w : waves) {
        const double u = std::cos(w.direction_rad) / w.wavelength, v = std::sin(w.direction_rad) / w.wavelength;
        terms_.push_back(
            {w.amplitude, u * static_cast<double>(scale.x), v * static_cast<double>(scale.y),
             u * static_cast<double>(offset.x) + v * static_cast<double>(offset.y) + w.phase_rad / two_pi});
    }
}

template <class F>
void Waves::for_each(Vec2d uv, Footprint footprint, const F& f) const
{
    const auto width = static_cast<double>(footprint.width);
    const double along_u = static_cast<double>(footprint.along.x), along_v = static_cast<double>(footprint.along.y);
    for (const Term& t : terms_) {
        double left = 1;
        if (!faded_) {
            const double across = (t.turns_u * t.turns_u + t.turns_v * t.turns_v) * width * width;
            const double along = t.turns_u * along_u + t.turns_v * along_v;
            left = std::exp(-2 * pi_d * pi_d * (across + along * along) / 12);
        }
        if (left > 0) f(t, fraction(t.turns_u * uv.x + t.turns_v * uv.y + t.turns), left);
    }
}

Color Waves::eval(Vec2d uv, Footprint footprint) const
{
    double height = 0;
    for_each(uv, footprint, [&](const Term& t, double phase, double left) {
        height += left * t.amplitude * std::cos(two_pi * phase);
    });
    const auto h = static_cast<float>(height);
    return {h, h, h};
}

Vec2 Waves::slope(Vec2d uv, Footprint footprint) const
{
    double u = 0, v = 0;
    for_each(uv, footprint, [&](const Term& t, double phase, double left) {
        const double s = -two_pi * left * t.amplitude * std::sin(two_pi * phase);
        u += s * t.turns_u, v += s * t.turns_v;
    });
    double factor = 1;
    if (faded_)
        factor = fading(looked_up(uv.x, scale_.x, offset_.x), looked_up(uv.y, scale_.y, offset_.y), 100) / two_pi;
    return {static_cast<float>(u * factor), static_cast<float>(v * factor)};
}

}  // namespace lancer
