// The traversal stacks of eight-wide nodes. The sorting methods were chosen by benchmarks: most nodes have one or two
// hits, and branch mispredictions dominate.
#pragma once

#include <algorithm>
#include <bit>

#include "geometry/bvh8/collapse.h"
#include "geometry/bvh8/node.h"

namespace lancer {

// Per level at most seven children stay on the stack; a push writes two full registers of eight entries; one sentinel
// lies at the bottom.
inline constexpr size_t bvh8_node_entries = 8;
inline constexpr size_t bvh8_stack_size = 7 * (max_split_depth + 1) + 2 * bvh8_node_entries;

// An entry: entry distance above, child below. The bits of non-negative floats are ordered as the numbers.
using Bvh8Entry = uint64_t;

// The stack for closest hits, in external memory, with a sentinel at distance 0 at the bottom.
class Bvh8NearStack {
public:
    Bvh8NearStack() = default;
    // memory: at least bvh8_stack_size entries, or the caller checks room() before each push.
    explicit Bvh8NearStack(Bvh8Entry* memory) : top_(memory) { *top_++ = Bvh8Child::none().bits(); }

    // Returns the nearest child in `met`, which is not 0, and pushes the others, nearer ones on top.
    [[gnu::always_inline]] Bvh8Child push(const Bvh8Node& node, uint32_t met, Float8 near)
    {
        uint32_t rest = met & (met - 1);
        if (!rest) return Bvh8Child(node.children[first(met)]);
        alignas(32) std::array<uint32_t, 8> from;
        store8(from.data(), reinterpret_cast<UInt8>(near));
        const auto entry = [&](uint32_t lanes) {
            const size_t i = first(lanes);
            return Bvh8Entry{from[i]} << 32 | node.children[i];
        };
        // Sorts up to four entries by a branch-free network, the nearest last; empty entries (0) go to the end.
        const auto next = [&] {
            const Bvh8Entry e = entry(rest) & -Bvh8Entry{rest != 0};
            rest &= rest - 1;
            return e;
        };
        Bvh8Entry a = entry(met), b = next(), c = next(), d = next();
        order(a, b), order(c, d), order(a, c), order(b, d), order(b, c);
        top_[0] = a, top_[1] = b, top_[2] = c, top_[3] = d;
        if (rest) [[unlikely]] {
            Bvh8Entry* const bottom = top_;
            top_ += 4;
            for (; rest; rest &= rest - 1) {
                const Bvh8Entry more = entry(rest);
                Bvh8Entry* to = top_++;
                for (; to > bottom && to[-1] < more; --to) *to = to[-1];
                *to = more;
            }
            return Bvh8Child(static_cast<uint32_t>(*--top_));
        }
        top_ += std::popcount(met) - 1;
        return Bvh8Child(static_cast<uint32_t>(*top_));
    }
    // Pushes the children in `met`, which may be 0, in the node's order.
    void push_all(const Bvh8Node& node, uint32_t met, Float8 near)
    {
        const UInt8 order = load8(by_turns[met].data());
        const UInt8 child = permute(load8(node.children.data()), order);
        const UInt8 distance = permute(reinterpret_cast<UInt8>(near), order);
        auto* to = reinterpret_cast<uint32_t*>(top_);
        store8_anywhere(to, interleave_low(child, distance));
        store8_anywhere(to + float_lanes, interleave_high(child, distance));
        top_ += std::popcount(met);
    }
    // The top entry; the stack must not be empty.
    Bvh8Child following() const { return Bvh8Child(static_cast<uint32_t>(top_[-1])); }
    // The next child with an entry distance of at most t_max >= 0; or none.
    Bvh8Child pop(float t_max)
    {
        const Bvh8Entry limit = std::bit_cast<uint32_t>(t_max);
        while (top_[-1] >> 32 > limit) --top_;
        return Bvh8Child(static_cast<uint32_t>(*--top_));
    }
    // Number of free entries.
    size_t room(const Bvh8Entry* end) const { return static_cast<size_t>(end - top_); }

private:
    static void order(Bvh8Entry& a, Bvh8Entry& b)
    {
        const Bvh8Entry larger = a < b ? b : a, smaller = a < b ? a : b;
        a = larger;
        b = smaller;
    }
    static size_t first(uint32_t lanes) { return static_cast<size_t>(std::countr_zero(lanes)) & 7; }

    // For each set of lanes their indices, ordered so that unpacking two permuted registers places the selected lanes
    // side by side.
    struct alignas(32) Order : std::array<uint32_t, 8> {};
    static constexpr std::array<Order, 256> by_turns = [] {
        constexpr std::array<uint32_t, 8> to{0, 1, 4, 5, 2, 3, 6, 7};
        std::array<Order, 256> all{};
        for (uint32_t set = 0; set < all.size(); ++set)
            for (uint32_t lane = 0, count = 0; lane < 8; ++lane)
                if (set >> lane & 1) all[set][to[count++]] = lane;
        return all;
    }();

    Bvh8Entry* top_;
};

// The stack for occlusion tests: children in the node's order.
class Bvh8AnyStack {
public:
    Bvh8AnyStack() { *top_++ = Bvh8Child::none().bits(); }

    // Returns the first child in `met`, which is not 0, and pushes the others, the first of them on top.
    Bvh8Child push(const Bvh8Node& node, uint32_t met)
    {
        const UInt8 order = widen_bytes(backwards[met & (met - 1)]);
        store8_anywhere(top_, permute(load8(node.children.data()), order));
        top_ += std::popcount(met) - 1;
        return Bvh8Child(node.children[static_cast<size_t>(std::countr_zero(met))]);
    }
    Bvh8Child following() const { return Bvh8Child(top_[-1]); }
    // The next child, or none.
    Bvh8Child pop() { return Bvh8Child(*--top_); }

private:
    // For each set of lanes their indices, one byte each, the highest first.
    static constexpr std::array<uint64_t, 256> backwards = [] {
        std::array<uint64_t, 256> table{};
        for (uint32_t set = 0; set < 256; ++set)
            for (uint32_t lane = 0; lane < 8; ++lane)
                if (set >> lane & 1) table[set] = table[set] << 8 | lane;
        return table;
    }();

    std::array<uint32_t, bvh8_stack_size> entries_;
    uint32_t* top_ = entries_.data();
};

}  // namespace lancer
