// Whether an accelerator of one geometry serves another.
#pragma once

#include "geometry/geometry.h"

namespace lancer {

// Whether both have the same shapes in the same places, in the same order, and none that lets rays through: what an
// accelerator knows of them.
bool has_same_opaque_shapes(const Geometry& a, const Geometry& b);

}  // namespace lancer
