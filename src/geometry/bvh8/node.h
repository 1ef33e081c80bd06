// A node with eight boxes and its ray test. Like meets() in slab.h it is conservative; the remarks there on rays within
// the plane of a side also apply.
#pragma once

#include <array>
#include <bit>

#include "geometry/ray_lanes.h"
#include "geometry/slab.h"

namespace lancer {

// Reference to a child: its offset in the tree's memory in units of 32 bytes, and its kind.
class Bvh8Child {
public:
    static constexpr uint64_t unit = 32, max_offset = uint64_t{1} << 29;  // in units
    static constexpr uint32_t max_blocks = 4;

    Bvh8Child() = default;
    explicit Bvh8Child(uint32_t bits) : bits_(bits) {}
    static Bvh8Child node(uint64_t offset) { return Bvh8Child(static_cast<uint32_t>(offset)); }
    static Bvh8Child leaf(uint64_t offset, uint32_t blocks)
    {
        return Bvh8Child(leaf_bit | static_cast<uint32_t>(offset << 2) | (blocks - 1));
    }

    // No child: the traversal ends.
    static Bvh8Child none() { return Bvh8Child(~leaf_bit); }

    bool is_leaf() const { return (bits_ & leaf_bit) != 0; }
    bool is_none() const { return bits_ == ~leaf_bit; }
    uint64_t node_offset() const { return bits_; }
    uint64_t leaf_offset() const { return (bits_ & ~leaf_bit) >> 2; }
    uint32_t blocks() const { return (bits_ & 3) + 1; }
    uint32_t bits() const { return bits_; }

private:
    static constexpr uint32_t leaf_bit = 1u << 31;
    uint32_t bits_ = 0;
};

// A child slot of a node.
class Bvh8Slot {
public:
    Bvh8Slot() = default;
    explicit Bvh8Slot(uint32_t bits) : bits_(bits) {}
    Bvh8Slot(uint64_t node_offset, size_t child) : bits_(static_cast<uint32_t>(node_offset << 3 | child)) {}

    static Bvh8Slot none() { return {}; }
    bool is_none() const { return bits_ == UINT32_MAX; }
    Bvh8Child node() const { return Bvh8Child::node(bits_ >> 3); }
    uint32_t child() const { return bits_ & 7; }
    uint32_t bits() const { return bits_; }

private:
    uint32_t bits_ = UINT32_MAX;  // offsets are below 2^29, so this is no valid slot
};

// Children are in the order of any_hit_order.h; unused ones come last and have empty boxes.
struct alignas(32) Bvh8Node {
    std::array<std::array<float, 8>, 6> planes;  // lower and upper x, y, z
    std::array<uint32_t, 8> children;            // Bvh8Child::bits()
    // The slots of the node's ancestors, from its parent upwards, then none. A deep node has only the first ones; the
    // last of these has the rest.
    using Way = std::array<Bvh8Slot, 8>;
    Way way;

    size_t way_length() const
    {
        size_t n = 0;
        while (n < way.size() && !way[n].is_none()) ++n;
        return n;
    }
};

// Bit i: child i is hit in [t_min, t_max]; near: entry distances, at least +0. Ray: one of the types below.
template <class Ray>
[[gnu::always_inline]] inline uint32_t meets_children(const Ray& ray, const Bvh8Node& node, Float8 t_max, Float8& near)
{
    const auto at = [&](size_t plane, size_t k, Float8 inverse) {
        return (load8(node.planes[plane].data()) - ray.org(k)) * inverse;
    };
    const auto first = [&](size_t k) { return at(ray.near_plane(k), k, ray.inverse(k)); };
    const auto last = [&](size_t k) { return at(ray.near_plane(k) ^ 1, k, ray.far_inverse(k)); };
    const Float8 x0 = first(0), x1 = last(0), y0 = first(1), y1 = last(1), z0 = first(2), z1 = last(2);
    near = max(max(x0, y0), max(z0, ray.t_min()));
    return movemask_le(near, min(min(x1, y1), min(z1, t_max)));
}

// Precomputed data of a ray for node tests, in registers.
class NodeRay {
public:
    explicit NodeRay(const Ray& ray)
    {
        const Float4 org = org_and_t_min(ray), inverse = 1.0f / dir_and_t_max(ray);
        const Float4 far_inverse = inverse * SlabRay::widening;
        const uint32_t back = sign_bits(inverse);
        for (size_t k = 0; k < 3; ++k) {
            org_[k] = broadcast(org[k]);
            inverse_[k] = broadcast(inverse[k]);
            far_inverse_[k] = broadcast(far_inverse[k]);
            near_[k] = 2 * k + (back >> k & 1);
        }
        t_min_ = broadcast(ray.t_min + 0.0f);  // avoids -0, whose bits would compare as the largest
    }

    Float8 org(size_t k) const { return org_[k]; }
    Float8 inverse(size_t k) const { return inverse_[k]; }
    Float8 far_inverse(size_t k) const { return far_inverse_[k]; }
    size_t near_plane(size_t k) const { return near_[k]; }
    Float8 t_min() const { return t_min_; }
    [[gnu::always_inline]] uint32_t meets(const Bvh8Node& node, Float8 t_max, Float8& near) const
    {
        return meets_children(*this, node, t_max, near);
    }

private:
    std::array<Float8, 3> org_, inverse_, far_inverse_;
    std::array<size_t, 3> near_;  // index of the near plane per axis
    Float8 t_min_;
};

// The same in one cache line.
class alignas(64) NodeRayInMemory {
public:
    NodeRayInMemory() = default;
    explicit NodeRayInMemory(const Ray& ray)
    {
        const Float4 org = org_and_t_min(ray), inverse = 1.0f / dir_and_t_max(ray);
        const uint32_t back = sign_bits(inverse);
        store4_aligned(org_and_t_min_.data(), org + Float4{});
        store4_aligned(inverse_.data(), inverse);
        store4_aligned(far_inverse_.data(), inverse * SlabRay::widening);
        for (uint32_t k = 0; k < 3; ++k) near_[k] = 2 * k + (back >> k & 1);
    }

    Float8 org(size_t k) const { return broadcast(org_and_t_min_[k]); }
    Float8 inverse(size_t k) const { return broadcast(inverse_[k]); }
    Float8 far_inverse(size_t k) const { return broadcast(far_inverse_[k]); }
    size_t near_plane(size_t k) const { return near_[k]; }
    Float8 t_min() const { return broadcast(org_and_t_min_[3]); }
    [[gnu::always_inline]] uint32_t meets(const Bvh8Node& node, Float8 t_max, Float8& near) const
    {
        return meets_children(*this, node, t_max, near);
    }

private:
    alignas(16) std::array<float, 4> org_and_t_min_, inverse_, far_inverse_;
    std::array<uint32_t, 3> near_;
};

}  // namespace lancer
