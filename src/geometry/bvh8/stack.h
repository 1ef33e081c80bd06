// What a traversal of eight-wide nodes has still to visit. The ways to put children in order were measured against
// others: most nodes are left with one or two, and what costs is a branch that is predicted wrongly.
#pragma once

#include <algorithm>
#include <bit>

#include "geometry/bvh8/collapse.h"
#include "geometry/bvh8/node.h"

namespace lancer {

// Each level of the tree leaves seven children at most, a node pushes eight, in two registers of which all is written,
// and one entry lies at the bottom.
inline constexpr size_t bvh8_node_entries = 8;
inline constexpr size_t bvh8_stack_size = 7 * (max_split_depth + 1) + 2 * bvh8_node_entries;

// Children with the distance where the ray enters their boxes: distance above, child below. Of floats that are not
// negative the bits are in the order of the numbers.
using Bvh8Entry = uint64_t;

// For the nearest hit. In memory of someone else, at whose bottom lies an entry of no child, at no distance.
class Bvh8NearStack {
public:
    Bvh8NearStack() = default;
    // memory: at least bvh8_stack_size entries, or the caller asks for room before each push.
    explicit Bvh8NearStack(Bvh8Entry* memory) : top_(memory) { *top_++ = Bvh8Child::none().bits(); }

    // The nearest of the children in `met`, of which there is at least one; the others stay, nearer ones on top.
    [[gnu::always_inline]] Bvh8Child push(const Bvh8Node& node, uint32_t met, Float8 near)
    {
        uint32_t rest = met & (met - 1);
        if (!rest) return Bvh8Child(node.children[first(met)]);
        alignas(32) std::array<uint32_t, 8> from;
        _mm256_store_si256(reinterpret_cast<__m256i*>(from.data()), _mm256_castps_si256(near));
        const auto entry = [&](uint32_t lanes) {
            const size_t i = first(lanes);
            return Bvh8Entry{from[i]} << 32 | node.children[i];
        };
        // Up to four, the nearest last, by a network without branches; 0, which is none, goes behind.
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
    // The children in `met`, of which there may be none, in the order in which the node has them.
    void push_all(const Bvh8Node& node, uint32_t met, Float8 near)
    {
        const __m256i order = _mm256_load_si256(reinterpret_cast<const __m256i*>(by_turns[met].data()));
        const __m256i all = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.children.data()));
        const __m256i child = _mm256_permutevar8x32_epi32(all, order);
        const __m256i distance = _mm256_permutevar8x32_epi32(_mm256_castps_si256(near), order);
        auto* to = reinterpret_cast<__m256i*>(top_);
        _mm256_storeu_si256(to, _mm256_unpacklo_epi32(child, distance));
        _mm256_storeu_si256(to + 1, _mm256_unpackhi_epi32(child, distance));
        top_ += std::popcount(met);
    }
    // The one on top, of which there is at least one.
    Bvh8Child following() const { return Bvh8Child(static_cast<uint32_t>(top_[-1])); }
    // The next child that begins within t_max, which is not negative; or none.
    Bvh8Child pop(float t_max)
    {
        const Bvh8Entry limit = std::bit_cast<uint32_t>(t_max);
        while (top_[-1] >> 32 > limit) --top_;
        return Bvh8Child(static_cast<uint32_t>(*--top_));
    }
    // Entries to the end of what belongs to the stack.
    size_t room(const Bvh8Entry* end) const { return static_cast<size_t>(end - top_); }

private:
    static void order(Bvh8Entry& a, Bvh8Entry& b)
    {
        const Bvh8Entry larger = a < b ? b : a, smaller = a < b ? a : b;
        a = larger;
        b = smaller;
    }
    static size_t first(uint32_t lanes) { return static_cast<size_t>(std::countr_zero(lanes)) & 7; }

    // Of each set of lanes their numbers in order, such that unpacking two registers that are put in this order has
    // those of the wanted lanes side by side.
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

// For any hit: the children in the order in which the node has them.
class Bvh8AnyStack {
public:
    Bvh8AnyStack() { *top_++ = Bvh8Child::none().bits(); }

    // The first of the children in `met`, of which there is at least one; the others stay, the first of them on top.
    Bvh8Child push(const Bvh8Node& node, uint32_t met)
    {
        const __m256i order = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<int64_t>(backwards[met & (met - 1)])));
        const __m256i all = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.children.data()));
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(top_), _mm256_permutevar8x32_epi32(all, order));
        top_ += std::popcount(met) - 1;
        return Bvh8Child(node.children[static_cast<size_t>(std::countr_zero(met))]);
    }
    Bvh8Child following() const { return Bvh8Child(top_[-1]); }
    // The next child, or none.
    Bvh8Child pop() { return Bvh8Child(*--top_); }

private:
    // Of each set of lanes their numbers, a byte each, the highest first.
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
