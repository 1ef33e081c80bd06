// Geometry from the meshes of scenes: what tests and benchmarks trace without a scene around it.
#pragma once

#include "geometry/geometry.h"
#include "support/scenes.h"

namespace lancer {

inline Mesh to_mesh(const MeshData& data, const Transform& m = {})
{
    Mesh mesh;
    for (const Vec3d& p : data.positions) mesh.positions.push_back(to_float(m.point(p)));
    mesh.positions.emplace_back();
    mesh.triangles = data.triangles;
    return mesh;
}
inline Mesh triangle_mesh(Vec3 a, Vec3 b, Vec3 c)
{
    Mesh mesh;
    mesh.positions = {a, b, c, {}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}
inline Instance make_instance(uint32_t mesh, const Transform& to_world) { return {mesh, to_world, inverse(to_world)}; }

}  // namespace lancer
