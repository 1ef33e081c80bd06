// Closed meshes and places strictly inside them: from there every ray must hit something, whatever it is aimed at.
#pragma once

#include <map>

#include "support/addressed.h"
#include "support/double_tree.h"
#include "support/meshes.h"

namespace lancer {

// Whether every edge has an even number of triangles; corners in the same place count as one.
bool is_closed(const Mesh& mesh);

// All of a mesh moved; every corner is then rounded to float where it comes to lie.
Mesh moved(const Mesh& mesh, Vec3d by);

double distance_to_segment(Vec3d p, Vec3d a, Vec3d b);
double distance_to_triangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c);

struct Ball {
    Vec3d center;
    double radius;
};

// Balls within a closed mesh, by address: `count` of them or, in a mesh with little room, fewer or none. A ball's
// centre is inside if lines from it cross the surface an odd number of times; its radius is half its distance from the
// surface, and far above the rounding of its coordinates. The Geometry holds one mesh.
std::vector<Ball> balls_inside(const Geometry& g, uint32_t count, uint64_t seed = 1);

}  // namespace lancer
