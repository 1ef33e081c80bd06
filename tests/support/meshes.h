// Geometry from the meshes of scenes: what tests and benchmarks trace without a scene around it.
#pragma once

#include "geometry/geometry.h"
#include "support/scenes/scenes.h"

namespace lancer {

Mesh to_mesh(const MeshData& data, const Transform& m = {});
Mesh triangle_mesh(Vec3 a, Vec3 b, Vec3 c);
inline Instance make_instance(uint32_t mesh, const Transform& to_world) { return {mesh, to_world, inverse(to_world)}; }

}  // namespace lancer
