#include "support/meshes.h"

namespace lancer {

Mesh to_mesh(const MeshData& data, const Transform& m)
{
    Mesh mesh;
    for (const Vec3d& p : data.positions) mesh.positions.push_back(to_float(m.point(p)));
    mesh.positions.emplace_back();
    mesh.triangles = data.triangles;
    return mesh;
}

Mesh triangle_mesh(Vec3 a, Vec3 b, Vec3 c)
{
    Mesh mesh;
    mesh.positions = {a, b, c, {}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

}  // namespace lancer
