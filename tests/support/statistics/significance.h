// When are means different, and when is a family of many statistical tests red.
// Formulas: Abramowitz and Stegun, "Handbook of Mathematical Functions", section 26.5.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "support/salt.h"
#include "support/statistics/chi_square.h"

namespace lancer::stats {

// Two-sided, of a standard normal variable.
inline double normal_p(double z) { return std::erfc(std::abs(z) * std::sqrt(0.5)); }

// Regularised incomplete beta function, by its continued fraction.
double incomplete_beta(double a, double b, double x);

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
double welch_p(const Tally& a, const Tally& b, double rounding = 1e-6);

// Is the mean what it should be? Student's test.
double mean_p(const Tally& a, double expected, double rounding = 1e-6);

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
