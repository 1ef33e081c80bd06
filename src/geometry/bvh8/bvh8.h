// A BVH with eight children per node and eight triangles per leaf, watertight; the fastest of the hand-written
// accelerators. Boxes as in Wald, Benthin, Boulos, "Getting Rid of Packets", RT 2008; triangles as in Woop, Benthin,
// Wald, JCGT 2(1), 2013. Built by split_builder.h and collapse.h.
#pragma once

#include <array>
#include <span>

#include "core/lanes/prefetch.h"
#include "geometry/bvh8/layout.h"
#include "geometry/bvh8/leaf.h"
#include "geometry/bvh8/stack.h"
#include "geometry/triangle_set.h"

namespace lancer {

// A TriangleTree. Of several hits at the same distance in one block of a leaf, the lowest number is reported first.
class Bvh8 {
public:
    // Throws Error (failed) for too many triangles.
    explicit Bvh8(const TriangleSet& triangles);

    // Returns the slot of the last triangle that counted. found(number, t) is called for triangles nearer than all that
    // counted before; t errs by at most most_distance_error. t_max must not be less than the final distance.
    template <class Found>
    Bvh8Slot closest(const Ray& ray, float t_max, const Found& found) const
    {
        const NodeRay node_ray(ray);
        const LeafRay leaf_ray(ray);
        std::array<Bvh8Entry, bvh8_stack_size> entries;
        Bvh8NearStack stack(entries.data());
        Bvh8Nearest nearest{t_max, t_max};
        float reach = t_max * beyond;
        Float8 reach8 = broadcast(reach);
        Bvh8Child last;
        Bvh8Child next = begin(ray, [&](const Bvh8Node& n, uint32_t but) {
            Float8 near;
            const uint32_t met = node_ray.meets(n, reach8, near);
            stack.push_all(n, met & but, near);
        });
        for (; !next.is_none(); next = stack.pop(reach)) {
            while (!next.is_leaf()) {
                const Bvh8Node& n = node(next);
                Float8 near;
                const uint32_t met = node_ray.meets(n, reach8, near);
                if (met) {
                    next = stack.push(n, met, near);
                    if (met & (met - 1)) fetch(stack.following());
                } else if ((next = stack.pop(reach)).is_none())
                    return slot_of(last);
            }
            if (!closest_in(leaf(next), leaf_ray, nearest, found)) continue;
            last = next;
            reach = nearest.high * beyond;
            reach8 = broadcast(reach);
        }
        return slot_of(last);
    }

    template <class Found>
    bool any(const Ray& ray, const Found& found) const
    {
        const NodeRay node_ray(ray);
        const LeafRay leaf_ray(ray);
        Bvh8AnyStack stack;
        const Float8 reach = broadcast(ray.t_max * beyond);
        Float8 near;
        for (Bvh8Child next; !next.is_none(); next = stack.pop()) {
            while (!next.is_leaf()) {
                const Bvh8Node& n = node(next);
                const uint32_t met = node_ray.meets(n, reach, near);
                if (met) {
                    next = stack.push(n, met);
                    if (met & (met - 1)) fetch(stack.following());
                } else if ((next = stack.pop()).is_none())
                    return false;
            }
            if (any_in(leaf(next), leaf_ray, ray.t_max, found)) return true;
        }
        return false;
    }

    uint64_t bytes() const { return tree_.bytes + tree_.slot_of_leaf.size() * sizeof(Bvh8Slot); }
    double sah_cost() const { return tree_.sah_cost; }
    // Number of nodes from the root to the deepest one; at most max_split_depth + 1.
    int depth() const { return tree_.depth; }

private:
    friend class Bvh8Interleaved;
    friend class Bvh8Packets;

    // A box may begin a few roundings nearer or farther than its content.
    static constexpr float beyond = 1 + gamma(10);

    // The first node of a traversal: the root, or the leaf at Ray::leaf_hint. In the latter case the other children of
    // all ancestors are visited from the root downwards; the ancestors are known in advance, so that their cache misses
    // overlap. pass(node, lanes without that of the next ancestor)
    template <class Pass>
    [[gnu::always_inline]] Bvh8Child begin(const Ray& ray, const Pass& pass) const
    {
        const Bvh8Slot at(ray.leaf_hint);
        if (at.is_none()) return {};
        const Bvh8Node& on = node(at.node());
        const size_t length = on.way_length();
        if (length == on.way.size()) [[unlikely]]
            pass_above(on.way.back(), pass);
        for (size_t i = length; i-- > 0;) pass_one(on.way[i], pass);
        pass_one(at, pass);
        return Bvh8Child(on.children[at.child()]);
    }
    template <class Pass>
    [[gnu::always_inline]] void pass_one(Bvh8Slot p, const Pass& pass) const
    {
        pass(node(p.node()), ~(1u << p.child()));
    }
    // The same for all ancestors of a slot.
    template <class Pass>
    [[gnu::noinline]] void pass_above(Bvh8Slot slot, const Pass& pass) const
    {
        const Bvh8Node& on = node(slot.node());
        const size_t length = on.way_length();
        if (length == on.way.size()) pass_above(on.way.back(), pass);
        for (size_t i = length; i-- > 0;) pass_one(on.way[i], pass);
    }
    // The slot of a leaf; none for the root.
    Bvh8Slot slot_of(Bvh8Child c) const
    {
        return c.is_leaf() ? tree_.slot_of_leaf[c.leaf_offset() / Bvh8Layout::grain] : Bvh8Slot::none();
    }
    const Bvh8Node& node(Bvh8Child c) const
    {
        return *reinterpret_cast<const Bvh8Node*>(tree_.memory.get() + c.node_offset() * Bvh8Child::unit);
    }
    std::span<const Bvh8Leaf> leaf(Bvh8Child c) const
    {
        return {reinterpret_cast<const Bvh8Leaf*>(tree_.memory.get() + c.leaf_offset() * Bvh8Child::unit), c.blocks()};
    }

    void prefetch_slot_of(Bvh8Child c) const { prefetch(&tree_.slot_of_leaf[c.leaf_offset() / Bvh8Layout::grain]); }
    // Prefetches the node after the next one.
    void fetch(Bvh8Child c) const
    {
        const auto* at = tree_.memory.get() + (c.is_leaf() ? c.leaf_offset() : c.node_offset()) * Bvh8Child::unit;
        constexpr size_t line = 64;
        for (size_t i = 0; i < sizeof(Bvh8Leaf); i += line) prefetch(reinterpret_cast<const char*>(at) + i);
    }
    // Tests a leaf and returns whether a nearer triangle was found. Of equal distances the lowest number is the
    // nearest.
    template <class Found>
    static bool closest_in(std::span<const Bvh8Leaf> leaf, const LeafRay& ray, Bvh8Nearest& nearest, const Found& found)
    {
        bool is_nearer = false;
        for (const Bvh8Leaf& block : leaf) {
            Bvh8Met at;
            uint32_t met = ray.meets(block, nearest, at);
            if (!met) continue;
            if (met & (met - 1)) [[unlikely]]
                ray.measure(block, met, at);
            // After found() returns true no other lane is nearer.
            for (bool is_found = false; met && !is_found;) {
                auto lane = static_cast<uint32_t>(std::countr_zero(met));
                for (uint32_t rest = met & (met - 1); rest; rest &= rest - 1) {
                    const auto i = static_cast<uint32_t>(std::countr_zero(rest));
                    if (at.t[i] < at.t[lane]) lane = i;
                }
                met &= ~(uint32_t{1} << lane);
                const float t = at.t[lane], error = at.error[lane];
                const uint32_t number = block.numbers[lane];
                if (t + error >= nearest.low && number > nearest.number) continue;
                is_found = found(number, t);
                if (!is_found) continue;
                // Member by member: copying a struct that was just assembled would stall on store forwarding.
                nearest.low = t - error, nearest.high = t + error;
                nearest.number = number, nearest.block = &block, nearest.lane = lane;
                is_nearer = true;
            }
        }
        return is_nearer;
    }
    template <class Found>
    static bool any_in(std::span<const Bvh8Leaf> leaf, const LeafRay& ray, float t_max, const Found& found)
    {
        Bvh8Nearest end{t_max, t_max};
        for (const Bvh8Leaf& block : leaf) {
            Bvh8Met at;
            for (uint32_t met = ray.meets(block, end, at); met; met &= met - 1) {
                const auto i = static_cast<size_t>(std::countr_zero(met));
                if (found(block.numbers[i], at.t[i])) return true;
            }
        }
        return false;
    }

    Bvh8Layout tree_;
};

}  // namespace lancer
