// Pixel filters by importance sampling: the film position of a sample is sampled from the filter, so that every sample
// has weight 1 and belongs to one pixel. Ernst, Stamminger, Greiner, "Filter Importance Sampling", 2006.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/lanes/vec.h"
#include "scene/description/render_settings.h"

namespace lancer {

class Filter {
public:
    // box: one pixel wide. gaussian: sigma 0.5, cut at 1.5 pixels. blackman_harris: radius 1.5 pixels.
    // narrow_gaussian: sigma 0.3, cut at 1.5 pixels. centre: every sample in the middle of its pixel.
    explicit Filter(FilterKind kind);

    // Offset from the centre of the pixel, in pixels, for u in [0, 1)^2.
    Vec2 sample(Vec2 u) const { return {inverse(u.x), inverse(u.y)}; }
    // The same for eight samples.
    Vec2x8 sample(const Vec2x8& u) const
    {
        if (body_.empty()) return {box(u.x), box(u.y)};
        Vec2x8 of;
        for (uint32_t i = 0; i < float_lanes; ++i) of.x[i] = inverse(u.x[i]), of.y[i] = inverse(u.y[i]);
        return of;
    }

private:
    template <class T>
    T box(T u) const
    {
        return (u - 0.5f) * width_;
    }
    float inverse(float u) const
    {
        if (body_.empty()) return box(u);
        const float half = std::min(u, 1 - u);
        const float x = half < tail ? look_up(tail_, half / tail) : look_up(body_, half * 2);
        return u < 0.5f ? x : -x;
    }
    // x in [0, 1]
    static float look_up(const std::vector<float>& table, float x)
    {
        const float at = x * static_cast<float>(table.size() - 1);
        const auto i = std::min(static_cast<size_t>(at), table.size() - 2);
        const float f = at - static_cast<float>(i);
        return table[i] * (1 - f) + table[i + 1] * f;
    }

    // Inverse of the cumulative filter over [0, 1/2], and finer where it is steep, over [0, tail]; empty for a box of
    // width_.
    static constexpr float tail = 0x1p-6f;
    std::vector<float> body_, tail_;
    float width_ = 1;
};

}  // namespace lancer
