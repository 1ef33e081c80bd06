#include "render/denoise/denoise.h"

#include <algorithm>
#include <limits>

#include "render/denoise/bandwidth_choice.h"
#include "render/denoise/cross_error.h"
#include "render/denoise/james_stein.h"
#include "render/denoise/non_local_means.h"
#include "render/denoise/outliers.h"

namespace lancer {
namespace denoise {
namespace {

// The mean of planes of both halves.
Plane mean_of(const Plane& a, const Plane& b, float part_of_b)
{
    return plane_of(a.width(), a.height(),
                    [&](int x, int y) { return a.row(y)[x] + part_of_b * (b.row(y)[x] - a.row(y)[x]); });
}

FilteredHalves filter_halves(Halves& halves, const ColorPlanes& variance, const std::stop_token& stop)
{
    filter_features(halves);
    const auto& [a, b] = halves.half;
    // Weights come from noise that is independent of what they weight. They compare noisy patches, whose variance
    // counts twice.
    constexpr float variance_factor = 2;
    Fitted of_a = fit_first_order(a.color, b.features, {b.color, variance, variance_factor}, stop);
    Fitted of_b = fit_first_order(b.color, a.features, {a.color, variance, variance_factor}, stop);
    if (stop.stop_requested()) return {};
    return choose_bandwidth(halves, variance, std::move(of_a), std::move(of_b));
}

// Half of a variance: that of the mean of two.
Plane halved(const Plane& variance)
{
    return plane_of(variance.width(), variance.height(), [&](int x, int y) { return 0.5f * variance.row(y)[x]; });
}

// The squared error of the mean of both filtered halves in a channel, over a square of pixels.
Plane filter_error(const Halves& halves, const FilteredHalves& filtered, const Plane& variance, size_t c)
{
    const Plane error = plane_of(variance.width(), variance.height(), [&](int x, int y) {
        return squared_error_and_noise(halves.half[0].color[c].row(y)[x], halves.half[1].color[c].row(y)[x],
                                       filtered.a[c].row(y)[x], filtered.b[c].row(y)[x]) -
               variance.row(y)[x];
    });
    return box_mean(error, blend_radius);
}

// Fits may fall below 0 in the dark, light may not; a pixel filter with negative lobes may.
Plane without_negative_light(const Plane& filtered, const Plane& noisy)
{
    return plane_of(filtered.width(), filtered.height(),
                    [&](int x, int y) { return std::max(filtered.row(y)[x], std::min(0.0f, noisy.row(y)[x])); });
}

float& channel(Color& color, size_t c) { return c == 0 ? color.r : c == 1 ? color.g : color.b; }

// Rows of a picture, half-open: `inner` of them are wanted, and what lies around decides about them as well.
struct Band {
    uint32_t y0, y1, inner_y0, inner_y1;
};

// How many rows away a pixel may be and still decide: 9 by outliers, 10 by variances, 12 by weights, 4 * 9 by fits and
// those in between, 11 by the choice of a bandwidth, 9 by the blend.
constexpr uint32_t reach = 87;

std::vector<Band> bands_of(uint32_t width, uint32_t height, uint32_t rows_at_once)
{
    constexpr uint32_t pixels_at_once = 1u << 23, period = row_period;
    const auto rounded_up = [](uint32_t rows) { return (rows + period - 1) / period * period; };
    const uint32_t rows = rounded_up(std::max(1u, rows_at_once > 0 ? rows_at_once : pixels_at_once / width));
    std::vector<Band> bands;
    for (uint32_t y = 0; y < height; y += rows) {
        const uint32_t above = std::min(y, rounded_up(reach)), end = std::min(height, y + rows);
        bands.push_back({y - above, std::min(height, end + reach), y, end});
    }
    return bands;
}

// The rows of a band.
DenoiseInput rows_of(DenoiseInput input, const Band& band)
{
    const auto cut = [&](std::span<const float>& plane) {
        if (!plane.empty())
            plane = plane.subspan(size_t{band.y0} * input.width, size_t{band.y1 - band.y0} * input.width);
    };
    for (DenoiseHalf& half : input.halves) {
        for (auto& plane : half.color) cut(plane);
        for (auto& plane : half.albedo) cut(plane);
        for (auto& plane : half.normal) cut(plane);
        cut(half.depth);
    }
    cut(input.variance);
    input.height = band.y1 - band.y0;
    return input;
}

// Blends one channel of a band and adds its error to the map.
void finish_channel(const Halves& halves, const FilteredHalves& filtered, const Plane& variance, size_t c,
                    const Band& band, Denoised& out)
{
    const Plane noisy = mean_of(halves.half[0].color[c], halves.half[1].color[c], halves.part_of_b);
    const Plane mean = without_negative_light(mean_of(filtered.a[c], filtered.b[c], halves.part_of_b), noisy);
    const Plane own = halved(variance), noise = box_mean(own, blend_radius), part = noisy_part(mean, noisy, own);
    const Plane error = filter_error(halves, filtered, variance, c);
    const double black = 0.01 * double{halves.scale} * double{halves.scale};  // see Denoised::error
    constexpr float largest = std::numeric_limits<float>::max();
    for_rows(static_cast<int>(band.inner_y1 - band.inner_y0), [&](int row) {
        const size_t first = (band.inner_y0 + static_cast<size_t>(row)) * static_cast<size_t>(mean.width());
        const int y = row + static_cast<int>(band.inner_y0 - band.y0);
        for (int x = 0; x < mean.width(); ++x) {
            const float p = part.row(y)[x], f = mean.row(y)[x];
            const float value = f + p * (noisy.row(y)[x] - f);
            channel(out.pixels[first + static_cast<size_t>(x)], c) =
                std::clamp(value / halves.scale, -largest, largest);
            const float e = (1 - p) * (1 - p) * std::max(0.0f, error.row(y)[x]) + p * p * noise.row(y)[x];
            const double square = double{value} * double{value};
            out.error[first + static_cast<size_t>(x)] += static_cast<float>(double{e} / (square + black) / 3);
        }
    });
}

void denoise_band(const DenoiseInput& input, const Scales& scales, const Band& band, const std::stop_token& stop,
                  Denoised& out)
{
    Halves halves = load_halves(rows_of(input, band), scales);
    spread_outliers(halves);
    const ColorPlanes variance = variance_of_half(halves);
    const FilteredHalves filtered = filter_halves(halves, variance, stop);
    if (stop.stop_requested()) return;
    for (size_t c = 0; c < 3; ++c) finish_channel(halves, filtered, variance[c], c, band, out);
}

}  // namespace
}  // namespace denoise

Denoised denoise_picture(const DenoiseInput& input, const std::stop_token& stop, uint32_t rows_at_once)
{
    using namespace denoise;
    if (input.width == 0 || input.height == 0) return {};
    const Scales scales = scales_of(input);
    const size_t size = size_t{input.width} * input.height;
    Denoised out{std::vector<Color>(size), std::vector<float>(size), {}};
    for (const Band& band : bands_of(input.width, input.height, rows_at_once)) {
        denoise_band(input, scales, band, stop, out);
        if (stop.stop_requested()) return {};
    }
    return out;
}

uint64_t bytes_to_denoise(uint32_t width, uint32_t height)
{
    if (width == 0 || height == 0) return 0;
    constexpr uint64_t of_band = 400, of_result = sizeof(Color) + sizeof(float);  // per pixel; measured
    uint64_t most = 0;
    for (const denoise::Band& band : denoise::bands_of(width, height, 0))
        most = std::max<uint64_t>(most, band.y1 - band.y0);
    return width * (most * of_band + height * of_result);
}

}  // namespace lancer
