// The tree of `median` and `bvh2`: a binary BVH whose leaves are blocks of up to four triangles with their corners, so
// that no index into the meshes is followed. The two differ in the builder only.
#pragma once

#include <bit>

#include "geometry/bvh2/builder.h"
#include "geometry/bvh2/triangle_block.h"
#include "geometry/triangle_set.h"

namespace lancer {

class BinaryTriangles {
public:
    template <class Found>
    void closest(const Ray& ray, float& t_max, const Found& found) const
    {
        const BlockRay r(ray);
        tree_.closest(ray, t_max, [&](uint32_t block, uint32_t, float) {
            const TriangleBlock& b = blocks_[block];
            float t[TriangleBlock::size];
            for (uint32_t left = meets(b, r, ray.t_min, t_max, t); left != 0; left &= left - 1) {
                const auto i = static_cast<uint32_t>(std::countr_zero(left));
                if (t[i] <= t_max && found(b.number[i], t[i])) t_max = t[i];
            }
            return t_max;
        });
    }
    template <class Found>
    bool any(const Ray& ray, const Found& found) const
    {
        const BlockRay r(ray);
        return tree_.any(ray, [&](uint32_t block, uint32_t) {
            const TriangleBlock& b = blocks_[block];
            float t[TriangleBlock::size];
            for (uint32_t left = meets(b, r, ray.t_min, ray.t_max, t); left != 0; left &= left - 1) {
                const auto i = static_cast<uint32_t>(std::countr_zero(left));
                if (found(b.number[i], t[i])) return true;
            }
            return false;
        });
    }
    const BinaryTree& tree() const { return tree_; }
    uint64_t bytes() const { return tree_.bytes() + blocks_.size() * sizeof(TriangleBlock); }
    double sah_cost() const { return tree_.sah_cost(); }

protected:
    BinaryTriangles(const TriangleSet& triangles, BuiltTree built);

private:
    BinaryTree tree_;  // `first` of a leaf is its block
    std::vector<TriangleBlock> blocks_;
};

// The boxes of the finite triangles.
std::vector<BoxedPrimitive> boxes_of(const TriangleSet& triangles);

}  // namespace lancer
