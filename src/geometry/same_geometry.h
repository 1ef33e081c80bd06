// Whether two scenes have the same shapes, so that an accelerator of one serves the other.
#pragma once

#include "geometry/geometry.h"

namespace lancer {

// Bit by bit. Never of geometry with an alpha test, which asks the scene that it belongs to.
bool is_same_geometry(const Geometry& a, const Geometry& b);

}  // namespace lancer
