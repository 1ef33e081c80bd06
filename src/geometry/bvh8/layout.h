// Memory layout of a Bvh8: the root first, the leaves of a node right behind it, then the subtrees of its other
// children.
#pragma once

#include <vector>

#include "core/raw_array.h"
#include "geometry/bvh8/collapse.h"
#include "geometry/bvh8/leaf.h"
#include "geometry/bvh8/node.h"

namespace lancer {

struct Bvh8Layout {
    RawArray<std::byte> memory;
    // The parent slot of each leaf, indexed by its offset in units of `grain`, which is unique.
    std::vector<Bvh8Slot> slot_of_leaf;
    static constexpr uint64_t grain = sizeof(Bvh8Node) / Bvh8Child::unit;
    static_assert(sizeof(Bvh8Leaf) >= sizeof(Bvh8Node));
    uint64_t bytes = 0;
    double sah_cost = 0;  // as in TriangleTree
    int depth = 0;        // number of nodes from the root to the deepest one
};

// Throws Error (failed) if the memory exceeds the range of Bvh8Child. Without triangles: a root without children.
Bvh8Layout lay_out(const SplitTree& tree);

}  // namespace lancer
