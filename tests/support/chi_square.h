// Is a sample drawn from the distribution it claims? Pearson's test, for counts in cells against their expectation.
// The significance of a family of n tests at level alpha: each is held to sidak(alpha, n).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace lancer {

// Q(a, x) = Gamma(a, x) / Gamma(a), a > 0, x >= 0: by its series for small x, else by the continued fraction
// (Abramowitz and Stegun, 6.5.29 and 6.5.31), evaluated from the front by the method of Lentz.
inline double regularised_gamma_q(double a, double x)
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

// Probability that a chi-square variable of that many degrees of freedom is at least x.
inline double chi_square_survival(double x, double degrees) { return regularised_gamma_q(degrees / 2, x / 2); }

struct ChiSquare {
    double statistic = 0;
    uint64_t degrees = 0;
    double p = 0;  // of a statistic at least so large, if the expectation is true
};

// Cells that expect fewer than 5 are pooled, smallest first; one in which nothing can be but something is, gives p = 0.
// Both sums must agree, as they do when every sample is in some cell.
inline ChiSquare chi_square_test(const std::vector<uint64_t>& observed, const std::vector<double>& expected)
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

// All cells expect the same.
inline ChiSquare chi_square_uniform(const std::vector<uint64_t>& observed)
{
    const auto total = static_cast<double>(std::accumulate(observed.begin(), observed.end(), uint64_t{0}));
    return chi_square_test(observed,
                           std::vector<double>(observed.size(), total / static_cast<double>(observed.size())));
}

// Level of each of n independent tests, so that all together fail by chance with probability alpha.
inline double sidak(double alpha, size_t n) { return -std::expm1(std::log1p(-alpha) / static_cast<double>(n)); }

// The level of one claim. All tests together make about 500: so that with other random numbers one is red by chance in
// one of a hundred runs, and not in every run.
inline const double claim_level = sidak(0.01, 500);

}  // namespace lancer
