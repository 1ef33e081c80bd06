// What benches and studies say of many measurements.
#include "report/metrics/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "support/random.h"

namespace lancer {
namespace {

TEST(Statistics, MedianIsTheMiddleWhateverTheOrder)
{
    EXPECT_EQ(median({3}), 3);
    EXPECT_EQ(median({5, 1, 3}), 3);
    EXPECT_EQ(median({8, 1, 4, 2}), 3);
}

TEST(Statistics, SpreadHoldsBothEnds)
{
    const std::vector<double> values{4, 9, 1, 7, 2};
    const Spread s = spread_of(values);
    EXPECT_EQ(s.median, 4);
    EXPECT_EQ(s.min, 1);
    EXPECT_EQ(s.max, 9);
}

TEST(Statistics, GeometricMeanTreatsARatioAndItsInverseAlike)
{
    const std::vector<double> values{4, 0.25}, inverse{0.25, 4}, others{1, 10, 100};
    EXPECT_NEAR(geometric_mean(values), 1, 1e-15);
    EXPECT_NEAR(geometric_mean(inverse), 1, 1e-15);
    EXPECT_NEAR(geometric_mean(others), 10, 1e-13);
}

TEST(Statistics, ReachOfAMeanIsThatOfStudentsTable)
{
    // Abramowitz and Stegun, table 26.10.
    EXPECT_NEAR(student_reach(2), 4.303, 0.05);
    EXPECT_NEAR(student_reach(4), 2.776, 0.002);
    EXPECT_NEAR(student_reach(10), 2.228, 0.001);
    EXPECT_NEAR(student_reach(120), 1.980, 0.001);
}

// Means of 24 values of an exponential distribution: the intervals of a normal one hold 91 % of them.
TEST(Statistics, IntervalOfAMeanIsWiderWhereFewValuesDecide)
{
    Random random(1);
    constexpr int sets = 20000;
    const std::vector<double> weights(24, 2), equal(24, 6);
    int held = 0;
    for (int set = 0; set < sets; ++set) {
        std::vector<double> values;
        for (const double w : weights) values.push_back(-w * std::log1p(-random.uniform(0, 1)));
        held += mean_interval(values, weights).contains(1);
    }
    EXPECT_GE(held, 0.919 * sets);
    EXPECT_LE(held, 0.95 * sets);
    EXPECT_EQ(mean_interval(equal, weights).low, 3);
    EXPECT_EQ(mean_interval(equal, weights).high, 3);
}

TEST(Statistics, IntervalOfTheMedianIsAPointForEqualValues)
{
    const std::vector<double> values(7, 2.5);
    const Interval i = median_interval(values);
    EXPECT_EQ(i.low, 2.5);
    EXPECT_EQ(i.high, 2.5);
}

// Of 300 samples of 25, the interval holds the true median in about 95 %: six standard deviations are 0.075.
TEST(Statistics, IntervalOfTheMedianHoldsTheTruthAsOftenAsItSays)
{
    Random random(11);
    int holds = 0;
    for (int k = 0; k < 300; ++k) {
        std::vector<double> values;
        for (int i = 0; i < 25; ++i) values.push_back(random.uniform(0, 1));
        holds += median_interval(values, static_cast<uint64_t>(k)).contains(0.5);
    }
    EXPECT_NEAR(holds / 300.0, 0.95, 0.075);
}

TEST(Statistics, PowerLawThatIsOneIsFoundExactly)
{
    const std::vector<double> x{1e3, 1e4, 1e5, 1e6, 1e7};
    for (const double exponent : {-0.2, 0.0, 1.0, 2.5}) {
        std::vector<double> y;
        for (const double v : x) y.push_back(3 * std::pow(v, exponent));
        const PowerLaw law = fit_power_law(x, y);
        EXPECT_NEAR(law.exponent, exponent, 1e-12);
        EXPECT_NEAR(law.factor, 3, 1e-10);
        EXPECT_NEAR(law.exponent_interval.low, exponent, 1e-12);
        EXPECT_NEAR(law.exponent_interval.high, exponent, 1e-12);
    }
}

// The percentile bootstrap is a little narrow with 9 points: 0.9 rather than 0.95.
TEST(Statistics, IntervalOfAnExponentHoldsTheTruthMostly)
{
    Random random(12);
    int holds = 0;
    for (int k = 0; k < 300; ++k) {
        std::vector<double> x, y;
        for (int i = 0; i < 9; ++i) {
            x.push_back(std::pow(10, 3 + 0.5 * i));
            y.push_back(std::pow(x.back(), -0.15) * std::exp(random.uniform(-0.2, 0.2)));
        }
        holds += fit_power_law(x, y, static_cast<uint64_t>(k)).exponent_interval.contains(-0.15);
    }
    EXPECT_NEAR(holds / 300.0, 0.92, 0.08);
}

TEST(Statistics, PowerLawRefusesWhatHasNone)
{
    const std::vector<double> x{1, 2, 3}, same{2, 2, 2}, with_zero{1, 0, 2}, two{1, 2};
    EXPECT_THROW(fit_power_law(same, x), Error);
    EXPECT_THROW(fit_power_law(x, with_zero), Error);
    EXPECT_THROW(fit_power_law(two, two), Error);
    EXPECT_THROW(fit_power_law(x, two), Error);
}

}  // namespace
}  // namespace lancer
