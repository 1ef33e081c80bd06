// Which nodes of a binary tree become the children of one node of eight, so that the whole costs least. Ylitie, Karras,
// Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", HPG 2017, section 3.
#pragma once

#include "geometry/any_hit_order.h"
#include "geometry/split_builder.h"

namespace lancer {

class Collapse {
public:
    static constexpr int width = 8;
    // A leaf holds at most this many blocks of `width` triangles.
    static constexpr uint32_t max_blocks = 2;

    // tree: not empty; must outlive this.
    explicit Collapse(const SplitTree& tree);

    // Whether all triangles below the node are one leaf.
    bool is_leaf(uint32_t node) const { return choices_[node].leaf; }
    const AnyHit& any_hit(uint32_t node) const { return any_hits_[node]; }
    struct Children {
        std::array<uint32_t, width> nodes;
        size_t count = 0;
    };
    // Of a leaf: itself.
    Children children(uint32_t node) const;

private:
    // What is best for a node that may take up to n places among the children of another, n = 1 .. width - 1.
    struct Choice {
        std::array<float, width - 1> cost;  // areas weighed, of everything below
        uint32_t triangles : 8;             // below, as references; the most it can hold stands for more
        uint32_t leaf : 1;
        uint32_t below : 21;  // three bits for n = 2 .. width: places of its first child; 0: as for n - 1
    };
    static_assert(sizeof(Choice) == 32);

    void choose_below(uint32_t node);
    void choose(uint32_t node);
    void add_children(uint32_t node, int places, Children& to) const;

    const SplitTree& tree_;
    RawArray<Choice> choices_;
    RawArray<AnyHit> any_hits_;
};

}  // namespace lancer
