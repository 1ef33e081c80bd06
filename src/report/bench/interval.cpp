#include "report/bench/interval.h"

#include <algorithm>

#include "report/metrics/statistics.h"

namespace lancer {
namespace {

constexpr size_t fewest_rounds = 6;  // with fewer, an interval of the median is wrong more often than once in twenty

}  // namespace

std::vector<double> speed_ratios(const std::vector<double>& base, const std::vector<double>& other)
{
    std::vector<double> ratios;
    for (size_t i = 0; i < base.size(); ++i) ratios.push_back(base[i] / other[i]);
    return ratios;
}

std::vector<double> block_medians(std::span<const double> values)
{
    const size_t blocks = std::min(values.size(), most_blocks);
    std::vector<double> medians;
    for (size_t b = 0; b < blocks; ++b) {
        const size_t first = b * values.size() / blocks, last = (b + 1) * values.size() / blocks;
        const auto block = values.subspan(first, last - first);
        medians.push_back(median({block.begin(), block.end()}));
    }
    return medians;
}

Ranged estimate(std::span<const double> values)
{
    const std::vector<double> medians = block_medians(values);
    Ranged r{median(medians)};
    if (values.size() < fewest_rounds) return r;
    const Interval interval = median_interval(medians);
    r.low = interval.low, r.high = interval.high;
    return r;
}

}  // namespace lancer
