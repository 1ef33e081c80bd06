// Measures how loosely bounding boxes fit the triangles of a scene: whether spatial splits pay off.
#pragma once

#include "geometry/geometry.h"

namespace lancer {

// Expected number of false-positive box hits of a random line: hits of boxes of single triangles beyond those of tight
// axis-aligned triangles, which fill half of their box. It is the sum of the excess surface of the boxes divided by the
// surface of the box of all (a line hits convex bodies in proportion to their surface). It is 0 for axis-aligned walls,
// small for many small triangles and large for long slanted ones. Only non-instanced meshes count; triangles that are
// not finite are ignored.
double false_positive_box_hits(const Geometry& g);

}  // namespace lancer
