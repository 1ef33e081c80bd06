// What of a surface a ray stands for, in texture coordinates: what textures are averaged over.
#pragma once

#include "core/vec.h"

namespace lancer {

struct Footprint {
    float width;  // side of a square; 0 for a point
    Vec2 along;   // seen at a slant it is longer: in direction d (unit) its extent is sqrt(width^2 + (d . along)^2)

    constexpr Footprint(float w = 0, Vec2 a = {}) : width(w), along(a) {}
};

}  // namespace lancer
