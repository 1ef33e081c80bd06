// A node of eight boxes and a ray's test of them all at once. Like meets() of slab.h, it never says no where the exact
// answer is yes; the same remarks on rays within the plane of a side hold.
#pragma once

#include <array>
#include <bit>

#include "geometry/ray_lanes.h"
#include "geometry/slab.h"

namespace lancer {

// Where a child lies in the memory of the tree: in units of 32 bytes.
class Bvh8Child {
public:
    static constexpr uint64_t unit = 32, max_offset = uint64_t{1} << 29;  // of units
    static constexpr uint32_t max_blocks = 4;

    Bvh8Child() = default;
    explicit Bvh8Child(uint32_t bits) : bits_(bits) {}
    static Bvh8Child node(uint64_t offset) { return Bvh8Child(static_cast<uint32_t>(offset)); }
    static Bvh8Child leaf(uint64_t offset, uint32_t blocks)
    {
        return Bvh8Child(leaf_bit | static_cast<uint32_t>(offset << 2) | (blocks - 1));
    }

    bool is_leaf() const { return (bits_ & leaf_bit) != 0; }
    uint64_t node_offset() const { return bits_; }
    uint64_t leaf_offset() const { return (bits_ & ~leaf_bit) >> 2; }
    uint32_t blocks() const { return (bits_ & 3) + 1; }
    uint32_t bits() const { return bits_; }

private:
    static constexpr uint32_t leaf_bit = 1u << 31;
    uint32_t bits_ = 0;
};

// The children come in the order of any_hit_order.h; those that there are not, last, have empty boxes.
struct alignas(32) Bvh8Node {
    std::array<std::array<float, 8>, 6> planes;  // lower and upper x, then y, then z
    std::array<uint32_t, 8> children;            // bits of Bvh8Child
};

// What of a ray all nodes share.
class NodeRay {
public:
    explicit NodeRay(const Ray& ray)
    {
        const Float4 org = org_and_t_min(ray), inverse = 1.0f / dir_and_t_max(ray);
        const Float4 far_inverse = inverse * SlabRay::widening;
        const auto back = static_cast<uint32_t>(_mm_movemask_ps(inverse));
        for (size_t k = 0; k < 3; ++k) {
            org_[k] = all_lanes(org[k]);
            inverse_[k] = all_lanes(inverse[k]);
            far_inverse_[k] = all_lanes(far_inverse[k]);
            near_[k] = 2 * k + (back >> k & 1);
        }
        t_min_ = all_lanes(ray.t_min + 0.0f);  // -0 would be the largest of all, taken as bits
    }

    // Bit i: child i is met in [t_min, t_max]; near: where it begins, at least +0.
    uint32_t meets(const Bvh8Node& node, Float8 t_max, Float8& near) const
    {
        const auto at = [&](size_t plane, size_t k, Float8 inverse) {
            return (load8(node.planes[plane].data()) - org_[k]) * inverse;
        };
        const Float8 x0 = at(near_[0], 0, inverse_[0]), x1 = at(near_[0] ^ 1, 0, far_inverse_[0]);
        const Float8 y0 = at(near_[1], 1, inverse_[1]), y1 = at(near_[1] ^ 1, 1, far_inverse_[1]);
        const Float8 z0 = at(near_[2], 2, inverse_[2]), z1 = at(near_[2] ^ 1, 2, far_inverse_[2]);
        near = max(max(x0, y0), max(z0, t_min_));
        return bits_le(near, min(min(x1, y1), min(z1, t_max)));
    }

private:
    std::array<Float8, 3> org_, inverse_, far_inverse_;
    std::array<size_t, 3> near_;  // which planes are the near ones
    Float8 t_min_;
};

}  // namespace lancer
