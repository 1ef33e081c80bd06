// What is known of a group of lights without looking at each: where they lie, which way they shine, how much.
// Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", 2018; Physically Based
// Rendering, 4th ed., section 12.6.3.
#pragma once

#include "core/bounds.h"

namespace lancer {

// Directions around an axis; empty at first.
struct Cone {
    Vec3d axis{0, 0, 1};  // unit
    double angle = -1;    // radians, pi for all directions; negative: none

    bool empty() const { return angle < 0; }
    // The smallest cone around both, about.
    void include(const Cone& other);
};

// Each light sends out light within 90 degrees of a direction of the cone.
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
    // By which to tell good groups from bad ones: power times the area of the box times the directions lit, with the
    // box's longest side over that along `axis`, against long thin groups.
    double cost(int axis) const;
};

}  // namespace lancer
