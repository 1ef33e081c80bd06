// Which sums a film keeps for auxiliary outputs (AOVs), and where they lie in memory. A film keeps only the sums that
// the requested AOVs need.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace lancer {

// Sums over the samples of a pixel, in scene units. material: 1 + the material of the first sample, 0 if it hit
// nothing. samples and hits: counts of all samples and of those that hit a surface; doubles hold them exactly. through:
// transmittance up to the background that glass shows. caught: the same up to what catches shadows, the direct light
// there if nothing were in the way, and the part of it that is blocked.
enum class AovSum { albedo, flat, normal, position, uv, depth, material, samples, hits, z, through, caught, end };

// Number of doubles of each sum, in the order of AovSum.
inline constexpr std::array<uint8_t, 12> aov_sum_sizes{3, 3, 3, 3, 2, 1, 1, 1, 1, 1, 1, 3};
static_assert(aov_sum_sizes.size() == static_cast<size_t>(AovSum::end), "each AovSum has a size");

// The sums of one pixel are adjacent, in the order in which they were added.
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
    // Index of the first double of a sum; the sum must be present.
    constexpr size_t offset(AovSum sum) const { return offsets_[index(sum)]; }
    // Number of doubles of one pixel.
    constexpr size_t size() const { return size_; }
    constexpr bool empty() const { return size_ == 0; }

private:
    static constexpr uint8_t absent = 0xff;
    static constexpr size_t index(AovSum sum) { return static_cast<size_t>(sum); }

    std::array<uint8_t, aov_sum_sizes.size()> offsets_{};
    uint8_t size_ = 0;
};

}  // namespace lancer
