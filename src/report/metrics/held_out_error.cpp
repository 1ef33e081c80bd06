#include "report/metrics/held_out_error.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "report/metrics/metrics.h"

namespace lancer {
namespace {

constexpr uint32_t block = 16;  // side of the blocks of pixels whose errors count as independent

// The noisy picture, averaged over 5x5 pixels: denominators of the denoised picture itself would be small where it
// errs.
std::array<double, 3> mean_around(const Film& film, uint32_t x, uint32_t y)
{
    constexpr uint32_t reach = 2;
    const Tile& crop = film.crop;
    std::array<double, 3> sum{};
    double n = 0;
    for (uint32_t v = std::max(y, crop.y0 + reach) - reach; v < std::min(y + reach + 1, crop.y1); ++v)
        for (uint32_t u = std::max(x, crop.x0 + reach) - reach; u < std::min(x + reach + 1, crop.x1); ++u) {
            const auto mean = channels(film.whole(film.index(u, v)).mean());
            for (size_t c = 0; c < 3; ++c) sum[c] += mean[c];
            ++n;
        }
    for (double& s : sum) s /= n;
    return sum;
}

// Mean over the channels of a pixel.
double error_at(const Film& film, uint32_t x, uint32_t y, const Color& denoised, const SampleSet& one,
                const SampleSet& two)
{
    const auto value = channels(denoised), around = mean_around(film, x, y);
    double error = 0;
    for (size_t c = 0; c < 3; ++c)
        error += (value[c] - one.sum[c] / one.n) * (value[c] - two.sum[c] / two.n) /
                 (around[c] * around[c] + relmse_epsilon) / 3;
    return error;
}

}  // namespace

std::optional<HeldOutError> held_out_error(const Film& film, const std::vector<Color>& denoised)
{
    struct Sum {
        double error = 0, pixels = 0;
    };
    const uint32_t columns = (film.crop.width() + block - 1) / block;
    std::vector<Sum> blocks(size_t{columns} * ((film.crop.height() + block - 1) / block));
    Sum all;
    for (uint32_t y = film.crop.y0; y < film.crop.y1; ++y)
        for (uint32_t x = film.crop.x0; x < film.crop.x1; ++x) {
            const size_t i = film.index(x, y);
            const SampleSet &one = film.sets[4 * i + 2], &two = film.sets[4 * i + 3];
            if (one.n == 0 || two.n == 0) continue;
            const double error = error_at(film, x, y, denoised[i], one, two);
            Sum& b = blocks[size_t{(y - film.crop.y0) / block} * columns + (x - film.crop.x0) / block];
            b.error += error, ++b.pixels;
            all.error += error, ++all.pixels;
        }
    if (all.pixels == 0) return {};
    const double mean = all.error / all.pixels, n = static_cast<double>(blocks.size());
    double squares = 0;
    for (const Sum& b : blocks) squares += std::pow(b.error - mean * b.pixels, 2);
    const double reach = n > 1 ? 1.96 * std::sqrt(squares * n / (n - 1)) / all.pixels : std::abs(mean);
    return HeldOutError{mean, {mean - reach, mean + reach}};
}

}  // namespace lancer
