// An array of indices that stores each with 1, 2 or 4 bytes, as the largest index needs. Example: the material of each
// triangle. A smaller array occupies less of the cache.
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
        // Each access reads four bytes, so the array is padded at its end.
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
    // Address of entry i, for prefetching.
    const void* where(size_t i) const { return &bytes_[i * width_]; }
    // Whether holds(index) is true for any entry.
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
