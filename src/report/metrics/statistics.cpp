#include "report/metrics/statistics.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/hash.h"

namespace lancer {
namespace {

constexpr size_t resamplings = 2000;

// The index of draw `draw` of a resampling, in [0, size).
size_t drawn(uint64_t seed, size_t resampling, size_t draw, size_t size)
{
    const uint64_t bits = mix_bits(mix_bits(seed + 0x9e3779b97f4a7c15ull * (resampling + 1)) + draw);
    return static_cast<size_t>((bits >> 32) * size >> 32);
}

// Where the middle 95 % of the values lie.
Interval middle(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const auto at = [&](double part) {
        return values[static_cast<size_t>(std::lround(part * static_cast<double>(values.size() - 1)))];
    };
    return {at(0.025), at(0.975)};
}

std::vector<double> logarithms(std::span<const double> values)
{
    std::vector<double> logs;
    for (const double v : values) logs.push_back(std::log(v));
    return logs;
}

struct Line {
    double slope = 0, offset = 0;
};

Line fit_line(const std::vector<double>& x, const std::vector<double>& y)
{
    const auto n = static_cast<double>(x.size());
    double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
    for (size_t i = 0; i < x.size(); ++i) mean_x += x[i] / n, mean_y += y[i] / n;
    for (size_t i = 0; i < x.size(); ++i) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
    }
    return {xy / xx, mean_y - xy / xx * mean_x};
}

}  // namespace

double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2) return *middle;
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

Spread spread_of(std::span<const double> values)
{
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return {median({values.begin(), values.end()}), *least, *most};
}

double geometric_mean(std::span<const double> values)
{
    double sum = 0;
    for (const double v : values) sum += std::log(v);
    return std::exp(sum / static_cast<double>(values.size()));
}

double student_reach(double degrees)
{
    constexpr double z = 1.959963984540054;  // of the normal distribution
    const double z2 = z * z, v = 1 / degrees;
    const double g1 = (z2 + 1) / 4, g2 = ((5 * z2 + 16) * z2 + 3) / 96,
                 g3 = (((3 * z2 + 19) * z2 + 17) * z2 - 15) / 384,
                 g4 = ((((79 * z2 + 776) * z2 + 1482) * z2 - 1920) * z2 - 945) / 92160;
    return z * (1 + v * (g1 + v * (g2 + v * (g3 + v * g4))));
}

Interval mean_interval(std::span<const double> values, std::span<const double> weights)
{
    double sum = 0, weight = 0, squares = 0, fourths = 0;
    for (size_t i = 0; i < values.size(); ++i) sum += values[i], weight += weights[i];
    const double mean = sum / weight, n = static_cast<double>(values.size());
    for (size_t i = 0; i < values.size(); ++i) {
        const double off = values[i] - mean * weights[i], square = off * off;
        squares += square, fourths += square * square;
    }
    if (squares == 0) return {mean, mean};
    const double kurtosis = n * fourths / (squares * squares);
    const double degrees = kurtosis > 1 ? std::clamp(2 * n / (kurtosis - 1), 1.0, n - 1) : n - 1;
    const double reach = student_reach(degrees) * std::sqrt(squares * n / (n - 1)) / weight;
    return {mean - reach, mean + reach};
}

Interval median_interval(std::span<const double> values, uint64_t seed)
{
    std::vector<double> sample(values.size());
    return resampled_interval(values.size(), seed, [&](std::span<const size_t> chosen) {
        for (size_t i = 0; i < sample.size(); ++i) sample[i] = values[chosen[i]];
        return median(sample);
    });
}

Interval resampled_interval(size_t count, uint64_t seed, const ResampledStatistic& statistic)
{
    std::vector<double> found;
    std::vector<size_t> chosen(count);
    for (size_t r = 0; r < resamplings; ++r) {
        for (size_t i = 0; i < count; ++i) chosen[i] = drawn(seed, r, i, count);
        found.push_back(statistic(chosen));
    }
    return middle(std::move(found));
}

double fitted_exponent(std::span<const double> x, std::span<const double> y)
{
    return fit_line(logarithms(x), logarithms(y)).slope;
}

PowerLaw fit_power_law(std::span<const double> x, std::span<const double> y, uint64_t seed)
{
    const auto usable = [](double v) { return v > 0 && std::isfinite(v); };
    if (x.size() != y.size() || x.size() < 3 || !std::all_of(x.begin(), x.end(), usable) ||
        !std::all_of(y.begin(), y.end(), usable) ||
        std::all_of(x.begin(), x.end(), [&](double v) { return v == x[0]; }))
        throw Error(ErrorKind::failed, {}, "a power law wants three points or more, positive, not all in one place");
    const std::vector<double> log_x = logarithms(x), log_y = logarithms(y);
    const Line line = fit_line(log_x, log_y);

    // What is left over is smaller than the errors were, as the line went after them.
    const auto n = static_cast<double>(x.size());
    const double widen = std::sqrt(n / (n - 2));
    std::vector<double> fitted, rest;
    for (size_t i = 0; i < x.size(); ++i) {
        fitted.push_back(line.offset + line.slope * log_x[i]);
        rest.push_back((log_y[i] - fitted[i]) * widen);
    }
    std::vector<double> slopes, other(x.size());
    for (size_t r = 0; r < resamplings; ++r) {
        for (size_t i = 0; i < x.size(); ++i) other[i] = fitted[i] + rest[drawn(seed, r, i, x.size())];
        slopes.push_back(fit_line(log_x, other).slope);
    }
    return {line.slope, std::exp(line.offset), middle(std::move(slopes))};
}

}  // namespace lancer
