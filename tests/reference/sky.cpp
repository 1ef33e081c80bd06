// What comes from infinitely far away: docs/scene-format.md, [[light]] of type "environment" and [background].
#include <array>
#include <vector>

#include "reference/world.h"

namespace reference {
namespace {

struct Stop {
    double height;
    Rgb color;
};

std::vector<Stop> stops_of(lancer::SkyType type)
{
    switch (type) {
        case lancer::SkyType::gradient:
            return {{0, {1, 1, 1}}, {0.5, {0, 0, 1}}, {1, {0, 0, 0}}};
        case lancer::SkyType::dusk:
            return {{0, {1, 1, 1}}, {0.5, {0, 0, 1}}, {1, {0, 0, 0.5}}};
        case lancer::SkyType::dawn:
            return {
                {0, {1, 1, 0.3}}, {0.2, {0.5, 0.1, 0.1}}, {0.4, {0.1, 0.1, 0.2}}, {0.6, {0, 0, 0.1}}, {1, {0, 0, 0.1}}};
        case lancer::SkyType::noon:
            return {{0, {0.75, 0.85, 1}}, {0.3, {0.35, 0.6, 1}}, {1, {0.1, 0.3, 0.8}}};
        default:
            return {{0, {0.04, 0.05, 0.12}}, {0.3, {0.01, 0.015, 0.05}}, {1, {0.002, 0.003, 0.015}}};
    }
}

Rgb sky_at(const lancer::BackgroundDescription& b, double height)
{
    if (b.sky == lancer::SkyType::color) return rgb(b.sky_color);
    const std::vector<Stop> stops = stops_of(b.sky);
    const double h = std::max(0.0, height);
    for (size_t i = 1; i < stops.size(); ++i)
        if (h <= stops[i].height) {
            const double t = (h - stops[i - 1].height) / (stops[i].height - stops[i - 1].height);
            return stops[i - 1].color * (1 - t) + stops[i].color * t;
        }
    return stops.back().color;
}

// d: z up. The squares are as wide as the eye is high.
Rgb ground_at(const lancer::BackgroundDescription& b, Vec d)
{
    if (b.ground == lancer::GroundType::color) return rgb(b.ground_color);
    const double x = -d.x / d.z, y = -d.y / d.z, patterns = std::hypot(x, y) / 2;
    const Rgb horizon = b.fade ? rgb(*b.fade) : sky_at(b, 0);
    const bool is_even = std::fmod(std::floor(x) + std::floor(y), 2) == 0;
    const double t = std::min(1.0, patterns / 30);
    return grey(is_even ? 0.2 : 0.4) * (1 - t) + horizon * t;
}

Rgb disc(Vec a, Vec b, Rgb color)
{
    const double degrees = std::atan2(norm(cross(a, b)), dot(a, b)) * 180 / pi;
    return degrees < 4 ? color * std::pow(1 - degrees / 4, 2) : Rgb{};
}

}  // namespace

// is_seen: by the camera, in mirrors or through glass.
Rgb World::sky(Vec direction, bool is_seen, Vec from) const
{
    Rgb sum = constant_sky;
    if (sky_picture) {
        const Vec d = sky_rotation.back(direction);
        // The middle is +z, +x a quarter of the width from the left.
        const double x = 0.5 - std::atan2(d.x, d.z) / (2 * pi), y = std::acos(std::clamp(d.y, -1.0, 1.0)) / pi;
        sum += sky_factor * sky_picture->between(x * sky_picture->width, y * sky_picture->height, true, false);
    }
    if (background) {
        const Vec d = background->z_up ? direction : Vec{direction.x, -direction.z, direction.y};
        const bool below = d.z < 0 && background->ground != lancer::GroundType::none;
        sum += (below ? ground_at(*background, d) : sky_at(*background, d.z)) * double{background->strength};
    }
    if (glow && is_seen) {
        for (const Directional& l : directionals) sum += disc(l.towards, direction, l.irradiance);
        for (const Point& l : points) sum += disc(unit(l.at - from), direction, l.intensity_towards(unit(from - l.at)));
    }
    return sum;
}

}  // namespace reference
