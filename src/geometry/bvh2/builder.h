// Makes binary trees. `build_median` is the textbook's first tree: the longest axis, cut in the middle. `build_sah`
// takes the cut of least expected cost by the surface area heuristic, out of 32 bins along each axis: Wald, "On fast
// Construction of SAH-based Bounding Volume Hierarchies", IEEE RT 2007. Both give the same tree for any number of
// threads, and both keep to BinaryTree::max_depth: where a cut would leave too many primitives for the levels that
// remain, a node is halved by count instead.
#pragma once

#include <vector>

#include "geometry/bvh2/box_lanes.h"
#include "geometry/bvh2/tree.h"

namespace lancer {

// A leaf's `first` is where its primitives begin in `order`.
struct BuiltTree {
    BinaryTree tree;
    std::vector<uint32_t> order;  // numbers of the primitives
};

// Nodes of at most leaf_size primitives (at least 1) become leaves: they are tested together, at about the cost of one
// more node. Boxes may be infinite, not NaN. Not from inside a parallel loop.
BuiltTree build_median(std::vector<BoxedPrimitive> primitives, uint32_t leaf_size);
BuiltTree build_sah(std::vector<BoxedPrimitive> primitives, uint32_t leaf_size);

}  // namespace lancer
