// When are means different, and when is a family of many statistical tests red.
// Formulas: Abramowitz and Stegun, "Handbook of Mathematical Functions", section 26.5.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "support/chi_square.h"
#include "support/salt.h"

namespace lancer::stats {

// Two-sided, of a standard normal variable.
inline double normal_p(double z) { return std::erfc(std::abs(z) * std::sqrt(0.5)); }

// Regularised incomplete beta function, by its continued fraction.
inline double incomplete_beta(double a, double b, double x)
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

// Two-sided, of Student's t.
inline double student_p(double t, double freedom)
{
    return incomplete_beta(freedom / 2, 0.5, freedom / (freedom + t * t));
}

// Mean and variance of numbers as they come (Welford).
struct Tally {
    double n = 0, mean = 0, m2 = 0;

    void add(double x)
    {
        const double d = x - mean;
        mean += d / ++n;
        m2 += d * (x - mean);
    }
    double variance() const { return n > 1 ? m2 / (n - 1) : 0; }
    double error() const { return std::sqrt(variance() / n); }  // of the mean, one sigma
};

// Do two means differ? Welch's test. Without any variance the means must agree to `rounding`.
inline double welch_p(const Tally& a, const Tally& b, double rounding = 1e-6)
{
    const double va = a.variance() / a.n, vb = b.variance() / b.n, d = std::abs(a.mean - b.mean);
    const double floor = rounding * std::max(std::abs(a.mean), std::abs(b.mean));
    if (d <= floor) return 1;
    if (va + vb == 0) return 0;
    const double freedom = (va + vb) * (va + vb) / (va * va / (a.n - 1) + vb * vb / (b.n - 1));
    return student_p((d - floor) / std::sqrt(va + vb), freedom);
}

// Is the mean what it should be? Student's test.
inline double mean_p(const Tally& a, double expected, double rounding = 1e-6)
{
    const double d = std::abs(a.mean - expected), floor = rounding * std::abs(expected);
    if (d <= floor) return 1;
    return a.m2 == 0 ? 0 : student_p((d - floor) / a.error(), a.n - 1);
}

// The tests of one claim. Red if the least p-value of all is what chance gives in a part `alpha` of the runs.
class Family {
public:
    explicit Family(double alpha = claim_level) : alpha_(alpha) {}

    void add(double p, const std::string& what)
    {
        ++count_;
        if (!(p >= least_)) least_ = p, what_ = what;
    }
    ~Family()
    {
        EXPECT_GT(count_, 0u) << "nothing was tested";
        const double threshold = sidak(alpha_, std::max<size_t>(1, count_));
        if (is_salted())
            std::printf("p = %.3g: %s\n", -std::expm1(double(count_) * std::log1p(-least_)), what_.c_str());
        EXPECT_GE(least_, threshold) << what_ << ", the least of " << count_;
    }
    Family(const Family&) = delete;
    Family& operator=(const Family&) = delete;

private:
    double alpha_, least_ = 1;
    size_t count_ = 0;
    std::string what_;
};

}  // namespace lancer::stats
