#include "render/filter.h"

namespace lancer {
namespace {

constexpr double radius = 1.5;

double value(FilterKind kind, double x)
{
    constexpr double pi_d = 3.14159265358979323846;
    if (kind == FilterKind::gaussian) return std::exp(-x * x / (2 * 0.5 * 0.5));
    // Harris, "On the Use of Windows for Harmonic Analysis", 1978: the 4-term window of -92 dB.
    const double t = 2 * pi_d * (x / (2 * radius) + 0.5);
    return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) - 0.01168 * std::cos(3 * t);
}

}  // namespace

Filter::Filter(FilterKind kind)
{
    if (kind == FilterKind::box) return;
    constexpr size_t fine = 1 << 14, entries = 1 << 10;
    std::vector<double> cumulative(fine + 1);
    for (size_t i = 0; i < fine; ++i) {
        const double x = radius * (2 * (static_cast<double>(i) + 0.5) / fine - 1);
        cumulative[i + 1] = cumulative[i] + value(kind, x);
    }
    table_.resize(entries + 1);
    size_t k = 0;
    for (size_t i = 0; i <= entries; ++i) {
        const double want = cumulative[fine] * static_cast<double>(i) / entries;
        while (k + 1 < fine && cumulative[k + 1] < want) ++k;
        const double f = (want - cumulative[k]) / (cumulative[k + 1] - cumulative[k]);
        table_[i] = static_cast<float>(radius * (2 * (static_cast<double>(k) + f) / fine - 1));
    }
}

}  // namespace lancer
