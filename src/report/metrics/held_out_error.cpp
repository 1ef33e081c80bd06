#include "report/metrics/held_out_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "report/metrics/metrics.h"

namespace lancer {
namespace {

constexpr uint32_t block = 16;  // side of the blocks of pixels whose errors count as independent

// Whether two pixels are alike: within a factor of 2 where they are not black.
bool alike(Color a, Color b)
{
    const double black = std::sqrt(relmse_epsilon), u = double{luminance(a)} + black, v = double{luminance(b)} + black;
    return u <= 2 * v && v <= 2 * u;
}

// The noisy picture, averaged over those of 5x5 pixels that are like the middle one in the denoised picture: that
// picture itself would be small where it errs, and the mean of all pixels large beside a lamp.
std::array<double, 3> mean_around(const Film& film, const std::vector<Color>& denoised, uint32_t x, uint32_t y)
{
    constexpr uint32_t reach = 2;
    const Tile& crop = film.crop;
    const Color middle = denoised[film.index(x, y)];
    std::array<double, 3> sum{};
    double n = 0;
    for (uint32_t v = std::max(y, crop.y0 + reach) - reach; v < std::min(y + reach + 1, crop.y1); ++v)
        for (uint32_t u = std::max(x, crop.x0 + reach) - reach; u < std::min(x + reach + 1, crop.x1); ++u) {
            const size_t i = film.index(u, v);
            if (!alike(denoised[i], middle)) continue;
            const auto mean = channels(film.whole(i).mean());
            for (size_t c = 0; c < 3; ++c) sum[c] += mean[c];
            ++n;
        }
    for (double& s : sum) s /= n;
    return sum;
}

// Mean over the channels of a pixel.
double error_at(const Film& film, const std::vector<Color>& denoised, uint32_t x, uint32_t y, const SampleSet& one,
                const SampleSet& two)
{
    const auto value = channels(denoised[film.index(x, y)]), around = mean_around(film, denoised, x, y);
    double error = 0;
    for (size_t c = 0; c < 3; ++c)
        error += (value[c] - one.sum[c] / one.n) * (value[c] - two.sum[c] / two.n) /
                 (around[c] * around[c] + relmse_epsilon) / 3;
    return error;
}

}  // namespace

std::optional<HeldOutError> held_out_error(const Film& film, const std::vector<Color>& denoised)
{
    const uint32_t columns = (film.crop.width() + block - 1) / block;
    const size_t count = size_t{columns} * ((film.crop.height() + block - 1) / block);
    std::vector<double> errors(count), pixels(count);
    for (uint32_t y = film.crop.y0; y < film.crop.y1; ++y)
        for (uint32_t x = film.crop.x0; x < film.crop.x1; ++x) {
            const size_t i = film.index(x, y);
            const SampleSet &one = film.sets[4 * i + 2], &two = film.sets[4 * i + 3];
            if (one.n == 0 || two.n == 0) continue;
            const double error = error_at(film, denoised, x, y, one, two);
            const size_t b = size_t{(y - film.crop.y0) / block} * columns + (x - film.crop.x0) / block;
            errors[b] += error, ++pixels[b];
        }
    const double all = std::accumulate(pixels.begin(), pixels.end(), 0.0);
    if (all == 0) return {};
    const double mean = std::accumulate(errors.begin(), errors.end(), 0.0) / all;
    if (count == 1) return HeldOutError{mean, {mean - std::abs(mean), mean + std::abs(mean)}};
    return HeldOutError{mean, mean_interval(errors, pixels)};
}

}  // namespace lancer
