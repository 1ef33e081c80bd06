#include "report/metrics/noise_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "core/error.h"

namespace lancer {
namespace {

constexpr double rounding = 0x1p-24;

// A grey picture of one truth, each pixel the mean of `samples` samples of 0 or 2 * truth, with the variance that they
// show. truth(x, y).
struct Made {
    Image image;
    std::vector<float> variance;
    double samples = 0;

    operator NoisyPicture() const { return {image, variance, rounding, samples}; }
};

template <class Truth>
Made make(uint64_t seed, int samples, const Truth& truth, double chance = 0.5, int32_t side = 64)
{
    Made made{make_image(side, side), {}, static_cast<double>(samples)};
    std::mt19937_64 random(seed);
    std::binomial_distribution<int> bright(samples, chance);
    for (int32_t y = 0; y < side; ++y)
        for (int32_t x = 0; x < side; ++x) {
            const double height = truth(x, y) / chance, part = bright(random) / made.samples;
            const auto v = static_cast<float>(height * part);
            made.image.at(x, y) = {v, v, v};
            made.variance.push_back(static_cast<float>(height * height * part * (1 - part) / (samples - 1)));
        }
    return made;
}

double unchanged(int32_t, int32_t) { return 1; }

TEST(NoiseTest, HandComputedValues)
{
    Made a{make_image(2, 1), {0.0003f, 0.0001f}, 0}, b{make_image(2, 1), {0.0001f, 0}, 0};
    a.image.at(0, 0) = {1.1f, 1.1f, 1.1f}, b.image.at(0, 0) = {1, 1, 1};     // z = 0.1 / 0.02
    a.image.at(1, 0) = {2, 2, 2}, b.image.at(1, 0) = {2.12f, 2.12f, 2.12f};  // z = -0.12 / 0.01
    const NoiseTest t = test_noise(a, b);
    EXPECT_EQ(t.pixels, 2u);
    EXPECT_NEAR(t.chi_square, 25 + 144, 1e-3);
    EXPECT_EQ(t.beyond_3, 2u);
    EXPECT_EQ(t.beyond_10, 1u);
    EXPECT_NEAR(t.difference, -0.01, 1e-6);
    EXPECT_NEAR(t.reference_mean, 1.56, 1e-6);
    EXPECT_NEAR(t.standard_error, std::sqrt(0.0005) / 2, 1e-7);
    EXPECT_NEAR(t.interval.high, -0.01 + 1.95996 * t.standard_error, 1e-6);
    EXPECT_NEAR(t.detectable, 2.80158 * t.standard_error, 1e-6);
    EXPECT_FALSE(t.means_differ());
    EXPECT_EQ(t.tiles, 1u);
    EXPECT_NEAR(t.largest_tile_z, -0.02 / std::sqrt(0.0005), 1e-3);
    EXPECT_NEAR(t.tile_limit, std::sqrt(2 * std::log(200.0)), 1e-12);
}

// Over many pairs of pictures of one truth: as many false alarms as were promised, and statistics of normal noise.
TEST(NoiseTest, OfOneTruthFindsNothing)
{
    constexpr int pairs = 200;
    int means = 0, tiles = 0;
    double chi_square = 0, pixels = 0, beyond = 0;
    for (uint64_t i = 0; i < pairs; ++i) {
        const NoiseTest t = test_noise(make(2 * i, 64, unchanged), make(2 * i + 1, 64, unchanged));
        means += t.means_differ(), tiles += t.tiles_beyond > 0;
        chi_square += t.chi_square, pixels += static_cast<double>(t.pixels), beyond += static_cast<double>(t.beyond_3);
    }
    // Binomial with 200 and 0.05: 10 +- 3.1, four sigma.
    EXPECT_GE(means, 1);
    EXPECT_LE(means, 22);
    EXPECT_LE(tiles, 7);  // with 0.01 at most: 2 +- 1.4
    EXPECT_NEAR(chi_square / pixels, 1, 0.05);
    EXPECT_NEAR(beyond / pixels, 0.0027, 0.0027);
}

// The smallest detectable bias is found in 80 of 100 tries, twice as large a one nearly always, half of it seldom.
TEST(NoiseTest, FindsTheBiasThatItSaysItFinds)
{
    constexpr int pairs = 200;
    const double detectable = test_noise(make(1, 64, unchanged), make(2, 64, unchanged)).detectable;
    const auto found = [&](double bias) {
        int count = 0;
        for (uint64_t i = 0; i < pairs; ++i) {
            const auto brighter = [&](int32_t, int32_t) { return 1 + bias; };
            count += test_noise(make(2 * i, 64, brighter), make(2 * i + 1, 64, unchanged)).means_differ();
        }
        return count;
    };
    EXPECT_NEAR(found(detectable), 160, 4 * std::sqrt(pairs * 0.8 * 0.2));
    EXPECT_GE(found(2 * detectable), 198);
    EXPECT_LE(found(detectable / 2), 100);
}

// Light that was moved: the mean does not see it.
TEST(NoiseTest, FindsADifferenceInOnePlace)
{
    const auto moved = [](int32_t x, int32_t y) {
        if (x / 8 == 3 && y / 8 == 5) return 1.5;
        return x / 8 == 6 && y / 8 == 5 ? 0.5 : 1.0;
    };
    const NoiseTest t = test_noise(make(1, 64, moved), make(2, 64, unchanged));
    EXPECT_FALSE(t.means_differ());
    EXPECT_EQ(t.tiles, 64u);
    EXPECT_EQ(t.tiles_beyond, 2u);
    EXPECT_TRUE(t.tile_x == 24 || t.tile_x == 48) << t.tile_x;
    EXPECT_EQ(t.tile_y, 40);
    EXPECT_GT(t.tile_detectable, 0.01);
    EXPECT_LT(t.tile_detectable, 0.5);
}

// One sample in 2000 is bright: of 8 samples most tiles met none, and show no noise at all; 800 know better.
TEST(NoiseTest, FewSamplesAreNotSureOfWhatIsRare)
{
    const Made few = make(1, 8, unchanged, 1.0 / 2000), many = make(2, 800, unchanged, 1.0 / 2000);
    EXPECT_EQ(test_noise(few, many).tiles_beyond, 0u);
    EXPECT_EQ(test_noise(many, few).tiles_beyond, 0u);
    NoisyPicture untold = few;
    untold.samples = 0;
    EXPECT_GT(test_noise(untold, many).tiles_beyond, 0u) << "the case is too easy";
}

TEST(NoiseTest, RoundingIsNoDifferenceAndWithoutNoiseAllElseIs)
{
    Made a{make_image(16, 16), std::vector<float>(256), 4};
    for (Color& c : a.image.pixels) c = {0.3f, 0.3f, 0.3f};
    Made b = a;
    for (Color& c : b.image.pixels) c.g = std::nextafter(c.g, 0.0f);
    NoiseTest t = test_noise(a, b);
    EXPECT_EQ(t.pixels, 0u);
    EXPECT_EQ(t.tiles, 0u);
    EXPECT_EQ(t.quiet, 256u);
    EXPECT_GT(t.quiet_difference, 0);
    b = a;
    b.image.at(3, 3).r += 0.01f;
    t = test_noise(a, b);
    EXPECT_EQ(t.quiet_differing, 1u);
    EXPECT_NEAR(t.quiet_difference, 0.002126, 1e-6);
}

TEST(NoiseTest, LeavesOutWhatIsNotFinite)
{
    Made a = make(1, 64, unchanged), b = make(2, 64, unchanged);
    a.image.at(0, 0).g = std::numeric_limits<float>::infinity();
    b.variance[1] = std::nanf("");
    const NoiseTest t = test_noise(a, b);
    EXPECT_EQ(t.left_out, 2u);
    EXPECT_TRUE(std::isfinite(t.standard_error));
    EXPECT_TRUE(std::isfinite(t.largest_tile_z));
    b.variance.pop_back();
    EXPECT_THROW(test_noise(a, b), Error);
    EXPECT_THROW(test_noise(a, make(1, 4, unchanged, 0.5, 32)), Error);
}

}  // namespace
}  // namespace lancer
