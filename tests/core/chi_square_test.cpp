// The test of the test: what the statistical tests of every folder stand on.
#include "support/statistics/chi_square.h"

#include <gtest/gtest.h>

#include "support/random.h"

namespace lancer {
namespace {

TEST(ChiSquare, GammaHasItsClosedForms)
{
    for (const double x : {1e-8, 0.01, 0.5, 1.0, 1.49, 1.51, 3.0, 20.0, 100.0}) {
        EXPECT_NEAR(regularised_gamma_q(0.5, x), std::erfc(std::sqrt(x)), 1e-13 * std::erfc(std::sqrt(x)) + 1e-15) << x;
        EXPECT_NEAR(regularised_gamma_q(1, x), std::exp(-x), 1e-13 * std::exp(-x) + 1e-15) << x;
    }
    for (const int k : {2, 10, 300}) {  // Q(k, x) is the chance of fewer than k events of a Poisson process
        const double x = 0.9 * k;
        double term = std::exp(-x), sum = term;
        for (int i = 1; i < k; ++i) sum += term *= x / i;
        EXPECT_NEAR(regularised_gamma_q(k, x), sum, 1e-12);
    }
}

TEST(ChiSquare, QuantilesOfTheTables)
{
    EXPECT_NEAR(chi_square_survival(18.307038, 10), 0.05, 1e-8);
    EXPECT_NEAR(chi_square_survival(135.806723, 100), 0.01, 1e-8);
    EXPECT_NEAR(chi_square_survival(3.841459, 1), 0.05, 1e-8);
}

TEST(ChiSquare, SmallCellsArePooledAndImpossibleOnesReported)
{
    const ChiSquare r = chi_square_test({10, 0, 2, 1, 7}, {10, 1, 1, 1, 7});
    EXPECT_EQ(r.degrees, 1u);  // 1 + 1 + 1 + 7 make one cell, 10 the other
    EXPECT_DOUBLE_EQ(r.statistic, 0);
    EXPECT_EQ(chi_square_test({10, 1}, {11, 0}).p, 0);
    EXPECT_EQ(chi_square_test({10, 0}, {10, 0}).p, 1);
}

// p-values of true hypotheses are uniform; a bias of one part in fifty is seen.
TEST(ChiSquare, IsCalibratedAndHasPower)
{
    Random random(1);
    std::vector<uint64_t> p_values(10);
    for (int run = 0; run < 2000; ++run) {
        std::vector<uint64_t> counts(20);
        for (int i = 0; i < 1000; ++i) ++counts[random.below(20)];
        ++p_values[std::min<size_t>(9, static_cast<size_t>(10 * chi_square_uniform(counts).p))];
    }
    EXPECT_GT(chi_square_uniform(p_values).p, claim_level);

    std::vector<uint64_t> biased(20);
    for (int i = 0; i < 1000000; ++i) {
        const double u = random.uniform();
        ++biased[static_cast<size_t>(20 * (u + 0.01 * u * (1 - u)))];
    }
    EXPECT_LT(chi_square_uniform(biased).p, 1e-6);
}

TEST(ChiSquare, Sidak)
{
    EXPECT_NEAR(1 - std::pow(1 - sidak(0.01, 300), 300), 0.01, 1e-12);
    EXPECT_DOUBLE_EQ(sidak(0.05, 1), 0.05);
}

}  // namespace
}  // namespace lancer
