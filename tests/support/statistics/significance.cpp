#include "support/statistics/significance.h"

namespace lancer::stats {

double incomplete_beta(double a, double b, double x)
{
    if (x <= 0) return 0;
    if (x >= 1) return 1;
    if (x > (a + 1) / (a + b + 2)) return 1 - incomplete_beta(b, a, 1 - x);
    const double front =
        std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x)) / a;
    double c = 1, d = 1 / (1 - (a + b) * x / (a + 1)), h = d;
    for (int i = 1; i < 10000; ++i) {
        const double even = i * (b - i) * x / ((a + 2 * i - 1) * (a + 2 * i));
        d = 1 / (1 + even * d), c = 1 + even / c, h *= d * c;
        const double odd = -(a + i) * (a + b + i) * x / ((a + 2 * i) * (a + 2 * i + 1));
        d = 1 / (1 + odd * d), c = 1 + odd / c, h *= d * c;
        if (std::abs(d * c - 1) < 1e-15) break;
    }
    return front * h;
}

double welch_p(const Tally& a, const Tally& b, double rounding)
{
    const double va = a.variance() / a.n, vb = b.variance() / b.n, d = std::abs(a.mean - b.mean);
    const double floor = rounding * std::max(std::abs(a.mean), std::abs(b.mean));
    if (d <= floor) return 1;
    if (va + vb == 0) return 0;
    const double freedom = (va + vb) * (va + vb) / (va * va / (a.n - 1) + vb * vb / (b.n - 1));
    return student_p((d - floor) / std::sqrt(va + vb), freedom);
}

double mean_p(const Tally& a, double expected, double rounding)
{
    const double d = std::abs(a.mean - expected), floor = rounding * std::abs(expected);
    if (d <= floor) return 1;
    return a.m2 == 0 ? 0 : student_p((d - floor) / a.error(), a.n - 1);
}

}  // namespace lancer::stats
