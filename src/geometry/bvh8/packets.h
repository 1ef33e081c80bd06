// Packet traversal of a Bvh8 with eight rays: an interval test first finds the children that any ray may hit, then all
// rays are tested against each of these. After Wald, Boulos, Shirley, "Ray Tracing Deformable Scenes Using Dynamic
// Bounding Volume Hierarchies", ACM TOG 26(1), 2007. Each ray has the result of a single traversal.
#pragma once

#include "geometry/bvh8/bvh8.h"
#include "geometry/ray_packets.h"

namespace lancer {

class Bvh8Packets {
public:
    explicit Bvh8Packets(const Bvh8& tree) : tree_(tree) {}

    // As Bvh8Interleaved::closest(), for any number of rays.
    template <class Found>
    void closest(std::span<const Ray> rays, std::span<const float> t_max, std::span<uint32_t> leaf_hints,
                 const Found& found) const
    {
        for (uint32_t first = 0; first < rays.size(); first += float_lanes) {
            const size_t n = std::min<size_t>(float_lanes, rays.size() - first);
            go(rays.subspan(first, n), t_max.subspan(first, n), leaf_hints.subspan(first, n),
               [&](uint32_t i, uint32_t number, float t) { return found(first + i, number, t); });
        }
    }

private:
    static float least(Float8 x)
    {
        const Float4 four = min(lower(x), upper(x)), two = min(four, copy_upper_to_lower(four));
        return std::min(two[0], two[1]);
    }
    static float most(Float8 x) { return -least(-x); }

    // Origins and inverse directions of the rays along one axis, and their bounds. near: the bound of the origins from
    // which a node's near plane is nearest; far: from which its far plane is farthest.
    struct Axis {
        Float8 org, inverse, far_inverse;
        Float8 near, far, least_inverse, most_inverse, least_far_inverse, most_far_inverse;
        size_t near_plane;
    };
    struct Packet {
        std::array<Axis, 3> axes;
        Float8 t_min, least_t_min;
        uint32_t lanes;
        bool goes_together = true;  // all rays are active, in the same octant and not parallel to a plane

        Packet(std::span<const Ray> rays, std::span<const float> t_max) : lanes((1u << rays.size()) - 1)
        {
            const RayPacket r(rays);
            t_min = r.t_min, least_t_min = broadcast(least(t_min) + 0.0f);  // avoids -0
            for (const float t : t_max) goes_together &= !(t < 0);
            const std::array org{r.org.x, r.org.y, r.org.z}, dir{r.dir.x, r.dir.y, r.dir.z};
            for (size_t k = 0; k < 3; ++k) {
                Axis& a = axes[k];
                a.org = org[k], a.inverse = 1.0f / dir[k], a.far_inverse = a.inverse * SlabRay::widening;
                const uint32_t back = movemask_le(a.inverse, Float8{});
                goes_together &=
                    (back == 0 || back == 255) && most(abs(a.inverse)) <= std::numeric_limits<float>::max();
                const Float8 from_least = broadcast(least(a.org)), from_most = broadcast(most(a.org));
                a.near = back ? from_least : from_most, a.far = back ? from_most : from_least;
                a.least_inverse = broadcast(least(a.inverse)), a.most_inverse = broadcast(most(a.inverse));
                a.least_far_inverse = a.least_inverse * SlabRay::widening;
                a.most_far_inverse = a.most_inverse * SlabRay::widening;
                a.near_plane = 2 * k + (back != 0);
            }
        }
        // Children that any ray may hit; near: lower bounds of the entry distances.
        uint32_t may_meet(const Bvh8Node& node, Float8 t_max, Float8& near) const
        {
            near = least_t_min;
            Float8 far = t_max;
            for (const Axis& a : axes) {
                const Float8 from = load8(node.planes[a.near_plane].data()) - a.near;
                const Float8 to = load8(node.planes[a.near_plane ^ 1].data()) - a.far;
                near = max(near, min(from * a.least_inverse, from * a.most_inverse));
                far = min(far, max(to * a.least_far_inverse, to * a.most_far_inverse));
            }
            return movemask_le(near, far);
        }
        // Rays that hit a child: meets_children() for one box and eight rays.
        uint32_t meets(const Bvh8Node& node, size_t child, Float8 t_max) const
        {
            Float8 near = t_min, far = t_max;
            for (const Axis& a : axes) {
                near = max(near, (broadcast(node.planes[a.near_plane][child]) - a.org) * a.inverse);
                far = min(far, (broadcast(node.planes[a.near_plane ^ 1][child]) - a.org) * a.far_inverse);
            }
            return movemask_le(near, far) & lanes;
        }
    };

    // Traverses with at most eight rays.
    template <class Found>
    void go(std::span<const Ray> rays, std::span<const float> t_max, std::span<uint32_t> leaf_hints,
            const Found& found) const
    {
        const auto of_ray = [&](uint32_t i) {
            return [&found, i](uint32_t number, float t) { return found(i, number, t); };
        };
        const Packet packet(rays, t_max);
        if (!packet.goes_together) {
            for (uint32_t i = 0; i < rays.size(); ++i)
                if (!(t_max[i] < 0)) leaf_hints[i] = tree_.closest(rays[i], t_max[i], of_ray(i)).bits();
            return;
        }
        std::array<LeafRay, float_lanes> leaf_rays;
        std::array<Bvh8Nearest, float_lanes> nearest;
        std::array<Bvh8Child, float_lanes> last{};  // as in Bvh8Interleaved
        Float8 reach = broadcast(-1.0f);            // per ray
        for (uint32_t i = 0; i < rays.size(); ++i) {
            leaf_rays[i] = LeafRay(rays[i]);
            nearest[i] = {t_max[i], t_max[i]};
            reach[i] = t_max[i] * Bvh8::beyond;
        }
        float farthest = most(reach);
        // The stack: nodes and the rays that visit them.
        std::array<Bvh8Entry, bvh8_stack_size> stack;
        std::array<uint32_t, bvh8_stack_size> lanes_of;
        size_t top = 0;
        stack[top] = Bvh8Child().bits(), lanes_of[top++] = packet.lanes;
        while (top > 0) {
            const Bvh8Entry entry = stack[--top];
            if (entry >> 32 > std::bit_cast<uint32_t>(farthest)) continue;
            const Bvh8Child at(static_cast<uint32_t>(entry));
            const uint32_t here = lanes_of[top];
            if (top > 0) tree_.fetch(Bvh8Child(static_cast<uint32_t>(stack[top - 1])));
            if (at.is_leaf()) {
                for_each_lane(here, [&](uint32_t i) {
                    if (!Bvh8::closest_in(tree_.leaf(at), leaf_rays[i], nearest[i], of_ray(i))) return;
                    last[i] = at;
                    reach[i] = nearest[i].high * Bvh8::beyond;
                    farthest = most(reach);
                });
                continue;
            }
            const Bvh8Node& node = tree_.node(at);
            Float8 near;
            const uint32_t met = packet.may_meet(node, broadcast(farthest), near);
            alignas(32) std::array<float, 8> distances;
            store8(distances.data(), near);
            const size_t bottom = top;
            for_each_lane(met, [&](uint32_t child) {
                const uint32_t lanes = packet.meets(node, child, reach) & here;
                if (lanes == 0) return;
                const Bvh8Entry next =
                    Bvh8Entry{std::bit_cast<uint32_t>(distances[child])} << 32 | node.children[child];
                // Sorted, the nearest on top.
                size_t to = top++;
                for (; to > bottom && stack[to - 1] < next; --to)
                    stack[to] = stack[to - 1], lanes_of[to] = lanes_of[to - 1];
                stack[to] = next, lanes_of[to] = lanes;
            });
        }
        for (uint32_t i = 0; i < rays.size(); ++i) leaf_hints[i] = tree_.slot_of(last[i]).bits();
    }

    const Bvh8& tree_;
};

}  // namespace lancer
