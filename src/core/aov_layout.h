// What is summed of the first surfaces behind a pixel for auxiliary outputs (AOVs), and where: of all sums a picture
// keeps those that its AOVs need.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace lancer {

// Over the samples of a pixel, in scene units. material: 1 + that of the first sample, 0 if it hit nothing. samples and
// hits are counts, of all and of those that hit something: doubles hold them exactly.
enum class AovSum { albedo, flat, normal, position, uv, depth, material, samples, hits };

// Doubles of each, in the order of AovSum.
inline constexpr std::array<uint8_t, 9> aov_sum_sizes{3, 3, 3, 3, 2, 1, 1, 1, 1};

// The sums of a pixel lie side by side, in the order in which they were added.
class AovLayout {
public:
    constexpr AovLayout() { offsets_.fill(absent); }
    constexpr void add(AovSum sum)
    {
        if (has(sum)) return;
        offsets_[index(sum)] = size_;
        size_ = static_cast<uint8_t>(size_ + aov_sum_sizes[index(sum)]);
    }
    constexpr bool has(AovSum sum) const { return offsets_[index(sum)] != absent; }
    // Of the first double of a sum that is there.
    constexpr size_t offset(AovSum sum) const { return offsets_[index(sum)]; }
    // Doubles of a pixel.
    constexpr size_t size() const { return size_; }
    constexpr bool empty() const { return size_ == 0; }

private:
    static constexpr uint8_t absent = 0xff;
    static constexpr size_t index(AovSum sum) { return static_cast<size_t>(sum); }

    std::array<uint8_t, aov_sum_sizes.size()> offsets_{};
    uint8_t size_ = 0;
};

}  // namespace lancer
