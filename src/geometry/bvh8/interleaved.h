// Interleaved traversal of a Bvh8: many rays advance by one step in turn, and the data of each ray's next step is
// prefetched meanwhile, so that memory latency is hidden and the kind of the next step is no branch. Each ray has the
// result of a single traversal. After Barringer and Akenine-Moeller, "Dynamic Ray Stream Traversal", SIGGRAPH 2014,
// except that each ray keeps its own order.
#pragma once

#include <utility>

#include "geometry/bvh8/bvh8.h"

namespace lancer {

class Bvh8Interleaved {
public:
    static constexpr size_t most = 128;  // rays

    explicit Bvh8Interleaved(const Bvh8& tree) : tree_(tree) {}

    // Bvh8::closest() for at most `most` rays; rays with t_max below 0 are skipped. found(i, number, t). leaf_hints[i]:
    // its result; initially none.
    template <class Found>
    void closest(std::span<const Ray> rays, std::span<const float> t_max, std::span<uint32_t> leaf_hints,
                 const Found& found)
    {
        const auto of_ray = [&](uint32_t i) {
            return [&, i](uint32_t number, float t) { return found(i, number, t); };
        };
        const auto go_alone = [&](uint32_t i) {
            leaf_hints[i] = tree_.closest(rays[i], t_max[i], of_ray(i)).bits();
            searches_[i].last = {};
            return Bvh8Child::none();
        };
        Lists one, other;
        for (uint32_t i = 0; i < rays.size(); ++i) {
            if (t_max[i] < 0) continue;
            bool is_crowded = false;
            const Bvh8Child next = begin(i, rays[i], t_max[i], is_crowded);
            put(i, is_crowded ? go_alone(i) : next, one);
        }
        for (Lists *now = &one, *next = &other; !now->empty(); std::swap(now, next)) {
            next->clear();
            for (const uint32_t i : now->leaves.all()) {
                Search& s = searches_[i];
                if (Bvh8::closest_in(tree_.leaf(s.next), s.leaf_ray, s.nearest, of_ray(i))) {
                    s.last = s.next, s.reach = s.nearest.high * Bvh8::beyond;
                    tree_.prefetch_slot_of(s.last);
                }
                put(i, s.stack.pop(s.reach), *next);
            }
            for (const uint32_t i : now->nodes.all()) put(i, has_room(i) ? step(searches_[i]) : go_alone(i), *next);
        }
        for (uint32_t i = 0; i < rays.size(); ++i)
            if (!(t_max[i] < 0) && searches_[i].last.is_leaf()) leaf_hints[i] = tree_.slot_of(searches_[i].last).bits();
    }

private:
    struct Search {
        NodeRayInMemory node_ray;
        LeafRay leaf_ray;
        Bvh8NearStack stack;
        float reach;
        Bvh8Nearest nearest;
        Bvh8Child next, last;  // last: leaf of the nearest triangle so far, or the root
    };
    // The rays whose next step is of this kind.
    struct List {
        std::array<uint32_t, most> rays;
        size_t count = 0;

        std::span<const uint32_t> all() const { return std::span(rays).first(count); }
    };
    struct Lists {
        List nodes, leaves;

        bool empty() const { return (nodes.count | leaves.count) == 0; }
        void clear() { nodes.count = leaves.count = 0; }
    };

    // is_crowded: becomes true if the stack is too small.
    Bvh8Child begin(uint32_t i, const Ray& ray, float t_max, bool& is_crowded)
    {
        Search& s = searches_[i];
        s.node_ray = NodeRayInMemory(ray), s.leaf_ray = LeafRay(ray);
        s.stack = Bvh8NearStack(entries_[i].data());
        s.reach = t_max * Bvh8::beyond;
        s.nearest = {t_max, t_max}, s.last = {};
        return tree_.begin(ray, [&](const Bvh8Node& n, uint32_t but) {
            if (!has_room(i)) [[unlikely]] {
                is_crowded = true;
                return;
            }
            Float8 near;
            const uint32_t met = s.node_ray.meets(n, broadcast(s.reach), near);
            s.stack.push_all(n, met & but, near);
        });
    }
    Bvh8Child step(Search& s) const
    {
        const Bvh8Node& n = tree_.node(s.next);
        Float8 near;
        const uint32_t met = s.node_ray.meets(n, broadcast(s.reach), near);
        return met ? s.stack.push(n, met, near) : s.stack.pop(s.reach);
    }
    // Written to both lists, but counted only in the right one, to avoid a branch.
    void put(uint32_t i, Bvh8Child next, Lists& lists)
    {
        searches_[i].next = next;
        const bool is_leaf = next.is_leaf(), is_none = next.is_none();
        tree_.fetch(is_none ? Bvh8Child{} : next);
        lists.nodes.rays[lists.nodes.count] = lists.leaves.rays[lists.leaves.count] = i;
        lists.nodes.count += size_t{!(is_leaf | is_none)}, lists.leaves.count += size_t{is_leaf};
    }
    bool has_room(uint32_t i) const
    {
        return searches_[i].stack.room(entries_[i].data() + entries_[i].size()) >= 2 * bvh8_node_entries;
    }

    const Bvh8& tree_;
    std::array<Search, most> searches_;
    // The stacks, with room for almost all rays; the others are traversed alone. The size is not a power of two, which
    // would cause cache conflicts.
    std::array<std::array<Bvh8Entry, 72>, most> entries_;
};

}  // namespace lancer
