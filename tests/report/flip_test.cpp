// FLIP by its laws and closed forms. tests/app/compare_test.cpp has values of NVIDIA's tool.
#include "report/metrics/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.h"
#include "core/parallel.h"
#include "report/metrics/flip_color.h"

namespace lancer {
namespace {

Image constant(Color c, int32_t width = 24, int32_t height = 16)
{
    Image image = make_image(width, height);
    for (Color& p : image.pixels) p = c;
    return image;
}

// Colours of [0, scale), the same for the same seed.
Image noise(uint32_t seed, float scale = 1, int32_t width = 40, int32_t height = 30)
{
    Image image = make_image(width, height);
    const auto next = [&] {
        return scale * static_cast<float>((seed = seed * 1664525u + 1013904223u) >> 8) * 0x1p-24f;
    };
    for (Color& p : image.pixels) p = {next(), next(), next()};
    return image;
}

TEST(Flip, OfAPictureWithItselfIsNothing)
{
    for (const Flip& flip : {flip_ldr(noise(1), noise(1)), flip_hdr(noise(1, 50), noise(1, 50))}) {
        EXPECT_EQ(flip.max, 0);
        EXPECT_EQ(flip.mean, 0);
        EXPECT_EQ(flip.weighted_median, 0);
    }
}

TEST(Flip, LiesBetweenNothingAndOneAndIsSymmetricForAScreen)
{
    const Image a = noise(1), b = noise(2);
    const Flip ab = flip_ldr(a, b), ba = flip_ldr(b, a);
    EXPECT_EQ(ab.error, ba.error);
    EXPECT_GT(ab.min, 0);
    EXPECT_LE(ab.max, 1);
    EXPECT_LT(ab.min, ab.mean);
    EXPECT_LT(ab.mean, ab.max);
    EXPECT_EQ(ab.error.size(), a.pixels.size());
    const Flip hdr = flip_hdr(noise(3, 100), noise(4, 100));
    EXPECT_GT(hdr.min, 0);
    EXPECT_LE(hdr.max, 1);
}

// Pictures of one colour each have no features and nothing to blur. The distance of green and blue is the largest that
// there is, by definition; that of black and white is 100 in lightness.
TEST(Flip, OfConstantPicturesIsTheDistanceOfTheirColours)
{
    const Flip largest = flip_ldr(constant({0, 1, 0}), constant({0, 0, 1}));
    EXPECT_NEAR(largest.min, 1, 1e-6);
    EXPECT_NEAR(largest.max, 1, 1e-6);
    // CIELAB of green and blue from Lindbloom's tables of sRGB: (87.735, -86.183, 83.180), (32.301, 79.190, -107.863).
    const double distance =
        87.735 - 32.301 + std::hypot(0.87735 * -86.183 - 0.32301 * 79.190, 0.87735 * 83.180 - 0.32301 * -107.863);
    const double part = std::pow(100 / distance, 0.7);
    ASSERT_GT(part, 0.4);
    const Flip white = flip_ldr(constant({1, 1, 1}), constant({0, 0, 0}));
    EXPECT_NEAR(white.mean, 0.95 + 0.05 * (part - 0.4) / 0.6, 1e-4);
    EXPECT_NEAR(white.weighted_median, white.mean, 1e-6);
    // Below the knee: half of the light of white has this lightness.
    const double y = 0.5, lightness = 116 * std::cbrt(y) - 16;
    const double grey = std::pow((100 - lightness) / distance, 0.7);
    ASSERT_LT(grey, 0.4);
    EXPECT_NEAR(flip_ldr(constant({0.5f, 0.5f, 0.5f}), constant({1, 1, 1})).mean, grey * 0.95 / 0.4, 1e-4);
}

TEST(Flip, CutsOffWhatAScreenCannotShow)
{
    EXPECT_EQ(flip_ldr(constant({7, -3, 0.5f}), constant({1, 0, 0.5f})).max, 0);
}

// A line, one pixel wide, is a feature: it counts for more than its blurred colour does.
TEST(Flip, SeesAnEdgeWhereItIs)
{
    Image line = constant({0, 0, 0}, 60, 60);
    for (int32_t y = 0; y < 60; ++y) line.at(30, y) = {1, 1, 1};
    const Flip flip = flip_ldr(line, constant({0, 0, 0}, 60, 60));
    const auto at = [&](size_t x, size_t y) { return flip.error[y * 60 + x]; };
    EXPECT_EQ(at(5, 30), 0);  // farther than either filter reaches
    EXPECT_GT(at(30, 30), 0.3f);
    EXPECT_GT(at(30, 30), at(34, 30));
    EXPECT_FLOAT_EQ(at(28, 30), at(32, 30));
    EXPECT_FLOAT_EQ(at(30, 3), at(30, 57));
    // The border goes on as it is: a line through it looks the same there.
    EXPECT_FLOAT_EQ(at(30, 0), at(30, 30));
}

TEST(Flip, ExposuresFollowTheReference)
{
    // The larger root of what 0.85 = ACES(x) comes to.
    const double p = 0.36 * (2.51 - 0.85 * 2.43), q = 0.6 * (0.03 - 0.85 * 0.59), r = -0.85 * 0.14;
    const double white = (-q + std::sqrt(q * q - 4 * p * r)) / (2 * p);
    std::vector<Color> pixels(11, Color{0.25f, 0.25f, 0.25f});
    pixels[7] = {64, 64, 64};
    const FlipExposures e = flip_exposures(pixels);
    EXPECT_NEAR(e.start, std::log2(white / 64), 1e-6);
    EXPECT_NEAR(e.stop, std::log2(white / 0.25), 1e-6);
    EXPECT_EQ(e.count, 8);
    // Mostly black: the median of what is not.
    std::vector<Color> dark(20);
    dark[3] = {4, 4, 4}, dark[4] = {2, 2, 2}, dark[5] = {1, 1, 1};
    EXPECT_NEAR(flip_exposures(dark).stop, std::log2(white / 2), 1e-6);
    EXPECT_EQ(flip_exposures(dark).count, 2);
    EXPECT_EQ(flip_exposures(std::vector<Color>(4)).start, 0);
}

// A difference in the dark that no screen shows beside the bright half, but an exposure for the dark does.
TEST(Flip, HdrLooksIntoTheDark)
{
    Image reference = constant({100, 100, 100});
    for (int32_t y = 0; y < 16; ++y)
        for (int32_t x = 0; x < 16; ++x) reference.at(x, y) = {1e-4f, 1e-4f, 1e-4f};
    Image test = reference;
    for (int32_t y = 0; y < 16; ++y) test.at(0, y) = {2e-4f, 2e-4f, 2e-4f};
    EXPECT_LT(flip_ldr(test, reference).max, 0.02);
    EXPECT_GT(flip_hdr(test, reference).max, 0.15);
    // Brightening both by the same power of two changes nothing.
    Image test8 = test, reference8 = reference;
    for (Image* image : {&test8, &reference8})
        for (Color& c : image->pixels) c *= 8;
    EXPECT_NEAR(flip_hdr(test8, reference8).mean, flip_hdr(test, reference).mean, 1e-7);
}

TEST(Flip, APixelThatIsNotFiniteIsWrongAndSpoilsNoOther)
{
    Image a = constant({0.5f, 0.5f, 0.5f}, 60, 40);
    const Image b = a;
    a.at(20, 20).g = std::numeric_limits<float>::quiet_NaN();
    for (const Flip& flip : {flip_ldr(a, b), flip_hdr(a, b)}) {
        EXPECT_EQ(flip.error[20 * 60 + 20], 1);
        EXPECT_EQ(flip.error[20 * 60 + 50], 0);
        EXPECT_TRUE(std::isfinite(flip.mean));
    }
    Image endless = b;
    endless.at(3, 3) = {std::numeric_limits<float>::infinity(), 0, 0};
    EXPECT_EQ(flip_hdr(endless, endless).error[3 * 60 + 3], 1);
}

TEST(Flip, WorksOnPicturesSmallerThanItsFilters)
{
    EXPECT_NEAR(flip_ldr(constant({0, 1, 0}, 1, 1), constant({0, 0, 1}, 1, 1)).mean, 1, 1e-6);
    EXPECT_EQ(flip_hdr(constant({0, 0, 0}, 3, 1), constant({0, 0, 0}, 3, 1)).mean, 0);
    EXPECT_THROW(flip_ldr(make_image(2, 3), make_image(3, 2)), Error);
    EXPECT_THROW(flip_hdr(make_image(2, 3), make_image(3, 2)), Error);
}

TEST(Flip, SameBitsForAnyNumberOfThreads)
{
    std::vector<float> one, five;
    with_threads(1, [&] { one = flip_hdr(noise(5, 9), noise(6, 9)).error; });
    with_threads(5, [&] { five = flip_hdr(noise(5, 9), noise(6, 9)).error; });
    EXPECT_EQ(one, five);
}

TEST(FlipColor, MatricesAreThoseOfSrgb)
{
    // IEC 61966-2-1, to its four digits.
    const flip::Matrix standard{{{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}};
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j) EXPECT_NEAR(flip::xyz_from_rgb[i][j], standard[i][j], 6e-5);
    const flip::Triple there = flip::opponent_from_rgb({0.2, 0.7, 0.1}), back = flip::rgb_from_opponent(there);
    EXPECT_NEAR(back[0], 0.2, 1e-12);
    EXPECT_NEAR(back[1], 0.7, 1e-12);
    EXPECT_NEAR(back[2], 0.1, 1e-12);
    const flip::Triple grey = flip::opponent_from_rgb({0.5, 0.5, 0.5});
    EXPECT_NEAR(grey[0], 42, 1e-12);
    EXPECT_NEAR(std::hypot(grey[1], grey[2]), 0, 1e-12);
}

}  // namespace
}  // namespace lancer
