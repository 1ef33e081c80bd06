// Builders of binary BVHs. build_median splits the longest axis in the middle. build_sah minimises the surface area
// heuristic over 32 bins along each axis: Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", IEEE
// RT 2007. Both give the same tree for any number of threads and respect BinaryTree::max_depth: a node is halved by
// count if a split would leave too many primitives for the remaining levels.
#pragma once

#include <vector>

#include "geometry/bvh2/box_lanes.h"
#include "geometry/bvh2/tree.h"

namespace lancer {

// `first` of a leaf is the index in `order` of its first primitive.
struct BuiltTree {
    BinaryTree tree;
    std::vector<uint32_t> order;  // indices of the primitives
};

// Nodes with at most leaf_size primitives (at least 1) become leaves; a leaf costs about as much as a node. Boxes may
// be infinite, but not NaN. Must not be called inside a parallel loop.
BuiltTree build_median(std::vector<BoxedPrimitive> primitives, uint32_t leaf_size);
BuiltTree build_sah(std::vector<BoxedPrimitive> primitives, uint32_t leaf_size);

}  // namespace lancer
