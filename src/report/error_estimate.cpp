#include "report/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "report/metrics.h"

namespace lancer {
namespace {

// The mean of each pixel's neighbours, without itself.
std::vector<std::array<double, 3>> around_each(const Film& film)
{
    const size_t width = film.crop.width(), height = film.crop.height();
    std::vector<std::array<double, 3>> means(film.pixels.size()), all(film.pixels.size());
    for (size_t i = 0; i < means.size(); ++i) means[i] = channels(film.whole(i).mean());
    for (size_t y = 0; y < height; ++y)
        for (size_t x = 0; x < width; ++x) {
            std::array<double, 3> around{};
            double n = 0;
            for (size_t v = y == 0 ? 0 : y - 1; v < std::min(height, y + 2); ++v)
                for (size_t u = x == 0 ? 0 : x - 1; u < std::min(width, x + 2); ++u) {
                    if (u == x && v == y) continue;
                    for (size_t c = 0; c < 3; ++c) around[c] += means[v * width + u][c];
                    ++n;
                }
            for (double& sum : around) sum /= n;
            all[y * width + x] = n > 0 ? around : means[y * width + x];
        }
    return all;
}

// The square of what a pixel would show without noise, as far as that can be told without believing a sample that
// sticks out: as the pixel has it (without bias: a product of independent halves, or less the variance) or its
// neighbours, whichever is less. Beside a lamp the neighbours are too bright.
double without_noise(double own_squared, double around)
{
    return std::max(0.0, std::min(own_squared, around * around));
}

// The same without a bias towards less: as the pixel has it where it is nearly sure of that, else its neighbours; but
// beside an edge, where they are more than twice as bright, the pixel after all. variance: of the pixel's mean.
double seen_around(double mean, double variance, double around)
{
    constexpr double nearly_sure = 0.02;  // of the square: a deviation of a seventh
    const double own_squared = mean * mean - variance, squared = around * around;
    const bool takes_own = variance < nearly_sure * mean * mean || squared > 4 * own_squared;
    return std::max(0.0, takes_own ? own_squared : squared);
}

}  // namespace

void HalfBuffers::look(const Film& film)
{
    halves_.resize(film.pixels.size());
    std::vector<std::array<double, 3>> around;  // only where samples have doubled: it takes a while
    double sum = 0;
    size_t known = 0;
    for (size_t i = 0; i < halves_.size(); ++i) {
        const Pixel pixel = film.whole(i);
        if (pixel.n == 0) continue;
        Half& half = halves_[i];
        const double n = pixel.n, before = half.n, since = n - before;
        // A second half that is a fraction of the first is too few points to be spread evenly; but better than nothing.
        if (half.n == 0 || since >= before || (half.error < 0 && since > 0)) {
            const Color mean = pixel.mean();
            if (half.n != 0) {
                if (around.empty()) around = around_each(film);
                const auto all = channels(mean), first = channels(half.mean);
                double error = 0;
                for (size_t c = 0; c < 3; ++c) {
                    const double second = (n * all[c] - before * first[c]) / since, apart = first[c] - second;
                    error += apart * apart / (without_noise(first[c] * second, around[i][c]) + relmse_epsilon) / 3;
                }
                half.error = static_cast<float>(error * before * since / (n * n));
            }
            half.mean = mean, half.n = pixel.n;
        }
        if (half.error < 0) continue;
        sum += double{half.error} * half.n / n;
        ++known;
    }
    if (known != 0) error_ = sum / static_cast<double>(known);
}

std::optional<ReplicateError> estimate_from_replicates(const Film& film, uint32_t replicates)
{
    double sum = 0, squares = 0;
    size_t known = 0;
    const double r = replicates;
    const auto around = around_each(film);
    for (size_t i = 0; i < film.pixels.size(); ++i) {
        const auto first = film.replicates.begin() + static_cast<std::ptrdiff_t>(i * replicates);
        const std::span<const ReplicateSum> all(first, first + replicates);
        if (std::any_of(all.begin(), all.end(), [](const ReplicateSum& s) { return s.n == 0; })) continue;
        double error = 0;
        for (size_t c = 0; c < 3; ++c) {
            double mean = 0, apart = 0;
            for (const ReplicateSum& s : all) mean += s.sum[c] / s.n / r;
            for (const ReplicateSum& s : all) apart += std::pow(s.sum[c] / s.n - mean, 2);
            const double variance = apart / (r - 1) / r;  // of the mean
            error += variance / (seen_around(mean, variance, around[i][c]) + relmse_epsilon) / 3;
        }
        sum += error, squares += error * error;
        ++known;
    }
    if (known == 0 || replicates < 2) return {};
    const double count = static_cast<double>(known), error = sum / count;
    // Both the error that there is and its estimate scatter about what is expected: of normal means a channel's square
    // by 2 v^2 and its estimate by 2 v^2 / (r - 1). Channels of a pixel mostly err together, so they are taken for one.
    const double expected = squares / (1 + 2 / (r - 1));
    const double reach = 1.959964 * std::sqrt(2 * (1 + 1 / (r - 1)) * expected) / count;
    return ReplicateError{error, {std::max(0.0, error - reach), error + reach}};
}

}  // namespace lancer
