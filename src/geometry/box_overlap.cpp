#include "geometry/box_overlap.h"

#include <cmath>

#include "core/bounds.h"
#include "core/parallel.h"

namespace lancer {
namespace {

struct Sum {
    double surplus = 0;
    Bounds bounds;
};

// Half of the surface area.
double half_surface(Vec3d d) { return d.x * d.y + d.y * d.z + d.z * d.x; }

Sum sum_of(const Mesh& mesh, size_t first, size_t end)
{
    Sum s;
    for (size_t i = first; i < end; ++i) {
        const auto& t = mesh.triangles[i];
        const Vec3d a = to_double(mesh.positions[t[0]]), b = to_double(mesh.positions[t[1]]),
                    c = to_double(mesh.positions[t[2]]);
        Bounds box;
        box.grow(a), box.grow(b), box.grow(c);
        const Vec3d twice = cross(b - a, c - a);
        const double surplus =
            half_surface(box.upper - box.lower) - (std::abs(twice.x) + std::abs(twice.y) + std::abs(twice.z));
        if (!std::isfinite(surplus)) continue;
        s.surplus += surplus;
        s.bounds.grow(box);
    }
    return s;
}

}  // namespace

double false_positive_box_hits(const Geometry& g)
{
    constexpr size_t part = 1 << 16;
    Sum all;
    for (const Mesh& mesh : g.meshes) {
        if (mesh.instanced) continue;
        const size_t count = mesh.triangles.size();
        std::vector<Sum> sums((count + part - 1) / part);
        parallel_for(sums.size(), [&](size_t i) { sums[i] = sum_of(mesh, i * part, std::min(count, (i + 1) * part)); });
        for (const Sum& s : sums) all.surplus += s.surplus, all.bounds.grow(s.bounds);
    }
    if (all.bounds.empty()) return 0;
    const double whole = half_surface(all.bounds.upper - all.bounds.lower);
    return whole > 0 ? all.surplus / whole : 0;
}

}  // namespace lancer
