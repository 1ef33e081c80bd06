#include "support/statistics/chi_square.h"

namespace lancer {

double regularised_gamma_q(double a, double x)
{
    if (!(x > 0)) return 1;
    const double scale = std::exp(a * std::log(x) - x - std::lgamma(a));
    constexpr double epsilon = 1e-15;
    if (x < a + 1) {
        double term = 1 / a, sum = term;
        for (double n = a + 1; term > sum * epsilon; ++n) sum += term *= x / n;
        return std::clamp(1 - scale * sum, 0.0, 1.0);
    }
    constexpr double tiny = 1e-300;
    double b = x + 1 - a, c = 1 / tiny, d = 1 / b, fraction = d;
    for (int i = 1; i < 100000; ++i) {
        const double numerator = -i * (i - a);
        b += 2;
        d = numerator * d + b;
        c = b + numerator / c;
        d = 1 / (std::abs(d) < tiny ? tiny : d);
        c = std::abs(c) < tiny ? tiny : c;
        fraction *= d * c;
        if (std::abs(d * c - 1) < epsilon) break;
    }
    return std::clamp(scale * fraction, 0.0, 1.0);
}

ChiSquare chi_square_test(const std::vector<uint64_t>& observed, const std::vector<double>& expected)
{
    std::vector<size_t> order(observed.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return expected[a] < expected[b]; });
    ChiSquare result;
    uint64_t cells = 0;
    double pooled_observed = 0, pooled_expected = 0;
    const auto add = [&](double o, double e) {
        result.statistic += (o - e) * (o - e) / e;
        ++cells;
    };
    for (const size_t i : order) {
        if (expected[i] <= 0) {
            if (observed[i] == 0) continue;
            return {std::numeric_limits<double>::infinity(), 0, 0};
        }
        const auto o = static_cast<double>(observed[i]);
        if (expected[i] < 5 || (pooled_expected > 0 && pooled_expected < 5)) {
            pooled_observed += o, pooled_expected += expected[i];
        } else {
            add(o, expected[i]);
        }
    }
    if (pooled_expected > 0) add(pooled_observed, pooled_expected);
    if (cells < 2) return {result.statistic, 0, 1};
    result.degrees = cells - 1;
    result.p = chi_square_survival(result.statistic, static_cast<double>(result.degrees));
    return result;
}

ChiSquare chi_square_uniform(const std::vector<uint64_t>& observed)
{
    const auto total = static_cast<double>(std::accumulate(observed.begin(), observed.end(), uint64_t{0}));
    return chi_square_test(observed,
                           std::vector<double>(observed.size(), total / static_cast<double>(observed.size())));
}

}  // namespace lancer
