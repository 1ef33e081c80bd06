// A binary tree of boxes over primitives of any kind, and how a ray goes through it: near child first, nodes on a
// stack. The two children of a node lie side by side and are tested together, as in Aila and Laine, "Understanding the
// Efficiency of Ray Traversal on GPUs", HPG 2009. bvh2/builder.h makes such trees.
#pragma once

#include <immintrin.h>

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/slab.h"

namespace lancer {

class BinaryTree {
public:
    // Edges from the root to the deepest leaf, at most. Builders keep to it, and so a ray's stack never overflows.
    static constexpr uint32_t max_depth = 64;

    struct Child {
        uint32_t first, count;  // of a leaf what its owner says and how many primitives; of a node its number and 0
    };
    // Two children of one node, 32 bytes each: of each axis the lower sides of both, then the upper ones. The larger
    // one comes first.
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
    // Edges from the root to the deepest leaf.
    uint32_t depth() const;
    // Expected cost of a random line that meets the tree's box: a node 1, a primitive 1.
    double sah_cost() const;
    // first = f(first, count) of every leaf, neighbours after each other.
    template <class F>
    void relabel_leaves(F&& f)
    {
        if (root_.count != 0) root_.first = f(root_.first, root_.count);
        for (Pair& p : pairs_)
            for (Child& c : p.child)
                if (c.count != 0) c.first = f(c.first, c.count);
    }

    // leaf(first, count, t_max), which returns the new t_max, of every leaf that the ray meets in [ray.t_min, t_max].
    template <class Leaf>
    void closest(const Ray& ray, float t_max, const Leaf& leaf) const;
    // Whether leaf(first, count) was true of any leaf that the ray meets in [ray.t_min, ray.t_max].
    template <class Leaf>
    bool any(const Ray& ray, const Leaf& leaf) const;

private:
    // meets() of slab.h for two boxes: lanes near, near, -far, -far, so that one maximum serves both sides.
    class PairRay {
    public:
        explicit PairRay(const SlabRay& r) : t_min_(r.t_min)
        {
            for (int k = 0; k < 3; ++k) {
                org_[k] = _mm_set1_ps(r.org[k]);
                inverse_[k] = _mm_setr_ps(r.inverse[k], r.inverse[k], -r.far_inverse[k], -r.far_inverse[k]);
                order_[k] =
                    _mm_xor_si128(_mm_setr_epi32(0, 1, 2, 3), _mm_set1_epi32(std::signbit(r.inverse[k]) ? 2 : 0));
            }
        }
        // Bit k: child k is met; near: where each is entered. As in meets(), NaN decides nothing: the maximum keeps its
        // second argument.
        uint32_t meets(const Pair& p, float t_max, __m128& near) const
        {
            near = _mm_setr_ps(t_min_, t_min_, -t_max, -t_max);
            for (int k = 0; k < 3; ++k) {
                const __m128 sides = _mm_permutevar_ps(_mm_load_ps(p.sides[k]), order_[k]);
                near = _mm_max_ps((sides - org_[k]) * inverse_[k], near);
            }
            const __m128 far = -_mm_movehl_ps(near, near);
            return static_cast<uint32_t>(_mm_movemask_ps(_mm_cmple_ps(near, far))) & 3;
        }

    private:
        __m128 org_[3], inverse_[3];
        __m128i order_[3];
        float t_min_;
    };
    // What is found at t may be nearer than the box around it by the rounding of both: gamma(10) is what slab.h gives
    // the quotients, and finding the distance takes about as many operations.
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
            __m128 near;
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

// The larger child first: the likelier to hold what stops the ray.
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
            __m128 near;
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
