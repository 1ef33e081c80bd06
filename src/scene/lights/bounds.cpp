#include "scene/lights/bounds.h"

#include <algorithm>
#include <cmath>

namespace lancer {

void Cone::include(const Cone& other)
{
    if (other.empty()) return;
    if (empty()) {
        *this = other;
        return;
    }
    const double between = std::acos(std::clamp(dot(axis, other.axis), -1.0, 1.0));
    if (std::min(between + other.angle, pi_d) <= angle) return;
    if (std::min(between + angle, pi_d) <= other.angle) {
        *this = other;
        return;
    }
    const double wide = (angle + between + other.angle) / 2;
    const Vec3d around = cross(axis, other.axis);
    const double length_around = length(around);
    if (wide >= pi_d || !(length_around > 0)) {
        angle = pi_d;
        return;
    }
    // The axis turned towards the other one: Rodrigues' formula, the axis of rotation being perpendicular to it.
    const double turn = wide - angle;
    axis = normalize(axis * std::cos(turn) + cross(around / length_around, axis) * std::sin(turn));
    angle = wide;
}

double LightBounds::cost(int axis) const
{
    const Vec3d e = box.upper - box.lower;
    const double area = 2 * (e.x * e.y + e.y * e.z + e.z * e.x);
    const double o = normals.angle, w = std::min(o + pi_d / 2, pi_d);
    const double directions =
        2 * pi_d * (1 - std::cos(o)) +
        pi_d / 2 * (2 * w * std::sin(o) - std::cos(o - 2 * w) - 2 * o * std::sin(o) + std::cos(o));
    const double along = e[axis];
    return power * directions * area * (along > 0 ? max_component(e) / along : 1);
}

}  // namespace lancer
