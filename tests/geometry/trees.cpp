#include "geometry/trees.h"

namespace lancer {

Geometry of_mesh(Mesh mesh)
{
    Geometry g;
    g.meshes.push_back(std::move(mesh));
    return g;
}

Mesh tangle(uint64_t seed, uint32_t count)
{
    Random random(seed);
    Mesh mesh;
    for (uint32_t i = 0; i < count; ++i) {
        const Vec3d at = random.point(-1, 1);
        const double size = std::abs(random.log_uniform(-3, 0));
        for (uint32_t k = 0; k < 3; ++k) mesh.positions.push_back(to_float(at + random.point(-size, size)));
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    mesh.positions.emplace_back();
    return mesh;
}

}  // namespace lancer
