// A place on a light, or a direction towards one, as light sampling found it.
#pragma once

#include "core/color.h"
#include "core/vec.h"

namespace lancer {

struct LightSample {
    Vec3 wi;                  // unit, from the surface to the light
    Vec3 point{}, p_error{};  // on the light; unused if infinite
    Vec3 n{};                 // normal of the light there, for the offset of the shadow ray's end; 0 for a point light
    bool infinite = false;
    Color radiance;      // unoccluded radiance; for a delta light the irradiance on a surface that faces it
    float pdf = 0;       // per solid angle, including the selection; 1 x selection for a delta light
    bool delta = false;  // BSDF sampling cannot hit it
    uint32_t light = 0;  // id
};

// What a delta light sends towards a place, not dimmed by distance: for the discs of a background's glow and the
// classic integrators of --legacy.
struct UndimmedLight {
    Vec3 way;       // to the light; unit if that is infinitely far away
    Color color;    // intensity in file units, or irradiance
    bool infinite;  // it is infinitely far away
};

}  // namespace lancer
