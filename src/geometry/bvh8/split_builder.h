// Builds a binary tree over triangles down to single ones, by the surface area heuristic with spatial splits: what
// wider trees are made of. Wald 2007; Stich, Friedrich, Dietrich, "Spatial Splits in Bounding Volume Hierarchies",
// HPG 2009.
#pragma once

#include <utility>
#include <vector>

#include "core/raw_array.h"
#include "geometry/bvh8/split_reference.h"
#include "geometry/triangle_set.h"

namespace lancer {

struct SplitNode {
    FloatBox box;
    uint32_t child = 0;     // number of the first of two children, which lie side by side; 0: a leaf
    uint32_t triangle = 0;  // of a leaf: its number in the TriangleSet

    bool is_leaf() const { return child == 0; }
};
static_assert(sizeof(SplitNode) == 32);

// A triangle may be in several leaves, each with the part of it that lies in the box. The same tree for any number of
// threads.
struct SplitTree {
    TriangleSet triangles;
    RawArray<SplitNode> nodes;       // the root first, then with gaps
    size_t slots = 0;                // of nodes, the gaps included; 0: no triangle is finite, there is no root
    std::vector<uint32_t> top;       // inner nodes, parents first
    std::vector<uint32_t> subtrees;  // what hangs on them: roots of trees of much the same size

    explicit SplitTree(TriangleSet set) : triangles(std::move(set)) {}
    bool empty() const { return slots == 0; }
};

// Levels below the root. Down to the first the heuristic divides as it likes; beyond it sets, of less than 2^31
// references, are halved.
inline constexpr int max_free_depth = 40, max_split_depth = max_free_depth + 31;

// Throws Error (failed) where there are too many triangles for 32-bit numbers of nodes.
SplitTree build_split_tree(const TriangleSet& triangles);

}  // namespace lancer
