// What the tests of single trees share: triangles to build them over.
#pragma once

#include "geometry/accelerators.h"
#include "geometry/triangle_set.h"

namespace lancer {

Geometry of_mesh(Mesh mesh);
inline TriangleSet all_of(const Geometry& g) { return TriangleSet(g, {0}); }

// Triangles of all sizes and shapes that overlap a lot: what spatial splits are for.
Mesh tangle(uint64_t seed, uint32_t count);

}  // namespace lancer
