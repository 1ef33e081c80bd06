// Triangles whose edges rays hit within the rounding of float, for SIMD lanes.
#pragma once

#include "core/lanes/lanes.h"

namespace lancer {

// The corners of a triangle in each lane, in the sheared space of a ray; see triangle_float.h.
struct ShearedLanes {
    Float8 ax, ay, bx, by, cx, cy;
};

// The lanes whose triangle contains the origin by the signs of the edge functions in double.
uint32_t contain_origin(uint32_t lanes, const ShearedLanes& s);

}  // namespace lancer
