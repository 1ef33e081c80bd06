// Distances between patches of pixels, in units of their noise: Rousselle, Knaus and Zwicker, "Adaptive Rendering with
// Non-Local Means Filtering" (2012), and the weights of non-local means.
#pragma once

#include <span>
#include <vector>

#include "core/lanes/lanes.h"
#include "render/denoise/plane.h"

namespace lancer::denoise {

// The planes that decide which pixels are alike, and the variance of each plane.
struct Guide {
    std::span<const Plane> values, variances;  // one, or three of a colour
    float variance_factor = 1;                 // by which variances are multiplied
};

// A part of a picture, half-open. Its right end may lie beyond the picture, within the margin of planes.
struct Part {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
};

// Calls f(part) for parts of at most `width` x `height` pixels that cover a picture, in parallel.
void for_parts(int picture_width, int picture_height, int width, int height, const std::function<void(const Part&)>& f);

class PatchDistance {
public:
    // Patches are squares of 2 * radius + 1 pixels.
    PatchDistance(const Guide& guide, int radius) : guide_(guide), radius_(radius) {}

    // The distance of the patch around each pixel of a part to that around the pixel displaced by (dx, dy), with k = 1:
    // 0 on average where both show the same. Only every `step`-th row. The width must be a multiple of 8.
    // out: rows of part.width().
    void compute(const Part& part, int dx, int dy, int step, float* out);

private:
    template <size_t channels>
    void pixels(const Part& part, int dx, int dy);

    Guide guide_;
    int radius_;
    std::vector<float> pixels_, rows_;  // distances of pixels, and their sums along rows
};

// The weight exp(-max(0, distance) / k^2), as the power (1 - x / 16)^16 that tends to it and ends at x = 16.
inline Float8 weight_of(Float8 distance, float inverse_k_squared)
{
    const Float8 x = max(distance, Float8{}) * (inverse_k_squared / 16);
    Float8 w = max(1.0f - x, Float8{});
    for (int i = 0; i < 4; ++i) w *= w;
    return w;
}

}  // namespace lancer::denoise
