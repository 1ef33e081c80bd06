// Summary statistics: medians with their range, means of ratios, power laws. Intervals come from the bootstrap with a
// fixed seed, so that the same measurements give the same intervals: Efron, Tibshirani, "An Introduction to the
// Bootstrap", 1993, chapters 9 and 13.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace lancer {

// The median; of an even count the mean of the middle two. values: not empty, no NaN, in any order.
double median(std::vector<double> values);

struct Spread {
    double median = 0, min = 0, max = 0;
};
// values: not empty, no NaN.
Spread spread_of(std::span<const double> values);

// The geometric mean of positive values; NaN if there are none.
double geometric_mean(std::span<const double> values);

struct Interval {
    double low = 0, high = 0;
    bool contains(double x) const { return low <= x && x <= high; }
};

// How far the 95 % interval of a mean reaches to either side of it, in standard errors that are known with so many
// degrees of freedom: Student's t distribution, by the expansion of Abramowitz and Stegun, 26.7.5. degrees >= 1; up to
// 1.5 % too small from 2 on, a tenth at 1.
double student_reach(double degrees);
// The mean of independent values and its 95 % interval. Where few of them decide, as the tail of a distribution does,
// the variance is known worse: Satterthwaite, "An Approximate Distribution of Estimates of Variance Components",
// Biometrics 2, 1946, with the kurtosis of the values. weights: sums to which the values belong, so that the mean is
// sum of values over sum of weights; of the same size, positive, at least two.
Interval mean_interval(std::span<const double> values, std::span<const double> weights);

// A 95 % interval of the median by resampling the values. Not empty.
Interval median_interval(std::span<const double> values, uint64_t seed = 0);

// A 95 % interval of a statistic of `count` items by resampling the items. The statistic gets the `count` indices that
// were drawn, some repeated; it may return infinities but no NaN. count > 0. The same seed draws the same items for
// every statistic.
using ResampledStatistic = std::function<double(std::span<const size_t> drawn)>;
Interval resampled_interval(size_t count, uint64_t seed, const ResampledStatistic& statistic);

// The exponent of y = factor * x^exponent by least squares in logarithms. x, y: positive, of the same size, at least
// two, x not all equal.
double fitted_exponent(std::span<const double> x, std::span<const double> y);

// y = factor * x^exponent.
struct PowerLaw {
    double exponent = 0, factor = 0;
    Interval exponent_interval;  // 95 %, by resampling the residuals
};
// Least squares in logarithms. x, y: positive, of the same size, at least three, x not all equal; else Error (failed).
PowerLaw fit_power_law(std::span<const double> x, std::span<const double> y, uint64_t seed = 0);

}  // namespace lancer
