// Which nodes of a binary tree become the children of one node of eight, so that the whole costs least. Ylitie, Karras,
// Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", HPG 2017, section 3.
#pragma once

#include "geometry/bvh8/any_hit_order.h"
#include "geometry/bvh8/split_builder.h"

namespace lancer {

class Collapse {
public:
    static constexpr int width = 8;
    // A leaf holds at most this many blocks of `width` triangles.
    static constexpr uint32_t max_blocks = 2;

    // tree: not empty; must outlive this.
    explicit Collapse(const SplitTree& tree);

    // Whether all triangles below the node are one leaf.
    bool is_leaf(uint32_t node) const { return decisions_[node].leaf; }
    // AnyHit::merit() of what is below the node.
    float merit(uint32_t node) const { return merits_[node]; }
    struct Children {
        std::array<uint32_t, width> nodes;
        size_t count = 0;
    };
    // Of a leaf: itself.
    Children children(uint32_t node) const;

private:
    // What is best for a node that may take up to n places among the children of another, n = 1 .. width - 1.
    struct Decision {
        uint32_t leaf : 1;
        uint32_t below : 21;  // three bits for n = 2 .. width: places of its first child; 0: as for n - 1
    };
    // What the node above needs to know to decide.
    struct Choice {
        std::array<float, width - 1> cost;  // areas weighed, of everything below, with n places
        float area;                         // half of the box's surface
        uint32_t triangles;                 // below, as references; at most `many`, which stands for more
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
