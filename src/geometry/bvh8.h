// A tree of nodes with eight children and leaves of eight triangles, watertight: the fastest of ours. Boxes as in Wald,
// Benthin, Boulos, "Getting Rid of Packets", RT 2008; triangles as in Woop, Benthin, Wald, JCGT 2(1), 2013. Built by
// split_builder.h and collapse.h.
#pragma once

#include <span>

#include "core/prefetch.h"
#include "geometry/bvh8_layout.h"
#include "geometry/bvh8_leaf.h"
#include "geometry/bvh8_stack.h"
#include "geometry/triangle_set.h"

namespace lancer {

// A TriangleTree. Of what a ray meets at one distance in one block of a leaf, the lowest number is asked about first.
class Bvh8 {
public:
    // Throws Error (failed) where there are too many triangles for one tree.
    explicit Bvh8(const TriangleSet& triangles);

    template <class Found>
    void closest(const Ray& ray, float& t_max, const Found& found) const
    {
        const NodeRay node_ray(ray);
        const LeafRay leaf_ray(ray);
        Bvh8NearStack stack;
        uint32_t nearest_yet = UINT32_MAX;
        float reach = t_max * beyond;
        Float8 reach8 = all_lanes(reach);
        Bvh8Child next;
        do {
            while (!next.is_leaf()) {
                const Bvh8Node& n = node(next);
                Float8 near;
                const uint32_t met = node_ray.meets(n, reach8, near);
                if (met) {
                    next = stack.push(n, met, near);
                    if (met & (met - 1)) fetch(stack.following());
                } else if (!stack.pop(reach, next))
                    return;
            }
            if (!closest_in(leaf(next), leaf_ray, t_max, nearest_yet, found)) continue;
            reach = t_max * beyond;
            reach8 = all_lanes(reach);
        } while (stack.pop(reach, next));
    }

    template <class Found>
    bool any(const Ray& ray, const Found& found) const
    {
        const NodeRay node_ray(ray);
        const LeafRay leaf_ray(ray);
        Bvh8AnyStack stack;
        const Float8 reach = all_lanes(ray.t_max * beyond);
        Bvh8Child next;
        do {
            while (!next.is_leaf()) {
                const Bvh8Node& n = node(next);
                Float8 near;
                const uint32_t met = node_ray.meets(n, reach, near);
                if (met) {
                    next = stack.push(n, met);
                    if (met & (met - 1)) fetch(stack.following());
                } else if (!stack.pop(next))
                    return false;
            }
            if (any_in(leaf(next), leaf_ray, ray.t_max, found)) return true;
        } while (stack.pop(next));
        return false;
    }

    uint64_t bytes() const { return tree_.bytes; }
    double sah_cost() const { return tree_.sah_cost; }
    // Nodes from the root to the deepest one; at most max_split_depth + 1.
    int depth() const { return tree_.depth; }

private:
    // A box begins a few roundings nearer or farther than what is in it.
    static constexpr float beyond = 1 + gamma(10);

    const Bvh8Node& node(Bvh8Child c) const
    {
        return *reinterpret_cast<const Bvh8Node*>(tree_.memory.get() + c.node_offset() * Bvh8Child::unit);
    }
    std::span<const Bvh8Leaf> leaf(Bvh8Child c) const
    {
        return {reinterpret_cast<const Bvh8Leaf*>(tree_.memory.get() + c.leaf_offset() * Bvh8Child::unit), c.blocks()};
    }

    // What is visited next but one is asked for early.
    void fetch(Bvh8Child c) const
    {
        const auto* at = tree_.memory.get() + (c.is_leaf() ? c.leaf_offset() : c.node_offset()) * Bvh8Child::unit;
        constexpr size_t line = 64;
        for (size_t i = 0; i < sizeof(Bvh8Leaf); i += line) prefetch(reinterpret_cast<const char*>(at) + i);
    }
    // Whether t_max has become less, and then by which triangle.
    template <class Found>
    static bool closest_in(std::span<const Bvh8Leaf> leaf, const LeafRay& ray, float& t_max, uint32_t& nearest_yet,
                           const Found& found)
    {
        bool is_nearer = false;
        for (const Bvh8Leaf& block : leaf) {
            std::array<float, 8> distances;
            uint32_t met = ray.meets(block, t_max, nearest_yet, distances);
            // Once found() says true, no other lane is nearer.
            for (bool is_found = false; met && !is_found;) {
                auto nearest = static_cast<size_t>(std::countr_zero(met));
                for (uint32_t rest = met & (met - 1); rest; rest &= rest - 1) {
                    const auto i = static_cast<size_t>(std::countr_zero(rest));
                    if (distances[i] < distances[nearest]) nearest = i;
                }
                met &= ~(uint32_t{1} << nearest);
                is_found = found(block.numbers[nearest], distances[nearest]);
                if (!is_found) continue;
                t_max = distances[nearest];
                nearest_yet = block.numbers[nearest];
                is_nearer = true;
            }
        }
        return is_nearer;
    }
    template <class Found>
    static bool any_in(std::span<const Bvh8Leaf> leaf, const LeafRay& ray, float t_max, const Found& found)
    {
        for (const Bvh8Leaf& block : leaf) {
            std::array<float, 8> t;
            for (uint32_t met = ray.meets(block, t_max, UINT32_MAX, t); met; met &= met - 1) {
                const auto i = static_cast<size_t>(std::countr_zero(met));
                if (found(block.numbers[i], t[i])) return true;
            }
        }
        return false;
    }

    Bvh8Layout tree_;
};

}  // namespace lancer
