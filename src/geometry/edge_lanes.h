// Triangles on whose edges rays in lanes run, as far as float can tell.
#pragma once

#include "core/lanes/lanes.h"

namespace lancer {

// In each lane a triangle's corners, of a ray that is the third axis of a sheared space: see triangle_float.h.
struct ShearedLanes {
    Float8 ax, ay, bx, by, cx, cy;
};

// Those of the lanes whose triangles contain the origin by the signs of the edge functions in double.
uint32_t contain_origin(uint32_t lanes, const ShearedLanes& s);

}  // namespace lancer
