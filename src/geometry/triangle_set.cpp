#include "geometry/triangle_set.h"

#include <cmath>
#include <utility>

#include "core/error.h"

namespace lancer {

TriangleSet::TriangleSet(const Geometry& g, std::vector<uint32_t> meshes) : g_(&g), meshes_(std::move(meshes))
{
    uint64_t count = 0;
    for (const uint32_t m : meshes_) {
        first_.push_back(static_cast<uint32_t>(count));
        count += g.meshes[m].triangles.size();
    }
    if (count > UINT32_MAX) throw Error(ErrorKind::failed, {}, "too many triangles for one tree");
    first_.push_back(static_cast<uint32_t>(count));
}

bool TriangleSet::is_finite(uint32_t number) const
{
    for (const Vec3& p : corners(number))
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
    return true;
}

}  // namespace lancer
