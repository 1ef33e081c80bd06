#include "render/filter.h"

namespace lancer {
namespace {

constexpr double radius = 1.5;

double value(FilterKind kind, double x)
{
    if (kind == FilterKind::gaussian) return std::exp(-x * x / (2 * 0.5 * 0.5));
    if (kind == FilterKind::narrow_gaussian) return std::exp(-x * x / (2 * 0.3 * 0.3));
    // Harris, "On the Use of Windows for Harmonic Analysis", 1978: the 4-term window of -92 dB.
    const double t = 2 * pi_d * (x / (2 * radius) + 0.5);
    return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) - 0.01168 * std::cos(3 * t);
}

}  // namespace

Filter::Filter(FilterKind kind)
{
    if (kind == FilterKind::centre) width_ = 0;
    if (kind == FilterKind::box || kind == FilterKind::centre) return;
    constexpr size_t fine = 1 << 14, entries = 1 << 10;
    std::vector<double> cumulative(fine + 1);
    for (size_t i = 0; i < fine; ++i) {
        const double x = radius * (2 * (static_cast<double>(i) + 0.5) / fine - 1);
        cumulative[i + 1] = cumulative[i] + value(kind, x);
    }
    const auto inverse = [&](double u) {
        const double want = cumulative[fine] * u;
        const auto above = std::lower_bound(cumulative.begin() + 1, cumulative.end(), want);
        const double f = (want - *(above - 1)) / (*above - *(above - 1));
        const auto k = static_cast<double>(above - 1 - cumulative.begin());
        return static_cast<float>(radius * (2 * (k + f) / fine - 1));
    };
    for (size_t i = 0; i <= entries; ++i) {
        const double x = static_cast<double>(i) / entries;
        body_.push_back(inverse(0.5 * x));
        tail_.push_back(inverse(static_cast<double>(tail) * x));
    }
}

}  // namespace lancer
