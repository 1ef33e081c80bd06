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
double regularised_gamma_q(double a, double x);

// Probability that a chi-square variable of that many degrees of freedom is at least x.
inline double chi_square_survival(double x, double degrees) { return regularised_gamma_q(degrees / 2, x / 2); }

struct ChiSquare {
    double statistic = 0;
    uint64_t degrees = 0;
    double p = 0;  // of a statistic at least so large, if the expectation is true
};

// Cells that expect fewer than 5 are pooled, smallest first; one in which nothing can be but something is, gives p = 0.
// Both sums must agree, as they do when every sample is in some cell.
ChiSquare chi_square_test(const std::vector<uint64_t>& observed, const std::vector<double>& expected);

// All cells expect the same.
ChiSquare chi_square_uniform(const std::vector<uint64_t>& observed);

// Level of each of n independent tests, so that all together fail by chance with probability alpha.
inline double sidak(double alpha, size_t n) { return -std::expm1(std::log1p(-alpha) / static_cast<double>(n)); }

// The level of one claim. All tests together make about 500: so that with other random numbers one is red by chance in
// one of a hundred runs, and not in every run.
inline const double claim_level = sidak(0.01, 500);

}  // namespace lancer
