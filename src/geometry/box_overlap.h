// How badly boxes fit the triangles of a scene: what tells whether a tree that cuts triangles into parts is worth its
// time.
#pragma once

#include "geometry/geometry.h"

namespace lancer {

// Of the boxes of single triangles, how many a random line through all of them meets more than if each triangle lay
// as in a plane of two axes, where it takes half of its box: the sum of what the surfaces of the boxes have too much,
// over the surface of the box of all (lines meet convex bodies in proportion to their surface). 0 for walls along the
// axes, and for many small triangles; grows with long ones that lie at an angle. Of the meshes that are drawn as they
// are; triangles that are not finite count for nothing.
double false_positive_box_hits(const Geometry& g);

}  // namespace lancer
