#include "geometry/same_geometry.h"

#include <algorithm>
#include <cstring>

namespace lancer {
namespace {

// Numbers without padding between them.
template <class T>
bool have_same_bits(const std::vector<T>& a, const std::vector<T>& b)
{
    static_assert(sizeof(T) % sizeof(float) == 0 && std::is_trivially_copyable_v<T>);
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool is_same(const Mesh& a, const Mesh& b)
{
    return a.rows == b.rows && a.instanced == b.instanced && have_same_bits(a.triangles, b.triangles) &&
           have_same_bits(a.positions, b.positions);
}

bool is_same(const Instance& a, const Instance& b)
{
    return a.mesh == b.mesh && std::memcmp(&a.to_world, &b.to_world, sizeof a.to_world) == 0;
}

template <class T>
bool are_same(const std::vector<T>& a, const std::vector<T>& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const T& x, const T& y) { return is_same(x, y); });
}

}  // namespace

bool is_same_geometry(const Geometry& a, const Geometry& b)
{
    if (a.alpha_test.passes_through || b.alpha_test.passes_through) return false;
    return are_same(a.meshes, b.meshes) && are_same(a.instances, b.instances) && have_same_bits(a.spheres, b.spheres) &&
           have_same_bits(a.planes, b.planes);
}

}  // namespace lancer
