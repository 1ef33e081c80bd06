#include "report/metrics/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/parallel.h"
#include "report/metrics/metrics.h"

namespace lancer {
namespace {

using Channels = std::array<double, 3>;

// The mean of a pixel's neighbours without the pixel itself. value(i): value of pixel i of Film::pixels; not a number:
// it has none, as beyond the tiles of a shard.
template <class Value>
Channels mean_around(const Film& film, size_t x, size_t y, const Value& value)
{
    const size_t width = film.crop.width(), height = film.crop.height();
    Channels around{};
    double n = 0;
    for (size_t v = y == 0 ? 0 : y - 1; v < std::min(height, y + 2); ++v)
        for (size_t u = x == 0 ? 0 : x - 1; u < std::min(width, x + 2); ++u) {
            if (u == x && v == y) continue;
            const Channels c = value(v * width + u);
            if (std::isnan(c[0])) continue;
            for (size_t k = 0; k < 3; ++k) around[k] += c[k];
            ++n;
        }
    for (double& sum : around) sum /= n;
    return n > 0 ? around : value(y * width + x);
}
std::vector<Channels> around_each(const Film& film, const std::vector<Channels>& values)
{
    std::vector<Channels> all(values.size());
    const size_t width = film.crop.width();
    for (size_t i = 0; i < all.size(); ++i)
        all[i] = mean_around(film, i % width, i / width, [&](size_t k) { return values[k]; });
    return all;
}
// Of pixels [begin, end), or of all.
std::vector<Channels> means_of(const Film& film, size_t begin, size_t end)
{
    std::vector<Channels> means(end - begin);
    for (size_t i = begin; i < end; ++i) means[i - begin] = channels(film.whole(i).mean());
    return means;
}
std::vector<Channels> means_of(const Film& film) { return means_of(film, 0, film.pixels.size()); }

// Estimates the square of a pixel's noise-free value so that outliers do not count: the minimum of the pixel's own
// unbiased estimate (a product of independent halves, or the square minus the variance) and that of its neighbours,
// which are too bright beside a light.
double without_noise(double own_squared, double around)
{
    return std::max(0.0, std::min(own_squared, around * around));
}

// Statistics of the replicates.
struct Seen {
    std::vector<Channels> mean, variance;  // of that mean; 0 where it is not known
    std::vector<bool> known;
};

Seen see(const Film& film, uint32_t replicates)
{
    Seen seen{means_of(film), std::vector<Channels>(film.pixels.size()), std::vector<bool>(film.pixels.size())};
    const double r = replicates;
    for (size_t i = 0; i < film.pixels.size(); ++i) {
        const auto first = film.replicates.begin() + static_cast<std::ptrdiff_t>(i * replicates);
        const std::span<const ReplicateSum> all(first, first + replicates);
        if (std::any_of(all.begin(), all.end(), [](const ReplicateSum& s) { return s.n == 0; })) continue;
        for (size_t c = 0; c < 3; ++c) {
            double mean = 0, apart = 0;
            for (const ReplicateSum& s : all) mean += s.sum[c] / s.n / r;
            for (const ReplicateSum& s : all) apart += std::pow(s.sum[c] / s.n - mean, 2);
            seen.mean[i][c] = mean, seen.variance[i][c] = apart / (r - 1) / r;
        }
        seen.known[i] = true;
    }
    return seen;
}

// Estimates the square of each pixel's noise-free value without bias: a value between its own mean and that of its
// neighbours, weighted by the share of noise in their difference, minus the remaining noise. Lee, "Digital Image
// Enhancement and Noise Filtering by Use of Local Statistics", IEEE PAMI 2(2), 1980.
std::vector<Channels> squares_without_noise(const Film& film, const Seen& seen)
{
    std::vector<Channels> squares = seen.mean;
    for (Channels& square : squares)
        for (double& x : square) x *= x;
    const auto around = around_each(film, seen.mean), squares_around = around_each(film, squares),
               noise_around = around_each(film, seen.variance);
    for (size_t i = 0; i < squares.size(); ++i)
        for (size_t c = 0; c < 3; ++c) {
            const double middle = around[i][c], noise = seen.variance[i][c];
            const double spread = std::max(0.0, squares_around[i][c] - middle * middle - noise_around[i][c]);
            const double trust = spread > 0 ? spread / (spread + noise) : 0;
            const double between = middle + trust * (seen.mean[i][c] - middle);
            squares[i][c] = std::max(0.0, between * between - trust * trust * noise);
        }
    return squares;
}

// around(): the mean of the pixel's neighbours.
template <class Half, class Around>
void look_at(const Pixel& pixel, Half& half, const Around& around)
{
    const double n = pixel.n, before = half.n, since = n - before;
    // A second half much smaller than the first is not evenly distributed, but better than nothing.
    if (half.n != 0 && since < before && (half.error >= 0 || since == 0)) return;
    const Color mean = pixel.mean();
    if (half.n != 0) {
        const Channels all = channels(mean), first = channels(half.mean), beside = around();
        double error = 0;
        for (size_t c = 0; c < 3; ++c) {
            const double second = (n * all[c] - before * first[c]) / since, apart = first[c] - second;
            error += apart * apart / (without_noise(first[c] * second, beside[c]) + relmse_epsilon) / 3;
        }
        half.error = static_cast<float>(error * before * since / (n * n));
    }
    half.mean = mean, half.n = pixel.n;
}

struct ErrorSum {
    double sum = 0, squares = 0, count = 0;

    void add(double error) { sum += error, squares += error * error, ++count; }
    ErrorSum& operator+=(const ErrorSum& o)
    {
        sum += o.sum, squares += o.squares, count += o.count;
        return *this;
    }
};

}  // namespace

void HalfBuffers::look(const Film& film)
{
    halves_.resize(film.pixels.size());
    // Strips are summed in order, so that the result is the same for any number of threads.
    constexpr size_t strip = 16;  // rows
    const size_t width = film.crop.width(), height = film.crop.height();
    std::vector<ErrorSum> strips((height + strip - 1) / strip);
    parallel_for(strips.size(), [&](size_t s) {
        const size_t first = s * strip, last = std::min(height, first + strip);
        const size_t begin = (first == 0 ? 0 : first - 1) * width, end = std::min(height, last + 1) * width;
        std::vector<Channels> means;  // from `begin` on; only where samples have doubled: it takes a while
        for (size_t i = first * width; i < last * width; ++i) {
            const Pixel pixel = film.whole(i);
            if (pixel.n == 0) continue;
            look_at(pixel, halves_[i], [&] {
                if (means.empty()) {
                    means = means_of(film, begin, end);
                    for (size_t k = begin; k < end; ++k)
                        if (film.whole(k).n == 0) means[k - begin].fill(std::numeric_limits<double>::quiet_NaN());
                }
                return mean_around(film, i % width, i / width, [&](size_t k) { return means[k - begin]; });
            });
            if (halves_[i].error >= 0) strips[s].add(double{halves_[i].error} * halves_[i].n / pixel.n);
        }
    });
    ErrorSum all;
    for (const ErrorSum& of_strip : strips) all += of_strip;
    if (all.count == 0) return;
    // If few pixels have most of the error, those that have not yet met their bright samples are missing.
    const double mean = all.sum / all.count;
    error_ = mean + std::sqrt(std::max(0.0, all.squares - mean * all.sum)) / all.count;
}

std::optional<ReplicateError> estimate_from_replicates(const Film& film, uint32_t replicates)
{
    if (replicates < 2) return {};
    const Seen seen = see(film, replicates);
    const auto squares = squares_without_noise(film, seen);
    double sum = 0, sum_of_squares = 0;
    size_t known = 0;
    for (size_t i = 0; i < squares.size(); ++i) {
        if (!seen.known[i]) continue;
        double error = 0;
        for (size_t c = 0; c < 3; ++c) error += seen.variance[i][c] / (squares[i][c] + relmse_epsilon) / 3;
        sum += error, sum_of_squares += error * error;
        ++known;
    }
    if (known == 0) return {};
    const double r = replicates, count = static_cast<double>(known), error = sum / count;
    if (error == 0) return ReplicateError{};
    // Both the error that there is and its estimate scatter about what is expected: of normal means a channel's square
    // by 2 v^2 and its estimate by 2 v^2 / (r - 1). Channels of a pixel mostly err together, so they are taken for one.
    // In logarithms, as few pixels may have most of the error: then it may be several times as large, but not below 0.
    const double expected = sum_of_squares / (1 + 2 / (r - 1));
    const double reach = std::exp(1.959964 * std::sqrt(2 * (1 + 1 / (r - 1)) * expected) / sum);
    return ReplicateError{error, {error / reach, error * reach}};
}

}  // namespace lancer
