// refine() of geometry.h for a batch, four triangles at once: the same bits. What is looked up for one hit does not
// wait for another one, and no branch depends on where rays go.
#pragma once

#include <span>

#include "geometry/geometry.h"

namespace lancer {

// hits[i]: what rays[i] met. Spheres and planes stay as they are: first_opaque_hit() gave them refined.
void refine_all(const Geometry& g, std::span<const Ray> rays, std::span<Hit> hits);

}  // namespace lancer
