// The lie of the land in the forest, in metres: what grows, its path's mask and the ground itself depend on it.
#pragma once

#include "make_common.h"

// The forest's path runs away from the eye, towards -z; x of its middle.
inline double path_x(double z) { return 0.5 + 2.4 * std::sin(-z * 0.12 - 0.35) + 0.9 * std::sin(-z * 0.043); }
// How far the clearing in front of the eye reaches from there, in metres; negative within.
inline double outside_clearing(double x, double z)
{
    const double dx = (x + 1.0) / 1.35, dz = z + 7.5;
    return std::sqrt(dx * dx + dz * dz) - 6.0;
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
