// The lie of the land in the forest, in metres: what grows, its path's mask and the ground itself depend on it.
#pragma once

#include "make_common.h"

// The forest's path runs away from the eye, towards -z; x of its middle.
inline double path_x(double z) { return 0.5 + 2.4 * std::sin(-z * 0.12 - 0.35) + 0.9 * std::sin(-z * 0.043); }
// How far away the nearest of two clearings is, in metres, negative within: one before the eye, one down the path.
inline double outside_clearing(double x, double z)
{
    const auto outside = [&](double cx, double cz, double wide, double reach) {
        return std::hypot((x - cx) / wide, z - cz) - reach;
    };
    return std::fmin(outside(-1.0, -7.5, 1.35, 6.0), outside(1.2, -31, 1.2, 5.0));
}

// Height of the ground: a shallow valley along the path, hummocks, and slopes that close the view.
inline double ground(double x, double z)
{
    const double off = x - path_x(z), beside = between(0.6, 2.4, std::fabs(off));
    const double slopes = 6.5 * between(9, 60, std::fabs(off)) + 7.0 * between(30, 78, -z);
    const double hummocks = 0.55 * (fractal(x * 0.16 + 40, z * 0.16 + 40, 3, 64, 71) - 0.5) +
                            0.30 * (fractal(x * 0.6 + 40, z * 0.6 + 40, 3, 128, 72) - 0.5);
    const double rut = 0.05 * std::cos(std::fmin(std::fabs(off) * 4.2, pi));
    return slopes + hummocks * (0.25 + 0.75 * beside) + 0.16 * beside - rut;
}

constexpr double ground_reach = 80;
