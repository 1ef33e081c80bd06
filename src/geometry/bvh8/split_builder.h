// Builds a binary BVH with single-triangle leaves by the surface area heuristic with spatial splits; collapse.h makes
// wide nodes of it. Wald 2007; Stich, Friedrich, Dietrich, "Spatial Splits in Bounding Volume Hierarchies", HPG 2009.
#pragma once

#include <utility>
#include <vector>

#include "core/raw_array.h"
#include "geometry/bvh8/split_reference.h"
#include "geometry/triangle_set.h"

namespace lancer {

struct SplitNode {
    FloatBox box;
    uint32_t child = 0;     // index of the first of two adjacent children; 0: a leaf
    uint32_t triangle = 0;  // leaf: index in the TriangleSet

    bool is_leaf() const { return child == 0; }
};
static_assert(sizeof(SplitNode) == 32);

// A triangle may be in several leaves, each with the part inside its box. The tree is the same for any number of
// threads.
struct SplitTree {
    TriangleSet triangles;
    RawArray<SplitNode> nodes;       // the root first; contains gaps
    size_t slots = 0;                // number of entries including gaps; 0: no finite triangle, no root
    std::vector<uint32_t> top;       // inner nodes, parents first
    std::vector<uint32_t> subtrees;  // roots of the subtrees below `top`, of similar size

    explicit SplitTree(TriangleSet set) : triangles(std::move(set)) {}
    bool empty() const { return slots == 0; }
};

// Levels below the root. Below the first limit sets of less than 2^31 references are halved by count instead of by the
// heuristic.
inline constexpr int max_free_depth = 40, max_split_depth = max_free_depth + 31;

// Throws Error (failed) if nodes exceed 32-bit indices.
SplitTree build_split_tree(const TriangleSet& triangles);

}  // namespace lancer
