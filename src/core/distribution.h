// A discrete distribution, sampled by inverting its cumulative sums.
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

// Samplers give 24 bits. That is too few to select among millions of items: an item with a probability below 2^-24
// would be selected never or far too often. Returns u in [0, 1 - 2^-24] extended by 24 bits, which are a hash of
// another number of the same sample.
inline double extend_precision(float u, float other)
{
    uint64_t h = std::bit_cast<uint32_t>(other) * 0x9e3779b97f4a7c15u;
    h = (h ^ h >> 32) * 0xd1342543de82ef95u;
    return static_cast<double>(u) + static_cast<double>(h >> 40) * 0x1p-48;
}
// Extends u to the 53 bits of a double by a hash of two other numbers. Among millions of lights with very different
// powers some have a probability below 2^-48.
inline double extend_precision(float u, Vec2 others)
{
    const uint64_t both = std::bit_cast<uint32_t>(others.x) | uint64_t{std::bit_cast<uint32_t>(others.y)} << 32;
    uint64_t h = (both ^ both >> 31) * 0x9e3779b97f4a7c15u;
    h = (h ^ h >> 32) * 0xd1342543de82ef95u;
    return static_cast<double>(u) + static_cast<double>(h >> 35) * 0x1p-53;
}

// Samples indices with probability proportional to their weights. The sums are double: a float sum of 2^24 equal
// weights stops growing.
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
            // A weight too small to change the sum still increases it by one ulp, so that every positive weight can be
            // sampled.
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
    // Returns an index of positive weight for u in [0, 1). The distribution must not be empty.
    uint32_t sample(double u) const
    {
        const double x = u * total_;
        const auto it = std::upper_bound(cumulative_.begin(), cumulative_.end(), x);
        return static_cast<uint32_t>(std::min<size_t>(static_cast<size_t>(it - cumulative_.begin()), size() - 1));
    }
    // Whether sample_remapped() may be called: there are few indices and their weights are similar, so that a float
    // keeps enough digits for the remapped number.
    bool can_remap() const { return can_remap_; }
    // An index, and u remapped to [0, 1) within the interval of that index. The remapped number can be used as a second
    // random number.
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
    // The same for eight numbers, without branches, which could not be predicted.
    struct RemappedLanes {
        UInt8 index;
        Float8 u;
    };
    RemappedLanes sample_remapped(Float8 u) const
    {
        if (size() == 1) return {UInt8{}, u};
        const auto four = [&](Float4 of, Mask4& at) -> Float4 {
            const Double4 x = to_double(of) * total_;
            Double4 below{}, above = broadcast(cumulative_[0]);
            for (size_t i = 0; i + 1 < size(); ++i) {
                const Mask4 beyond = broadcast(cumulative_[i]) <= x;
                below = select(beyond, broadcast(cumulative_[i]), below);
                above = select(beyond, broadcast(cumulative_[i + 1]), above);
                at -= beyond;
            }
            return to_float((x - below) / (above - below));
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
    // Samples an index >= first; the probability is conditional on that range, 0 if the range has no weight.
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
    // The share of the total weight that indices >= first have.
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
