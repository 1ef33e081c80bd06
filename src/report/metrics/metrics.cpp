#include "report/metrics/metrics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "core/error.h"

namespace lancer {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool same_bits(Color a, Color b)
{
    const auto same = [](float p, float q) { return std::bit_cast<uint32_t>(p) == std::bit_cast<uint32_t>(q); };
    return same(a.r, b.r) && same(a.g, b.g) && same(a.b, b.b);
}

double or_infinity(double v) { return std::isnan(v) ? infinity : v; }

std::string describe(const Image& image)
{
    const auto text = [](const Window& w) {
        return std::to_string(w.width()) + " x " + std::to_string(w.height()) + " at (" + std::to_string(w.x0) + ", " +
               std::to_string(w.y0) + ")";
    };
    return image.data == image.display ? text(image.data) : text(image.data) + " of " + text(image.display);
}

double sum(const std::vector<double>& values)
{
    double total = 0;
    for (const double v : values) total += v;
    return total;
}

// The mean without the largest tenth of a percent. The rest is summed in the order of pixels, not of size.
double trimmed_mean(const std::vector<double>& errors)
{
    const size_t dropped = errors.size() / 1000, kept = errors.size() - dropped;
    if (dropped == 0) return sum(errors) / static_cast<double>(kept);
    std::vector<double> sorted = errors;
    const auto limit = sorted.begin() + static_cast<std::ptrdiff_t>(kept - 1);
    std::nth_element(sorted.begin(), limit, sorted.end());
    double total = 0;
    size_t below = 0;
    for (const double e : errors) {
        if (e < *limit) total += e, ++below;
    }
    // Several pixels may have exactly the limiting error; only as many of them belong to the rest as it has room for.
    total += static_cast<double>(kept - below) * *limit;
    return total / static_cast<double>(kept);
}

// By rank: the least value that 99 % of them do not exceed.
double percentile_99(std::vector<double> values)
{
    const size_t rank = (values.size() * 99 + 99) / 100;  // rounded up
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank - 1);
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

double symmetric_error(double x, double r)
{
    if (x == 0 && r == 0) return 0;
    const double error = std::abs(x - r) / (std::abs(x) + std::abs(r));
    return std::isnan(error) ? 1 : error;
}

}  // namespace

void require_same_windows(const Image& a, const Image& b)
{
    if (a.data != b.data || a.display != b.display) {
        throw Error(ErrorKind::invalid_input,
                    "error: the pictures differ in size: " + describe(a) + " against " + describe(b));
    }
    if (a.pixels.empty()) throw Error(ErrorKind::invalid_input, "error: the pictures have no pixels");
}

std::vector<double> relative_squared_errors(const Image& x, const Image& reference)
{
    require_same_windows(x, reference);
    std::vector<double> errors(x.pixels.size());
    for (size_t i = 0; i < errors.size(); ++i) {
        const std::array<double, 3> xs = channels(x.pixels[i]), rs = channels(reference.pixels[i]);
        for (size_t c = 0; c < 3; ++c) {
            const double difference = or_infinity(xs[c] - rs[c]);
            errors[i] += or_infinity(difference * difference / (rs[c] * rs[c] + relmse_epsilon)) / 3;
        }
    }
    return errors;
}

Metrics compare(const Image& x, const Image& reference)
{
    require_same_windows(x, reference);
    Metrics m;
    m.max_x = x.data.x0, m.max_y = x.data.y0;
    const size_t n = x.pixels.size(), width = static_cast<size_t>(x.data.width());
    double squared = 0, symmetric = 0;
    for (size_t i = 0; i < n; ++i) {
        const Color a = x.pixels[i], b = reference.pixels[i];
        const std::array<double, 3> xs = channels(a), rs = channels(b);
        double pixel_difference = 0;
        for (size_t c = 0; c < 3; ++c) {
            const double difference = or_infinity(xs[c] - rs[c]);
            squared += difference * difference;
            symmetric += symmetric_error(xs[c], rs[c]);
            pixel_difference = std::max(pixel_difference, std::abs(difference));
            m.mean[c] += xs[c];
            m.reference_mean[c] += rs[c];
        }
        if (pixel_difference > m.max_difference) {
            m.max_difference = pixel_difference;
            m.max_x = x.data.x0 + static_cast<int32_t>(i % width);
            m.max_y = x.data.y0 + static_cast<int32_t>(i / width);
        }
        m.differing_pixels += !same_bits(a, b);
        m.non_finite_pixels += !is_finite(a);
        m.reference_non_finite += !is_finite(b);
    }
    const double count = static_cast<double>(n);
    m.rmse = std::sqrt(squared / (3 * count));
    m.smape = symmetric / (3 * count);
    const std::vector<double> relative = relative_squared_errors(x, reference);
    m.relmse = sum(relative) / count;
    m.relmse_trimmed = trimmed_mean(relative);
    m.relmse_p99 = percentile_99(relative);
    for (size_t c = 0; c < 3; ++c) {
        m.mean[c] /= count;
        m.reference_mean[c] /= count;
        m.mean_ratio[c] = m.mean[c] / m.reference_mean[c];
    }
    return m;
}

size_t pixels_beyond(double limit, const Image& x, const Image& reference)
{
    require_same_windows(x, reference);
    size_t count = 0;
    for (size_t i = 0; i < x.pixels.size(); ++i) {
        const std::array<double, 3> xs = channels(x.pixels[i]), rs = channels(reference.pixels[i]);
        bool beyond = false;
        for (size_t c = 0; c < 3; ++c) beyond = beyond || !(std::abs(xs[c] - rs[c]) <= limit);
        count += beyond;
    }
    return count;
}

double unbiased_squared_error(const Image& x, const Image& r1, const Image& r2)
{
    require_same_windows(x, r1);
    require_same_windows(x, r2);
    double total = 0;
    for (size_t i = 0; i < x.pixels.size(); ++i) {
        const std::array<double, 3> xs = channels(x.pixels[i]), a = channels(r1.pixels[i]), b = channels(r2.pixels[i]);
        for (size_t c = 0; c < 3; ++c) total += (xs[c] - a[c]) * (xs[c] - b[c]) / (a[c] * b[c] + relmse_epsilon);
    }
    return or_infinity(total / (3 * static_cast<double>(x.pixels.size())));
}

}  // namespace lancer
