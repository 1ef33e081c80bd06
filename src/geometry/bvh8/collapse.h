// Collapses a binary tree into nodes of eight children with the lowest total cost. Ylitie, Karras, Laine, "Efficient
// Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", HPG 2017, section 3.
#pragma once

#include "geometry/bvh8/any_hit_order.h"
#include "geometry/bvh8/split_builder.h"

namespace lancer {

class Collapse {
public:
    static constexpr int width = 8;
    // Maximal number of blocks of `width` triangles in a leaf.
    static constexpr uint32_t max_blocks = 2;

    // tree: not empty; must outlive this object.
    explicit Collapse(const SplitTree& tree);

    // Whether the node becomes a leaf.
    bool is_leaf(uint32_t node) const { return decisions_[node].leaf; }
    // AnyHit::merit() of the subtree.
    float merit(uint32_t node) const { return merits_[node]; }
    struct Children {
        std::array<uint32_t, width> nodes;
        size_t count = 0;
    };
    // The children of a node; a leaf gives itself.
    Children children(uint32_t node) const;

private:
    // The best decision for a node that may occupy up to n slots among the children of another node, n = 1 .. width -
    // 1.
    struct Decision {
        uint32_t leaf : 1;
        uint32_t below : 21;  // three bits for n = 2 .. width: slots of its first child; 0: as for n - 1
    };
    // The data that the parent needs to decide.
    struct Choice {
        std::array<float, width - 1> cost;  // weighted area of the subtree with n slots
        float area;                         // half of the box's surface
        uint32_t triangles;                 // references below; `many` means that or more
        AnyHit any_hit;
    };

    Choice choose_below(uint32_t node);
    Choice choose_leaf(uint32_t node);
    Choice choose(uint32_t node, const Choice& a, const Choice& b);
    void add_children(uint32_t node, int places, Children& to) const;

    const SplitTree& tree_;
    RawArray<Decision> decisions_;
    RawArray<float> merits_;
};

}  // namespace lancer
