// The footprint of a ray cone in texture coordinates, over which textures are filtered.
#pragma once

#include "core/vec.h"

namespace lancer {

struct Footprint {
    float width;  // side of a square; 0: a point
    Vec2 along;   // elongation at grazing angles: its extent in direction d (unit) is sqrt(width^2 + (d . along)^2)

    constexpr Footprint(float w = 0, Vec2 a = {}) : width(w), along(a) {}
};

}  // namespace lancer
