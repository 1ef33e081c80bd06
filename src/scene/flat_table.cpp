#include "scene/flat_table.h"

#include "scene/scene.h"

namespace lancer {
namespace {

// Larger tables would evict other data from the caches.
constexpr size_t most = 2048;

bool is_fit(const Geometry& g)
{
    if (!g.instances.empty() || !g.spheres.empty() || !g.planes.empty() || g.meshes.size() > float_lanes) return false;
    size_t count = 0;
    for (const Mesh& mesh : g.meshes) count += mesh.triangles.size();
    return count <= most;
}

Row row(Vec3 v, float w) { return {v.x, v.y, v.z, w}; }

}  // namespace

FlatTable FlatTable::of(const Scene& scene)
{
    FlatTable table;
    if (scene.has_normals || !is_fit(scene.geometry)) return table;
    for (uint32_t m = 0; m < scene.geometry.meshes.size(); ++m) {
        const Mesh& mesh = scene.geometry.meshes[m];
        table.first_[m] = static_cast<uint32_t>(table.records_.size());
        for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const auto& corners = mesh.triangles[t];
            const auto corner = [&](size_t k) { return mesh.positions[corners[k]]; };
            const uint32_t material = scene.shading[m].material_of(t);
            const uint32_t shines = scene.emission[material].is_dark() ? 0 : UINT32_MAX;
            const TriangleInteraction place = triangle_interaction(scene, Hit::no_instance, m, t, {});
            const float rounding = PointOnTriangle<float>::rounding(corner(0), corner(1), corner(2));
            table.records_.push_back({{row(corner(0), std::bit_cast<float>(material)), row(corner(1), rounding),
                                       row(corner(2), std::bit_cast<float>(shines)), row(place.n, place.area)}});
        }
    }
    return table;
}

}  // namespace lancer
