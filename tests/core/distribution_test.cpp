#include "core/distribution.h"

#include <gtest/gtest.h>

#include "support/random.h"
#include "support/statistics/chi_square.h"

namespace lancer {
namespace {

TEST(Discrete, DrawsInProportionToTheWeights)
{
    const std::vector<double> weights{3, 0, 1, 0.5, 10, 0, 0, 1e-3, 7, 0};
    const Discrete d(weights);
    ASSERT_EQ(d.size(), weights.size());
    constexpr int n = 1000000;
    std::vector<uint64_t> observed(weights.size());
    std::vector<double> expected;
    Random random(50);
    for (int i = 0; i < n; ++i) ++observed[d.sample(random.unit())];
    for (uint32_t i = 0; i < weights.size(); ++i) {
        expected.push_back(n * weights[i] / 21.501);
        EXPECT_FLOAT_EQ(d.probability(i), static_cast<float>(weights[i] / 21.501));
        EXPECT_EQ(observed[i] == 0, weights[i] == 0) << i;
    }
    EXPECT_GT(chi_square_test(observed, expected).p, claim_level);
}

// Index and rest together are as even as the number was.
TEST(Discrete, StretchesEachPartOverAll)
{
    const std::vector<double> weights{3, 0, 1, 2};
    const Discrete d(weights);
    ASSERT_TRUE(d.can_remap());
    constexpr uint32_t n = 600000, bins = 10;
    std::vector<uint64_t> observed(weights.size() * bins);
    for (uint32_t i = 0; i < n; ++i) {
        const Discrete::Remapped s = d.sample_remapped((static_cast<float>(i) + 0.5f) / n);
        ASSERT_GE(s.u, 0);
        ASSERT_LT(s.u, 1);
        ++observed[s.index * bins + static_cast<uint32_t>(s.u * bins)];
    }
    for (size_t i = 0; i < observed.size(); ++i)
        EXPECT_NEAR(static_cast<double>(observed[i]), n * weights[i / bins] / 6 / bins, 2) << i;
    EXPECT_FALSE(Discrete({1, 1e-3}).can_remap()) << "a small part has too few digits";
    EXPECT_FALSE(Discrete(std::vector<double>(33, 1)).can_remap());
    EXPECT_FALSE(Discrete().can_remap());
}

TEST(Discrete, DrawsAmongTheLastInProportionToTheirWeights)
{
    const std::vector<double> weights{3, 1000, 1, 0, 10, 0.5, 0};
    const Discrete d(weights);
    for (uint32_t first = 0; first < 6; ++first) {
        double rest = 0;
        for (uint32_t i = first; i < weights.size(); ++i) rest += weights[i];
        constexpr int n = 100000;
        std::vector<uint64_t> observed(weights.size());
        std::vector<double> expected;
        Random random(53 + first);
        for (int i = 0; i < n; ++i) {
            const Discrete::Choice c = d.sample_from(first, random.unit());
            ++observed[c.index];
            EXPECT_NEAR(c.probability, weights[c.index] / rest, 1e-6);
        }
        for (uint32_t i = 0; i < weights.size(); ++i) {
            expected.push_back(i < first ? 0 : n * weights[i] / rest);
            EXPECT_EQ(observed[i] == 0, expected[i] == 0) << i << " from " << first;
        }
        EXPECT_GT(chi_square_test(observed, expected).p, claim_level) << first;
    }
    EXPECT_EQ(d.sample_from(6, 0.5).probability, 0) << "these weigh nothing";
}

TEST(Discrete, NeverDrawsAnIndexWithoutWeightAtEitherEnd)
{
    constexpr float last = 1 - 0x1p-24f;
    const Discrete d({0, 0, 0.1, 0, 0.7, 0, 0});
    EXPECT_EQ(d.sample(0), 2u);
    EXPECT_EQ(d.sample(last), 4u);
    const Discrete one({0, 1e-300, 0});
    for (const float u : {0.0f, 0.5f, last}) EXPECT_EQ(one.sample(u), 1u);
    Random random(51);
    for (int i = 0; i < 1000; ++i) {
        std::vector<double> w(1 + random.below(20));
        for (double& x : w) x = random.below(2) ? std::pow(10.0, random.uniform(-18, 18)) : 0;
        const Discrete r(w);
        if (r.empty()) continue;
        for (const float u : {0.0f, 0x1p-24f, random.unit(), random.unit(), last}) ASSERT_GT(w[r.sample(u)], 0);
    }
}

TEST(Discrete, WithoutWeightIsEmpty)
{
    EXPECT_TRUE(Discrete().empty());
    EXPECT_TRUE(Discrete(std::vector<double>{}).empty());
    EXPECT_TRUE(Discrete({0, 0, 0}).empty());
    EXPECT_FALSE(Discrete({0, 1e-300}).empty());
}

// A sum in float stalls at 2^24 and would leave the upper half without a chance.
TEST(Discrete, TheSumOf2To25EqualWeightsIsExact)
{
    constexpr uint32_t n = 1u << 25;
    const Discrete d(std::vector<double>(n, 0.1f));
    for (const uint32_t i : {0u, 1u, n / 2, n - 1}) EXPECT_EQ(d.probability(i), 0x1p-25f);
    EXPECT_EQ(d.sample(0), 0u);
    EXPECT_EQ(d.sample(0.5f), n / 2);
    EXPECT_EQ(d.sample(0.75f), n / 4 * 3);
    EXPECT_EQ(d.sample(1 - 0x1p-24f), n - 2);
}

// A thousand beside what is 10^17 times as heavy: each has the least part that a double can tell, and is in it.
TEST(Discrete, WhatWeighsSomethingIsNotSwallowed)
{
    std::vector<double> weights(1001, 1e-7);
    weights[0] = 1e10;
    const Discrete d(weights);
    std::vector<uint64_t> observed(1001);
    for (int i = 1; i < 4000; ++i) ++observed[d.sample(1 - i * 0x1p-53)];
    for (uint32_t i = 1; i <= 1000; ++i) {
        ASSERT_GT(d.probability(i), 0) << i;
        ASSERT_GT(observed[i], 0u) << i;
    }
}

// A thousand indices that share a millionth: the 17 numbers of 24 bits that lead to them choose all of them alike.
TEST(Discrete, LengthenedNumbersReachWhatIsRare)
{
    std::vector<double> weights(1001, 1e-9);
    weights[0] = 1;
    const Discrete d(weights);
    std::vector<uint64_t> observed(1001);
    Random random(52);
    for (int i = 0; i < 200000; ++i) {
        const float u = 1 - static_cast<float>(1 + random.below(20)) * 0x1p-24f;
        const double longer = extend_precision(u, random.unit());
        ASSERT_GE(longer, static_cast<double>(u));
        ASSERT_LT(longer, static_cast<double>(u) + 0x1p-24);
        ++observed[d.sample(longer)];
    }
    observed.erase(observed.begin());
    EXPECT_GT(chi_square_uniform(observed).p, claim_level);
}

// All 29 bits of them.
TEST(Discrete, LengthenedByTwoNumbersIsUniformToItsLastBit)
{
    std::vector<uint64_t> first(256), last(256);
    Random random(54);
    for (int i = 0; i < 400000; ++i) {
        const float u = random.unit();
        const double below = (extend_precision(u, random.unit2()) - static_cast<double>(u)) * 0x1p53;
        ASSERT_LT(below, 0x1p29);
        ASSERT_EQ(below, std::floor(below));
        ++first[static_cast<size_t>(below) >> 21], ++last[static_cast<size_t>(below) & 255];
    }
    EXPECT_GT(chi_square_uniform(first).p, claim_level);
    EXPECT_GT(chi_square_uniform(last).p, claim_level);
}

// By the first of two numbers and by both: lengthening keeps a pair of them uniform in the square.
TEST(Discrete, LengthenedPairsAreUniform)
{
    std::vector<uint64_t> fine(256), joint(1024);
    Random random(53);
    for (int i = 0; i < 400000; ++i) {
        const Vec2 u = random.unit2();
        const double below = (extend_precision(u.x, u.y) - static_cast<double>(u.x)) * 0x1p24;
        ++fine[static_cast<size_t>(below * 256)];
        ++joint[static_cast<size_t>(below * 32) * 32 + static_cast<size_t>(u.y * 32)];
    }
    EXPECT_GT(chi_square_uniform(fine).p, claim_level);
    EXPECT_GT(chi_square_uniform(joint).p, claim_level);
}

}  // namespace
}  // namespace lancer
