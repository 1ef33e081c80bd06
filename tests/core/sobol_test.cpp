// What makes the points Sobol's: how evenly the samples of one pixel fill the square.
#include <gtest/gtest.h>

#include "core/sampler.h"
#include "support/random.h"

namespace lancer {
namespace {

// Each half-open box of 2^-a x 2^-(k-a) holds exactly one of 2^k points.
bool is_net(const std::vector<Vec2>& points, uint32_t k)
{
    for (uint32_t a = 0; a <= k; ++a) {
        std::vector<bool> taken(points.size());
        for (const Vec2 p : points) {
            const auto x = static_cast<size_t>(p.x * static_cast<float>(1u << a));
            const auto y = static_cast<size_t>(p.y * static_cast<float>(1u << (k - a)));
            const size_t box = x << (k - a) | y;
            if (taken[box]) return false;
            taken[box] = true;
        }
    }
    return true;
}

TEST(Sobol, EveryAlignedBlockOfAPowerOfTwoIsANetInTheFirstTwoDimensions)
{
    Random random(40);
    for (const uint32_t k : {1u, 4u, 6u, 8u})
        for (int i = 0; i < 100; ++i) {
            const uint64_t seed = random.bits(), pixel = random.below(1u << 24);
            const uint32_t bounce = random.below(8), first = (i < 50 ? 0 : random.below(100)) << k;
            const auto dim = static_cast<Dim>(random.below(5));
            std::vector<Vec2> points;
            for (uint32_t s = 0; s < 1u << k; ++s)
                points.push_back(Sampler(SamplerKind::sobol, seed, pixel, first + s, 0).get2(bounce, dim));
            ASSERT_TRUE(is_net(points, k)) << k << " " << i;
        }
}

TEST(Sobol, TheIndependentSamplerIsNoNet)
{
    std::vector<Vec2> points;
    for (uint32_t s = 0; s < 64; ++s)
        points.push_back(Sampler(SamplerKind::independent, 1, 2, s, 0).get2(0, Dim::pixel));
    EXPECT_FALSE(is_net(points, 6));
}

TEST(Sobol, TheThirdDimensionHasOneSampleInEachStratum)
{
    for (const uint32_t k : {1u, 4u, 6u, 8u, 10u})
        for (uint64_t pixel = 0; pixel < 50; ++pixel) {
            const uint32_t first = static_cast<uint32_t>(pixel % 5) << k;
            std::vector<bool> taken(1u << k);
            for (uint32_t s = 0; s < 1u << k; ++s) {
                const float w = Sampler(SamplerKind::sobol, 9, pixel, first + s, 0).get1(3, Dim::bsdf);
                const auto stratum = static_cast<size_t>(w * static_cast<float>(1u << k));
                ASSERT_FALSE(taken[stratum]) << k << " " << pixel;
                taken[stratum] = true;
            }
        }
}

// All three dimensions together: Sobol's construction is a (1, 3)-net, so of every 2^k points a box of volume 2^-(k-1)
// holds exactly two.
TEST(Sobol, ThreeDimensionsAreANetOfQualityOne)
{
    constexpr uint32_t k = 7;
    for (uint64_t pixel = 0; pixel < 20; ++pixel)
        for (uint32_t a = 0; a < k; ++a)
            for (uint32_t b = 0; a + b < k; ++b) {
                const uint32_t c = k - 1 - a - b;
                std::vector<int> count(1u << (k - 1));
                for (uint32_t s = 0; s < 1u << k; ++s) {
                    const Sampler sampler(SamplerKind::sobol, 5, pixel, s, 0);
                    const Vec2 uv = sampler.get2(1, Dim::light);
                    const float w = sampler.get1(1, Dim::light);
                    const auto x = static_cast<size_t>(uv.x * static_cast<float>(1u << a));
                    const auto y = static_cast<size_t>(uv.y * static_cast<float>(1u << b));
                    const auto z = static_cast<size_t>(w * static_cast<float>(1u << c));
                    ++count[(x << b | y) << c | z];
                }
                for (const int n : count) ASSERT_EQ(n, 2) << pixel << " " << a << " " << b;
            }
}

// The point of it: the error of the mean of a smooth function falls faster than 1 / sqrt(n), without bias.
TEST(Sobol, IntegratesASmoothFunctionFarBetterThanIndependentSamples)
{
    constexpr uint32_t n = 256, pixels = 500;
    const auto rmse = [&](SamplerKind kind, double& bias) {
        double sum = 0, sum_sq = 0;
        for (uint32_t p = 0; p < pixels; ++p) {
            double mean = 0;
            for (uint32_t s = 0; s < n; ++s) {
                const Vec2 u = Sampler(kind, 77, p, s, 0).get2(0, Dim::lens);
                mean += static_cast<double>(u.x) * static_cast<double>(u.y) / n;
            }
            const double e = mean - 0.25;
            sum += e, sum_sq += e * e;
        }
        const double r = std::sqrt(sum_sq / pixels);
        bias = sum / pixels / (r / std::sqrt(pixels));
        return r;
    };
    double bias_sobol = 0, bias_independent = 0;
    const double sobol = rmse(SamplerKind::sobol, bias_sobol);
    const double independent = rmse(SamplerKind::independent, bias_independent);
    // Variance of u v is 7 / 144.
    EXPECT_NEAR(independent, std::sqrt(7.0 / 144 / n), 4 * std::sqrt(7.0 / 144 / n) / std::sqrt(2.0 * pixels));
    EXPECT_LT(sobol, independent / 20);
    EXPECT_LT(std::abs(bias_sobol), 4);
    EXPECT_LT(std::abs(bias_independent), 4);
}

}  // namespace
}  // namespace lancer
