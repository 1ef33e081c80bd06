// Things that hang together, directly or by others: a forest of disjoint sets. Tarjan and van Leeuwen, "Worst-Case
// Analysis of Set Union Algorithms", JACM 31(2), 1984 (path halving).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace lancer {

class DisjointSets {
public:
    // n sets of one thing each.
    explicit DisjointSets(size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
    // The same for all of a set: the first of them.
    uint32_t find(uint32_t i)
    {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(uint32_t a, uint32_t b)
    {
        a = find(a), b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<uint32_t> parent_;
};

}  // namespace lancer
