// The judges themselves, against values from tables and R.
#include "support/statistics/significance.h"

#include <gtest/gtest-spi.h>

#include "support/statistics/kolmogorov.h"

namespace lancer {
namespace {

TEST(Significance, PValuesMatchTables)
{
    EXPECT_NEAR(stats::normal_p(1.959963985), 0.05, 1e-9);
    EXPECT_NEAR(stats::student_p(2.262157163, 9), 0.05, 1e-9);
    EXPECT_NEAR(stats::student_p(63.656741162, 1), 0.01, 1e-9);
    EXPECT_NEAR(stats::student_p(0, 5), 1, 1e-12);
}

TEST(Significance, AFamilyIsRedForOneBadMemberAndForNone)
{
    EXPECT_NONFATAL_FAILURE(
        {
            stats::Family f;
            for (int i = 0; i < 100; ++i) f.add(i == 50 ? 1e-7 : 0.5, std::to_string(i));
        },
        "50, the least of 100");
    EXPECT_NONFATAL_FAILURE({ stats::Family f; }, "nothing was tested");
    stats::Family f;  // 1e-5 alone would be red (claim_level): not among a hundred
    for (int i = 0; i < 100; ++i) f.add(i == 50 ? 1e-5 : 0.5, std::to_string(i));
}

TEST(Significance, WelchAndStudentSeeAShiftOfTheMean)
{
    stats::Tally a, b, c;
    for (int i = 0; i < 64; ++i) {
        a.add(i % 8), b.add((i * 3 + 1) % 8), c.add(i % 8 + 2);
    }
    EXPECT_EQ(stats::welch_p(a, b), 1);
    EXPECT_LT(stats::welch_p(a, c), 1e-4);
    EXPECT_LT(stats::mean_p(a, 5.5), 1e-4);
    EXPECT_EQ(stats::mean_p(a, 3.5), 1);
}

// 1.3581 / sqrt(n) and 1.6276 / sqrt(n) are the bounds for 5 % and 1 % of many numbers; of ten numbers they are 0.40925
// and 0.48893 (Miller, "Table of Percentage Points of Kolmogorov Statistics", JASA 51, 1956).
TEST(Significance, KolmogorovMatchesTables)
{
    const auto shifted = [](size_t n, double largest) {
        std::vector<double> numbers;
        for (size_t i = 0; i < n; ++i)
            numbers.push_back(std::max(0.0, static_cast<double>(i + 1) / static_cast<double>(n) - largest));
        return stats::kolmogorov_p(numbers);
    };
    EXPECT_NEAR(shifted(1000000, 1.35810 / 1000), 0.05, 2e-4);
    EXPECT_NEAR(shifted(1000000, 1.62762 / 1000), 0.01, 1e-4);
    EXPECT_NEAR(shifted(10, 0.40925), 0.05, 2e-3);
    EXPECT_NEAR(shifted(10, 0.48893), 0.01, 1e-3);
    EXPECT_EQ(shifted(10, 0.05), 1);
}

}  // namespace
}  // namespace lancer
