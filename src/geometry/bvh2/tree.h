// A binary BVH over primitives of any kind, and its traversal: near child first, with a stack. The two children of a
// node are adjacent and tested together, as in Aila and Laine, "Understanding the Efficiency of Ray Traversal on GPUs",
// HPG 2009. bvh2/builder.h builds it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/lanes/lanes.h"
#include "geometry/slab.h"

namespace lancer {

class BinaryTree {
public:
    // Maximal number of edges from the root to a leaf. Builders respect it, so that the stack never overflows.
    static constexpr uint32_t max_depth = 64;

    struct Child {
        uint32_t first, count;  // leaf: the owner's value and the number of primitives; node: its index and 0
    };
    // The two children of a node: per axis the lower sides of both, then the upper sides. The larger child is first.
    struct alignas(64) Pair {
        float sides[3][4];
        Child child[2];

        void set(uint32_t k, const FloatBox& box, Child c);
        FloatBox box(uint32_t k) const;
    };

    BinaryTree() = default;
    BinaryTree(const FloatBox& box, Child root, std::vector<Pair> pairs);

    bool empty() const { return box_.empty(); }
    const FloatBox& box() const { return box_; }
    Child root() const { return root_; }
    std::span<const Pair> pairs() const { return pairs_; }
    uint64_t bytes() const { return pairs_.size() * sizeof(Pair); }
    // Number of edges from the root to the deepest leaf.
    uint32_t depth() const;
    // SAH cost of a random line that hits the root box: 1 per node and per primitive.
    double sah_cost() const;
    // Sets first = f(first, count) of every leaf, in order.
    template <class F>
    void relabel_leaves(F&& f)
    {
        if (root_.count != 0) root_.first = f(root_.first, root_.count);
        for (Pair& p : pairs_)
            for (Child& c : p.child)
                if (c.count != 0) c.first = f(c.first, c.count);
    }

    // Calls leaf(first, count, t_max), which returns the new t_max, for every leaf that the ray hits in [ray.t_min,
    // t_max].
    template <class Leaf>
    void closest(const Ray& ray, float t_max, const Leaf& leaf) const;
    // Whether leaf(first, count) is true for any leaf that the ray hits in [ray.t_min, ray.t_max].
    template <class Leaf>
    bool any(const Ray& ray, const Leaf& leaf) const;

private:
    // meets() of slab.h for two boxes: lanes near, near, -far, -far, so that one maximum handles both sides.
    class PairRay {
    public:
        explicit PairRay(const SlabRay& r) : t_min_(r.t_min)
        {
            for (int k = 0; k < 3; ++k) {
                org_[k] = broadcast_to<Float4>(r.org[k]);
                inverse_[k] = Float4{r.inverse[k], r.inverse[k], -r.far_inverse[k], -r.far_inverse[k]};
                order_[k] = UInt4{0, 1, 2, 3} ^ (std::signbit(r.inverse[k]) ? 2u : 0u);
            }
        }
        // Bit k: child k is hit; near: entry distances. As in meets(), NaN makes the test more conservative: the
        // maximum returns its second argument.
        uint32_t meets(const Pair& p, float t_max, Float4& near) const
        {
            near = Float4{t_min_, t_min_, -t_max, -t_max};
            for (int k = 0; k < 3; ++k) {
                const Float4 sides = permute(load4_aligned(p.sides[k]), order_[k]);
                near = max((sides - org_[k]) * inverse_[k], near);
            }
            const Float4 far = -copy_upper_to_lower(near);
            return movemask(near <= far) & 3;
        }

    private:
        Float4 org_[3], inverse_[3];
        UInt4 order_[3];
        float t_min_;
    };
    // A hit may be nearer than its box by the rounding of both: gamma(10) is the bound of slab.h for the quotients, and
    // a hit distance takes about as many operations.
    static float reach(float t_max) { return t_max * (1 + gamma(20)); }

    FloatBox box_;
    Child root_{};
    std::vector<Pair> pairs_;
};

template <class Leaf>
void BinaryTree::closest(const Ray& ray, float t_max, const Leaf& leaf) const
{
    struct Entry {
        Child child;
        float near;
    };
    if (empty()) return;
    const PairRay r{SlabRay(ray)};
    Entry stack[max_depth];
    uint32_t size = 0;
    float end = reach(t_max);
    for (Child at = root_;;) {
        if (at.count == 0) {
            const Pair& p = pairs_[at.first];
            Float4 near;
            const uint32_t met = r.meets(p, end, near);
            if (met == 3) {
                const uint32_t farther = near[0] <= near[1] ? 1 : 0;
                stack[size++] = {p.child[farther], farther ? near[1] : near[0]};
                at = p.child[farther ^ 1];
                continue;
            }
            if (met != 0) {
                at = p.child[met >> 1];
                continue;
            }
        } else {
            t_max = leaf(at.first, at.count, t_max);
            end = reach(t_max);
        }
        do {
            if (size == 0) return;
            at = stack[--size].child;
        } while (stack[size].near > end);
    }
}

// The larger child first: it is more likely to contain an occluder.
template <class Leaf>
bool BinaryTree::any(const Ray& ray, const Leaf& leaf) const
{
    if (empty()) return false;
    const PairRay r{SlabRay(ray)};
    Child stack[max_depth + 1];
    uint32_t size = 0;
    const float end = reach(ray.t_max);
    for (Child at = root_;;) {
        if (at.count == 0) {
            const Pair& p = pairs_[at.first];
            Float4 near;
            const uint32_t met = r.meets(p, end, near);
            if (met != 0) {
                stack[size] = p.child[1];
                size += met == 3 ? 1 : 0;
                at = p.child[met == 2 ? 1 : 0];
                continue;
            }
        } else if (leaf(at.first, at.count)) {
            return true;
        }
        if (size == 0) return false;
        at = stack[--size];
    }
}

}  // namespace lancer
