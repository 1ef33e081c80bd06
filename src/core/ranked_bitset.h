// A bit set with constant-time rank: has(i) tells whether bit i is set, before(i) counts the set bits below i. It takes
// about two bits per entry.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace lancer {

class RankedBitset {
public:
    RankedBitset() = default;
    // Sets bit i of [0, count) where is_marked(i).
    template <class IsMarked>
    RankedBitset(uint32_t count, const IsMarked& is_marked) : words_(count / 64 + 1)
    {
        for (uint32_t i = 0; i < count; ++i) {
            if (i % 64 == 0) words_[i / 64].before = marked_;
            if (!is_marked(i)) continue;
            words_[i / 64].bits |= uint64_t{1} << i % 64;
            ++marked_;
        }
    }

    bool empty() const { return words_.empty(); }  // has no bits at all
    uint32_t marked() const { return marked_; }
    // Whether bit i is set, and the number of set bits below i. The set must not be empty().
    bool has(uint32_t i) const { return words_[i / 64].bits >> i % 64 & 1; }
    uint32_t before(uint32_t i) const
    {
        const Word& m = words_[i / 64];
        const uint64_t below = m.bits & ((uint64_t{1} << i % 64) - 1);
        return m.before + static_cast<uint32_t>(std::popcount(below));
    }
    uint64_t bytes() const { return words_.size() * sizeof(Word); }

private:
    struct Word {
        uint64_t bits = 0;
        uint32_t before = 0;
    };
    std::vector<Word> words_;
    uint32_t marked_ = 0;
};

}  // namespace lancer
