#include "render/denoise/bandwidth_choice.h"

#include "render/denoise/cross_error.h"
#include "render/denoise/non_local_means.h"

namespace lancer::denoise {
namespace {

// The mean squared error of (F(A) + F(B)) / 2 of the first bandwidth minus that of the second, summed over channels.
// The variance of the halves is the same for both bandwidths.
Plane difference_of_errors(const Halves& halves, const Fitted& a, const Fitted& b)
{
    return plane_of(a[0][0].width(), a[0][0].height(), [&](int x, int y) {
        float sum = 0;
        for (size_t c = 0; c < 3; ++c) {
            const float in_a = halves.half[0].color[c].row(y)[x], in_b = halves.half[1].color[c].row(y)[x];
            const auto error = [&](size_t k) {
                return squared_error_and_noise(in_a, in_b, a[k][c].row(y)[x], b[k][c].row(y)[x]);
            };
            sum += error(0) - error(1);
        }
        return sum;
    });
}

// For each pixel the part of the second bandwidth.
Plane part_of_second(const Halves& halves, const ColorPlanes& variance, const Fitted& a, const Fitted& b)
{
    const int width = a[0][0].width(), height = a[0][0].height();
    ColorPlanes mean;
    for (size_t c = 0; c < 3; ++c)
        mean[c] = plane_of(width, height, [&](int x, int y) {
            return 0.5f * (halves.half[0].color[c].row(y)[x] + halves.half[1].color[c].row(y)[x]);
        });
    const Guide guide{mean, variance, 0.5f};  // the mean of both halves has half of the variance
    const Plane difference = difference_of_errors(halves, a, b);
    const Plane even = std::move(non_local_means({&difference, 1}, guide, {.patch_radius = 1, .window_radius = 7})[0]);
    return box_mean(plane_of(width, height, [&](int x, int y) { return even.row(y)[x] > 0 ? 1.0f : 0.0f; }), 3);
}

ColorPlanes mixed(Fitted fitted, const Plane& part_of_second)
{
    for (size_t c = 0; c < 3; ++c)
        for_rows(part_of_second.height(), [&](int y) {
            float* const v = fitted[0][c].row(y);
            for (int x = 0; x < part_of_second.width(); ++x)
                v[x] += part_of_second.row(y)[x] * (fitted[1][c].row(y)[x] - v[x]);
        });
    return std::move(fitted[0]);
}

}  // namespace

FilteredHalves choose_bandwidth(const Halves& halves, const ColorPlanes& variance, Fitted a, Fitted b)
{
    const Plane second = part_of_second(halves, variance, a, b);
    return {mixed(std::move(a), second), mixed(std::move(b), second)};
}

}  // namespace lancer::denoise
