// Bounds of a group of lights: position, emission directions, power. Conty Estevez and Kulla, "Importance Sampling of
// Many Lights with Adaptive Tree Splitting", 2018; Physically Based Rendering, 4th ed., section 12.6.3.
#pragma once

#include "core/bounds.h"

namespace lancer {

// A cone of directions; empty by default.
struct Cone {
    Vec3d axis{0, 0, 1};  // unit
    double angle = -1;    // radians, pi for all directions; negative: none

    bool empty() const { return angle < 0; }
    // Extends the cone to (approximately) the smallest one around both.
    void include(const Cone& other);
};

// Each light emits within 90 degrees of a direction of the cone.
struct LightBounds {
    Bounds box;
    Cone normals;
    bool both_sides = false;
    double power = 0;

    void include(const LightBounds& other)
    {
        box.grow(other.box);
        normals.include(other.normals);
        both_sides = both_sides || other.both_sides;
        power += other.power;
    }
    // Cost of a group for building the tree: power times the area of the box times the solid angle, times the box's
    // longest side over that along `axis` to penalise long thin groups.
    double cost(int axis) const;
};

}  // namespace lancer
