// Which of many things are marked, and how many of those that are marked come before one of them: two bits a thing.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace lancer {

class Marks {
public:
    Marks() = default;
    // Of [0, count) those of which is_marked(i).
    template <class IsMarked>
    Marks(uint32_t count, const IsMarked& is_marked) : of_64_(count / 64 + 1)
    {
        for (uint32_t i = 0; i < count; ++i) {
            if (i % 64 == 0) of_64_[i / 64].before = marked_;
            if (!is_marked(i)) continue;
            of_64_[i / 64].which |= uint64_t{1} << i % 64;
            ++marked_;
        }
    }

    bool empty() const { return of_64_.empty(); }  // of nothing
    uint32_t marked() const { return marked_; }
    // Of those that are not empty().
    bool has(uint32_t i) const { return of_64_[i / 64].which >> i % 64 & 1; }
    uint32_t before(uint32_t i) const
    {
        const Of64& m = of_64_[i / 64];
        const uint64_t below = m.which & ((uint64_t{1} << i % 64) - 1);
        return m.before + static_cast<uint32_t>(std::popcount(below));
    }
    uint64_t bytes() const { return of_64_.size() * sizeof(Of64); }

private:
    struct Of64 {
        uint64_t which = 0;
        uint32_t before = 0;
    };
    std::vector<Of64> of_64_;
    uint32_t marked_ = 0;
};

}  // namespace lancer
