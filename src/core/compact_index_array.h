// A table of whole numbers that are mostly small, such as which of a few materials each of a million triangles has: as
// few bytes for each as the largest wants. What a cache holds of it counts in looking it up.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace lancer {

class CompactIndexArray {
public:
    CompactIndexArray() = default;
    explicit CompactIndexArray(std::span<const uint32_t> numbers) : count_(numbers.size())
    {
        if (numbers.empty()) return;
        const uint32_t largest = *std::max_element(numbers.begin(), numbers.end());
        width_ = largest <= UINT8_MAX ? 1 : largest <= UINT16_MAX ? 2 : 4;
        mask_ = UINT32_MAX >> (32 - 8 * width_);
        // Four bytes are read for each, and written.
        bytes_.resize(count_ * width_ + (4 - width_));
        for (size_t i = 0; i < count_; ++i) std::memcpy(&bytes_[i * width_], &numbers[i], 4);
    }

    bool empty() const { return count_ == 0; }
    size_t size() const { return count_; }
    uint32_t operator[](size_t i) const
    {
        uint32_t n;
        std::memcpy(&n, where(i), 4);
        return n & mask_;
    }
    // Where that number stands, to be asked for early.
    const void* where(size_t i) const { return &bytes_[i * width_]; }
    // holds(number) of some of them.
    template <class Holds>
    bool any(const Holds& holds) const
    {
        for (size_t i = 0; i < count_; ++i)
            if (holds((*this)[i])) return true;
        return false;
    }
    uint64_t bytes() const { return bytes_.size(); }

private:
    size_t count_ = 0, width_ = 4;
    uint32_t mask_ = 0;
    std::vector<uint8_t> bytes_;
};

}  // namespace lancer
