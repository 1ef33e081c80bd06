// refine() for a batch of hits, four triangles at once, with the same bits. The cache misses of different hits overlap,
// and no branch depends on the rays.
#pragma once

#include <span>

#include "geometry/geometry.h"

namespace lancer {

// Refines hits[i] of rays[i]. Spheres and planes stay unchanged: first_opaque_hit() has refined them.
void refine_all(const Geometry& g, std::span<const Ray> rays, std::span<Hit> hits);

}  // namespace lancer
