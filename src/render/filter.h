// Pixel filters by importance sampling: the film position of a sample is drawn from the filter, so every sample has
// weight 1 and belongs to one pixel. Ernst, Stamminger, Greiner, "Filter Importance Sampling", 2006.
#pragma once

#include <string>
#include <vector>

#include "core/vec.h"

namespace lancer {

enum class FilterKind { box, gaussian, blackman_harris };

class Filter {
public:
    // box: one pixel wide. gaussian: sigma 0.5, cut at 1.5 pixels. blackman_harris: radius 1.5 pixels.
    explicit Filter(FilterKind kind);

    // Offset from the centre of the pixel, in pixels, for u in [0, 1)^2.
    Vec2 sample(Vec2 u) const { return {inverse(u.x), inverse(u.y)}; }

private:
    float inverse(float u) const
    {
        if (table_.empty()) return u - 0.5f;
        const float x = u * static_cast<float>(table_.size() - 1);
        const auto i = static_cast<size_t>(x);
        const float f = x - static_cast<float>(i);
        return table_[i] * (1 - f) + table_[i + 1] * f;
    }

    std::vector<float> table_;  // inverse of the cumulative filter; empty for the box
};

}  // namespace lancer
