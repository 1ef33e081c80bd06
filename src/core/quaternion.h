// Rotations as unit quaternions, to turn evenly from one to another. Shoemake, Animating Rotation with Quaternion
// Curves, 1985.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/vec.h"

namespace lancer {

struct Quaternion {
    double w = 1;
    Vec3d v{};
};

inline double dot(const Quaternion& a, const Quaternion& b) { return a.w * b.w + dot(a.v, b.v); }

// Of the rotation that takes the axes to x, y, z: unit, at right angles, right-handed. The largest component is
// computed first, so that no root of a small number is divided by.
inline Quaternion rotation_to(Vec3d x, Vec3d y, Vec3d z)
{
    const std::array squares{1 + x.x + y.y + z.z, 1 + x.x - y.y - z.z, 1 - x.x + y.y - z.z, 1 - x.x - y.y + z.z};
    const auto largest = std::max_element(squares.begin(), squares.end());
    const double root = std::sqrt(*largest), part = 0.5 / root;
    switch (largest - squares.begin()) {
        case 0:
            return {0.5 * root, {(y.z - z.y) * part, (z.x - x.z) * part, (x.y - y.x) * part}};
        case 1:
            return {(y.z - z.y) * part, {0.5 * root, (x.y + y.x) * part, (z.x + x.z) * part}};
        case 2:
            return {(z.x - x.z) * part, {(x.y + y.x) * part, 0.5 * root, (y.z + z.y) * part}};
        default:
            return {(x.y - y.x) * part, {(z.x + x.z) * part, (y.z + z.y) * part, 0.5 * root}};
    }
}

inline Vec3d rotate(const Quaternion& q, Vec3d p)
{
    const Vec3d t = 2.0 * cross(q.v, p);
    return p + q.w * t + cross(q.v, t);
}

// Weights of the two ends of an arc of this angle, at the part u of it; the angle is less than pi.
inline std::array<double, 2> arc_weights(double angle, double u)
{
    const double sine = std::sin(angle);
    if (!(sine > 0)) return {1 - u, u};  // the ends are one
    return {std::sin((1 - u) * angle) / sine, std::sin(u * angle) / sine};
}

// From a (u = 0) to b (u = 1) at constant speed, the shorter way round.
inline Quaternion slerp(const Quaternion& a, Quaternion b, double u)
{
    if (dot(a, b) < 0) b = {-b.w, -b.v};
    // From the difference and the sum, as an arc cosine is blind to small angles.
    const Quaternion less{a.w - b.w, a.v - b.v}, more{a.w + b.w, a.v + b.v};
    const double angle = 2 * std::atan2(std::sqrt(dot(less, less)), std::sqrt(dot(more, more)));
    const auto [wa, wb] = arc_weights(angle, u);
    return {wa * a.w + wb * b.w, wa * a.v + wb * b.v};
}

// The same for directions, unit. Between opposite ones the way round is arbitrary.
inline Vec3d slerp(Vec3d a, Vec3d b, double u)
{
    const double angle = 2 * std::atan2(length(a - b), length(a + b));
    if (!(length(cross(a, b)) > 0) && dot(a, b) < 0) {
        const Vec3d side = std::abs(a.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
        const Vec3d across = normalize(cross(a, side));
        return std::cos(u * angle) * a + std::sin(u * angle) * across;
    }
    const auto [wa, wb] = arc_weights(angle, u);
    return wa * a + wb * b;
}

}  // namespace lancer
