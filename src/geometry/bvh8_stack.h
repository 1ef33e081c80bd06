// What a traversal of eight-wide nodes has still to visit. The ways to put children in order were measured against
// others: most nodes are left with one or two, and what costs is a branch that is predicted wrongly.
#pragma once

#include <algorithm>
#include <bit>

#include "geometry/bvh8_node.h"
#include "geometry/collapse.h"

namespace lancer {

// Each level of the tree leaves seven children at most, and a node pushes eight.
inline constexpr size_t bvh8_stack_size = 7 * (max_split_depth + 1) + 8;

// For the nearest hit: children with the distance where the ray enters their boxes.
class Bvh8NearStack {
public:
    // The nearest of the children in `met`, of which there is at least one; the others stay, nearer ones on top.
    Bvh8Child push(const Bvh8Node& node, uint32_t met, Float8 near)
    {
        uint32_t rest = met & (met - 1);
        if (!rest) return Bvh8Child(node.children[first(met)]);
        alignas(32) std::array<uint32_t, 8> from;
        _mm256_store_si256(reinterpret_cast<__m256i*>(from.data()), _mm256_castps_si256(near));
        const auto entry = [&](uint32_t lanes) {
            const size_t i = first(lanes);
            return Entry{from[i]} << 32 | node.children[i];
        };
        // Up to four, the nearest last, by a network without branches; 0, which is none, goes behind.
        const auto next = [&] {
            const Entry e = entry(rest) & -Entry{rest != 0};
            rest &= rest - 1;
            return e;
        };
        Entry a = entry(met), b = next(), c = next(), d = next();
        order(a, b), order(c, d), order(a, c), order(b, d), order(b, c);
        top_[0] = a, top_[1] = b, top_[2] = c, top_[3] = d;
        if (rest) [[unlikely]] {
            Entry* const bottom = top_;
            top_ += 4;
            for (; rest; rest &= rest - 1) {
                const Entry more = entry(rest);
                Entry* to = top_++;
                for (; to > bottom && to[-1] < more; --to) *to = to[-1];
                *to = more;
            }
            return Bvh8Child(static_cast<uint32_t>(*--top_));
        }
        top_ += std::popcount(met) - 1;
        return Bvh8Child(static_cast<uint32_t>(*top_));
    }
    // The one on top, of which there is at least one.
    Bvh8Child following() const { return Bvh8Child(static_cast<uint32_t>(top_[-1])); }
    // The next child that begins within t_max; false: there is none.
    bool pop(float t_max, Bvh8Child& child)
    {
        const Entry limit = std::bit_cast<uint32_t>(t_max);
        while (top_ != entries_.data()) {
            const Entry e = *--top_;
            if (e >> 32 > limit) continue;
            child = Bvh8Child(static_cast<uint32_t>(e));
            return true;
        }
        return false;
    }

private:
    // Distance above, child below: of floats that are not negative the bits are in the order of the numbers.
    using Entry = uint64_t;
    static void order(Entry& a, Entry& b)
    {
        const Entry larger = a < b ? b : a, smaller = a < b ? a : b;
        a = larger;
        b = smaller;
    }
    static size_t first(uint32_t lanes) { return static_cast<size_t>(std::countr_zero(lanes)) & 7; }

    std::array<Entry, bvh8_stack_size> entries_;
    Entry* top_ = entries_.data();
};

// For any hit: the children in the order in which the node has them.
class Bvh8AnyStack {
public:
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
    bool pop(Bvh8Child& child)
    {
        if (top_ == entries_.data()) return false;
        child = Bvh8Child(*--top_);
        return true;
    }

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
