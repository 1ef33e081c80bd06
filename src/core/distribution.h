// A discrete distribution to draw from.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace lancer {

// Indices with probability proportional to their weight. Sums in double: a float sum of 2^24 equal weights stalls.
class Discrete {
public:
    Discrete() = default;
    // Weights: finite, >= 0. All zero or empty: the distribution is empty.
    explicit Discrete(const std::vector<double>& weights)
    {
        cumulative_.reserve(weights.size());
        double sum = 0;
        for (const double w : weights) cumulative_.push_back(sum += w);
        total_ = sum;
        if (total_ <= 0) cumulative_.clear();
    }
    bool empty() const { return cumulative_.empty(); }
    size_t size() const { return cumulative_.size(); }
    // u in [0, 1). Never an index of weight 0. Not on an empty distribution.
    uint32_t sample(float u) const
    {
        const double x = static_cast<double>(u) * total_;
        const auto it = std::upper_bound(cumulative_.begin(), cumulative_.end(), x);
        return static_cast<uint32_t>(std::min<size_t>(static_cast<size_t>(it - cumulative_.begin()), size() - 1));
    }
    float probability(uint32_t i) const
    {
        return static_cast<float>((cumulative_[i] - (i ? cumulative_[i - 1] : 0)) / total_);
    }

private:
    std::vector<double> cumulative_;
    double total_ = 0;
};

}  // namespace lancer
