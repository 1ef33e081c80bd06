// What the tests of single trees share: triangles to build them over.
#pragma once

#include "geometry/accelerators.h"
#include "geometry/triangle_set.h"

namespace lancer {

inline Geometry of_mesh(Mesh mesh)
{
    Geometry g;
    g.meshes.push_back(std::move(mesh));
    return g;
}
inline TriangleSet all_of(const Geometry& g) { return TriangleSet(g, {0}); }

// Triangles of all sizes and shapes that overlap a lot: what spatial splits are for.
inline Mesh tangle(uint64_t seed, uint32_t count)
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
