#include "report/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace lancer {
namespace {

constexpr double epsilon = 0.01;  // as in the metrics

std::array<double, 3> channels(Color c) { return {double{c.r}, double{c.g}, double{c.b}}; }

}  // namespace

void HalfBuffers::look(const Film& film)
{
    halves_.resize(film.pixels.size());
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
                const auto all = channels(mean), first = channels(half.mean);
                double error = 0;
                for (size_t c = 0; c < 3; ++c) {
                    const double second = (n * all[c] - before * first[c]) / since, apart = first[c] - second;
                    error += apart * apart / (all[c] * all[c] + epsilon) / 3;
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
    for (size_t i = 0; i < film.pixels.size(); ++i) {
        const auto first = film.replicates.begin() + static_cast<std::ptrdiff_t>(i * replicates);
        const std::span<const ReplicateSum> all(first, first + replicates);
        if (std::any_of(all.begin(), all.end(), [](const ReplicateSum& s) { return s.n == 0; })) continue;
        double error = 0;
        for (size_t c = 0; c < 3; ++c) {
            double mean = 0, apart = 0;
            for (const ReplicateSum& s : all) mean += s.sum[c] / s.n / r;
            for (const ReplicateSum& s : all) apart += std::pow(s.sum[c] / s.n - mean, 2);
            error += apart / (r - 1) / r / (mean * mean + epsilon) / 3;
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
