// Puts the nodes and leaves of an eight-wide tree into one piece of memory: the root first, the leaves of a node right
// behind it, what lies below its other children after that.
#pragma once

#include <vector>

#include "core/raw_array.h"
#include "geometry/bvh8/collapse.h"
#include "geometry/bvh8/leaf.h"
#include "geometry/bvh8/node.h"

namespace lancer {

struct Bvh8Layout {
    RawArray<std::byte> memory;
    // Of each leaf where it hangs: at its offset in `grain`s, of which no two leaves share one.
    std::vector<Bvh8Slot> slot_of_leaf;
    static constexpr uint64_t grain = sizeof(Bvh8Node) / Bvh8Child::unit;
    static_assert(sizeof(Bvh8Leaf) >= sizeof(Bvh8Node));
    uint64_t bytes = 0;
    double sah_cost = 0;  // as of TriangleTree
    int depth = 0;        // nodes from the root to the deepest one
};

// Throws Error (failed) where the memory would be more than a Bvh8Child can tell.
// Of no triangles: a root without children.
Bvh8Layout lay_out(const SplitTree& tree);

}  // namespace lancer
