#include "geometry/same_shapes.h"

#include <algorithm>
#include <cstring>

namespace lancer {
namespace {

// The entry behind the last vertex is there to be read by Embree, and has no value.
bool is_same(const Mesh& a, const Mesh& b)
{
    if (a.rows != b.rows || a.instanced != b.instanced || a.vertices() != b.vertices()) return false;
    return std::memcmp(a.positions.data(), b.positions.data(), a.vertices() * a.rows * sizeof(Vec3)) == 0 &&
           a.triangles == b.triangles;
}
bool is_same(const Transform& a, const Transform& b) { return std::memcmp(&a, &b, sizeof(Transform)) == 0; }
bool is_same(const Instance& a, const Instance& b) { return a.mesh == b.mesh && is_same(a.to_world, b.to_world); }
bool is_same(const Sphere& a, const Sphere& b) { return a.center == b.center && a.radius == b.radius; }
bool is_same(const Plane& a, const Plane& b) { return a.normal == b.normal && a.offset == b.offset; }

template <class Shape>
bool is_same(const std::vector<Shape>& a, const std::vector<Shape>& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Shape& x, const Shape& y) { return is_same(x, y); });
}

}  // namespace

bool has_same_opaque_shapes(const Geometry& a, const Geometry& b)
{
    return !a.alpha_test.passes_through && !b.alpha_test.passes_through && is_same(a.meshes, b.meshes) &&
           is_same(a.instances, b.instances) && is_same(a.spheres, b.spheres) && is_same(a.planes, b.planes) &&
           is_same(a.motion.instances, b.motion.instances) && is_same(a.motion.spheres, b.motion.spheres);
}

}  // namespace lancer
