// Tier A of the stability matrix with each accelerator that must hold it.
#include <gtest/gtest.h>

#include "stability/results.h"

namespace lancer::stability {
namespace {

struct Case {
    Row row;
    std::string accelerator;
};

std::vector<Case> cases()
{
    std::vector<Case> all;
    for (const Row& row : all_rows()) {
        if (row.tier != Tier::A) continue;
        for (const std::string accelerator : {"embree", "bvh2", "bvh8"})
            if (row.rays || accelerator == "embree") all.push_back({row, accelerator});
    }
    return all;
}

class Matrix : public testing::TestWithParam<Case> {};

TEST_P(Matrix, Holds)
{
    const Result result = run_row(GetParam().row, {Tier::A, GetParam().accelerator}, 1);
    EXPECT_EQ(result.problem, "");
    EXPECT_EQ(result.outcome.dropped, 0u) << "samples that were not finite";
    for (const Measure& m : result.outcome.measures)
        EXPECT_TRUE(m.passes()) << m.what << ": " << m.value << ", may be " << m.threshold;
}

INSTANTIATE_TEST_SUITE_P(Row, Matrix, testing::ValuesIn(cases()),
                         [](const auto& one) { return one.param.row.id + "_" + one.param.accelerator; });
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Matrix);

}  // namespace
}  // namespace lancer::stability
