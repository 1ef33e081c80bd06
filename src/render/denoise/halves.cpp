#include "render/denoise/halves.h"

#include <algorithm>
#include <cmath>

#include "core/lanes/lanes.h"

namespace lancer::denoise {
namespace {

// The part of the squared mean of a picture below which a variance is rounding.
constexpr float variance_floor = 1e-7f * scaled_mean * scaled_mean;

float finite_or_zero(float x) { return std::isfinite(x) ? x : 0.0f; }
// Albedo and normals have numbers up to 1; what a file claims beyond is cut where its square would overflow.
float feature_of(float x) { return std::clamp(finite_or_zero(x), -100.0f, 100.0f); }

// f(x) of each value.
template <class F>
Plane make_plane(std::span<const float> values, int width, int height, const F& f)
{
    if (values.empty()) return Plane(width, height);
    return plane_of(width, height, [&](int x, int y) {
        return f(values[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)]);
    });
}

struct Mean {
    double sum = 0;
    size_t count = 0;
    double value() const { return count == 0 ? 0 : sum / static_cast<double>(count); }
};

// The power of two that gives a picture the mean scaled_mean, about.
float color_scale(const DenoiseInput& input)
{
    Mean mean;
    for (const DenoiseHalf& half : input.halves)
        for (const auto channel : half.color)
            for (const float v : channel) mean.sum += double{std::abs(finite_or_zero(v))}, ++mean.count;
    if (mean.sum == 0) return 1;
    constexpr double largest = 120;  // the inverse is a float as well
    return static_cast<float>(
        std::exp2(std::clamp(std::round(std::log2(double{scaled_mean} / mean.value())), -largest, largest)));
}

float mean_depth(const DenoiseInput& input)
{
    Mean mean;
    for (const DenoiseHalf& half : input.halves)
        for (const float z : half.depth)
            if (std::isfinite(z) && z > 0) mean.sum += double{z}, ++mean.count;
    return static_cast<float>(mean.value());
}

}  // namespace

Scales scales_of(const DenoiseInput& input) { return {color_scale(input), mean_depth(input)}; }

Halves load_halves(const DenoiseInput& input, const Scales& scales)
{
    const int width = static_cast<int>(input.width), height = static_cast<int>(input.height);
    Halves halves;
    const float scale = halves.scale = scales.color, z_mean = scales.depth;
    for (size_t h = 0; h < 2; ++h) {
        const DenoiseHalf& from = input.halves[h];
        Half& to = halves.half[h];
        for (size_t c = 0; c < 3; ++c) {
            to.color[c] = make_plane(from.color[c], width, height, [=](float v) { return finite_or_zero(v) * scale; });
            to.features[albedo_at + c] = make_plane(from.albedo[c], width, height, feature_of);
            to.features[normal_at + c] = make_plane(from.normal[c], width, height, feature_of);
        }
        to.features[depth_at] = make_plane(
            from.depth, width, height, [=](float z) { return std::isfinite(z) && z > 0 ? z / (z + z_mean) : 1.0f; });
    }
    const float a = input.halves[0].samples, b = input.halves[1].samples;
    if (a > 0 && b > 0) halves.part_of_b = b / (a + b);
    halves.pixel_variance =
        make_plane(input.variance, width, height, [](float v) { return std::max(0.0f, finite_or_zero(v)); });
    return halves;
}

Plane variance_of_pair(const Plane& a, const Plane& b, int radius)
{
    const Plane v = plane_of(a.width(), a.height(), [&](int x, int y) {
        const float difference = a.row(y)[x] - b.row(y)[x];
        return 0.5f * difference * difference;
    });
    return box_mean(v, radius);
}

ColorPlanes variance_of_half(const Halves& halves)
{
    const Plane near = box_mean(halves.pixel_variance, 1), far = box_mean(halves.pixel_variance, 10);
    ColorPlanes variance;
    for (size_t c = 0; c < 3; ++c) {
        const Plane pair = variance_of_pair(halves.half[0].color[c], halves.half[1].color[c], 10);
        variance[c] = plane_of(pair.width(), pair.height(), [&](int x, int y) {
            const float part = far.row(y)[x] > 0 ? near.row(y)[x] / far.row(y)[x] : 1.0f;
            return pair.row(y)[x] * part + variance_floor;
        });
    }
    return variance;
}

}  // namespace lancer::denoise
