// The triangles of one tree: those of all non-instanced meshes, or of one instanced mesh in its own space.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/geometry.h"

namespace lancer {

class TriangleSet {
public:
    struct Id {
        uint32_t mesh, triangle;  // indices in the Geometry and in the mesh
    };

    // meshes: indices, ascending. Triangles are numbered in order of (mesh, triangle). The Geometry must outlive the
    // set. Throws Error (failed) for 2^32 triangles or more.
    TriangleSet(const Geometry& g, std::vector<uint32_t> meshes);

    uint32_t size() const { return first_.back(); }
    Id id(uint32_t number) const
    {
        size_t k = 0;
        for (size_t n = meshes_.size(); n > 1;) {  // binary search of its mesh
            const size_t half = n / 2;
            k = first_[k + half] <= number ? k + half : k;
            n -= half;
        }
        return {meshes_[k], number - first_[k]};
    }
    std::array<Vec3, 3> corners(uint32_t number) const
    {
        const Id i = id(number);
        const Mesh& m = g_->meshes[i.mesh];
        const auto& t = m.triangles[i.triangle];
        return {m.positions[t[0]], m.positions[t[1]], m.positions[t[2]]};
    }
    // Trees skip triangles that are not finite.
    bool is_finite(uint32_t number) const;

private:
    const Geometry* g_;
    std::vector<uint32_t> meshes_, first_;  // first_: index of each mesh's first triangle, then the total
};

// What a tree over a TriangleSet offers; TreeAccelerator makes an accelerator of it. No answer depends on how many
// threads built it.
//   explicit Tree(const TriangleSet&);   may copy what it needs; not from inside a parallel loop
//   void closest(const Ray&, float& t_max, const Found& found) const;
//       found(number, t) for triangles that the ray meets at t in [ray.t_min, t_max], in any order, perhaps more than
//       once; where it says true, t_max becomes t. No triangle may be left out that is met before the t_max of the end.
//   bool any(const Ray&, const Found& found) const;
//       whether found(number, t) was true of any triangle met in [ray.t_min, ray.t_max]; asks no more after that
//   uint64_t bytes() const;    of the tree
//   double sah_cost() const;   expected cost of a random line that meets the tree's box: a node 1, a triangle 1
template <class T>
concept TriangleTree = requires(const T t, const Ray& ray, float& t_max, bool (*found)(uint32_t, float))
{
    t.closest(ray, t_max, found);
    {
        t.any(ray, found)
        } -> std::same_as<bool>;
    {
        t.bytes()
        } -> std::same_as<uint64_t>;
    {
        t.sah_cost()
        } -> std::same_as<double>;
}
&&std::is_constructible_v<T, const TriangleSet&>;

}  // namespace lancer
