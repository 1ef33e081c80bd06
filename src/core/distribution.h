// A discrete distribution to draw from.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/lanes/lanes.h"
#include "core/vec.h"

namespace lancer {

// Samplers give 24 bits, which are too few to choose among millions: what is rarer than 2^-24 would be chosen never, or
// far too often. This is u in [0, 1 - 2^-24] and 24 bits more, a hash of another number that was drawn with it.
inline double extend_precision(float u, float other)
{
    uint64_t h = std::bit_cast<uint32_t>(other) * 0x9e3779b97f4a7c15u;
    h = (h ^ h >> 32) * 0xd1342543de82ef95u;
    return static_cast<double>(u) + static_cast<double>(h >> 40) * 0x1p-48;
}
// And with all the bits that a double in [0, 1) can have, a hash of two others: of lights by the million, with powers
// that differ by the million, there are some whose chance is below 2^-48.
inline double extend_precision(float u, Vec2 others)
{
    const uint64_t both = std::bit_cast<uint32_t>(others.x) | uint64_t{std::bit_cast<uint32_t>(others.y)} << 32;
    uint64_t h = (both ^ both >> 31) * 0x9e3779b97f4a7c15u;
    h = (h ^ h >> 32) * 0xd1342543de82ef95u;
    return static_cast<double>(u) + static_cast<double>(h >> 35) * 0x1p-53;
}

// Indices with probability proportional to their weight. Sums in double: a float sum of 2^24 equal weights stalls.
class Discrete {
public:
    Discrete() = default;
    // Weights: finite, >= 0. All zero or empty: the distribution is empty.
    explicit Discrete(const std::vector<double>& weights)
    {
        cumulative_.reserve(weights.size());
        double sum = 0;
        for (const double w : weights) {
            const double before = sum;
            sum += w;
            // What the sum so far would swallow gets the least part that there is: what weighs something is drawn.
            if (w > 0 && sum == before) sum = std::nextafter(sum, std::numeric_limits<double>::infinity());
            cumulative_.push_back(sum);
        }
        total_ = sum;
        if (total_ <= 0) cumulative_.clear();
        can_remap_ = !empty() && size() <= few;
        for (const double w : weights) can_remap_ = can_remap_ && (w == 0 || w >= least_share * total_);
    }
    bool empty() const { return cumulative_.empty(); }
    size_t size() const { return cumulative_.size(); }
    // u in [0, 1). Never an index of weight 0. Not on an empty distribution.
    uint32_t sample(double u) const
    {
        const double x = u * total_;
        const auto it = std::upper_bound(cumulative_.begin(), cumulative_.end(), x);
        return static_cast<uint32_t>(std::min<size_t>(static_cast<size_t>(it - cumulative_.begin()), size() - 1));
    }
    // Whether sample_remapped() may be asked: there are so few, and of weights so alike, that a float has enough digits
    // left.
    bool can_remap() const { return can_remap_; }
    // An index, and where in its part of [0, 1) u lies, as a number in [0, 1): as good as a second one that was drawn.
    struct Remapped {
        uint32_t index;
        float u;
    };
    Remapped sample_remapped(float u) const
    {
        if (size() == 1) return {0, u};
        const double x = static_cast<double>(u) * total_;
        uint32_t index = 0;
        double below = 0;
        for (; index + 1 < size() && cumulative_[index] <= x; ++index) below = cumulative_[index];
        const double part = (x - below) / (cumulative_[index] - below);
        return {index, std::min(static_cast<float>(part), largest_below_1)};
    }
    // The same of eight, without jumps: nobody can predict them.
    struct RemappedLanes {
        UInt8 index;
        Float8 u;
    };
    RemappedLanes sample_remapped(Float8 u) const
    {
        if (size() == 1) return {UInt8{}, u};
        const auto four = [&](Float4 of, Mask4& at) -> Float4 {
            const Double4 x = Double4(_mm256_cvtps_pd(of)) * total_;
            Double4 below{}, above = broadcast(cumulative_[0]);
            for (size_t i = 0; i + 1 < size(); ++i) {
                const Mask4 beyond = broadcast(cumulative_[i]) <= x;
                below = select(beyond, broadcast(cumulative_[i]), below);
                above = select(beyond, broadcast(cumulative_[i + 1]), above);
                at -= beyond;
            }
            return _mm256_cvtpd_ps((x - below) / (above - below));
        };
        Mask4 low_index{}, high_index{};
        const Float4 low = four(lower(u), low_index), high = four(upper(u), high_index);
        return {reinterpret_cast<UInt8>(concat(narrow(low_index), narrow(high_index))),
                min(concat(low, high), broadcast(largest_below_1))};
    }
    float probability(uint32_t i) const
    {
        return static_cast<float>((cumulative_[i] - (i ? cumulative_[i - 1] : 0)) / total_);
    }
    // An index that is not below `first`, and its probability among these; 0 if they weigh nothing beside the others.
    struct Choice {
        uint32_t index;
        float probability;
    };
    Choice sample_from(uint32_t first, double u) const
    {
        const double below = first ? cumulative_[first - 1] : 0, rest = total_ - below;
        if (!(rest > 0)) return {first, 0};
        const auto it = std::upper_bound(cumulative_.begin() + first, cumulative_.end(), below + u * rest);
        const auto i = std::min(static_cast<uint32_t>(it - cumulative_.begin()), static_cast<uint32_t>(size() - 1));
        return {i, static_cast<float>((cumulative_[i] - (i ? cumulative_[i - 1] : 0)) / rest)};
    }
    // The part of all weight that the indices from `first` on have.
    double share_from(uint32_t first) const { return first ? 1 - cumulative_[first - 1] / total_ : 1; }

private:
    static constexpr float largest_below_1 = 1 - 0x1p-24f;
    static constexpr size_t few = 32;
    static constexpr double least_share = 0x1p-6;

    std::vector<double> cumulative_;
    double total_ = 0;
    bool can_remap_ = false;
};

}  // namespace lancer
