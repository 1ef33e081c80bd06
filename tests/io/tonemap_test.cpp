#include "io/image/tonemap.h"

#include <gtest/gtest.h>

#include <limits>

#include "io/image/png.h"
#include "io/temp_folder.h"

namespace lancer {
namespace {

double grey(double x) { return to_display(ToneMap::agx, {x, x, x})[1]; }

TEST(ToneMap, AgxKeepsGreysGreyAndTheirOrder)
{
    // To a fifteenth of a step: the rows of the published matrices do not quite add up to 1.
    double before = grey(0);
    EXPECT_NEAR(before, 0, 0.005);
    for (double stops = -12; stops <= 4; stops += 0.25) {
        const double x = std::exp2(stops);
        const auto [r, g, b] = to_display(ToneMap::agx, {x, x, x});
        EXPECT_NEAR(r, g, 2.5e-4) << stops;
        EXPECT_NEAR(b, g, 2.5e-4) << stops;
        EXPECT_GE(g, before) << stops;
        before = g;
    }
    // AgX puts middle grey at the pivot of its sigmoid, half of the code values, and there is room far above 1.
    EXPECT_NEAR(grey(0.18), 0.5, 0.01);
    EXPECT_LT(grey(1), 0.85);
    EXPECT_GT(grey(16), 0.98);
}

TEST(ToneMap, AgxTakesTheSaturationOfBrightColours)
{
    const auto spread = [](double brightness) {
        const auto c = to_display(ToneMap::agx, {brightness, 0.1 * brightness, 0.1 * brightness});
        return c[0] - c[1];
    };
    EXPECT_GT(spread(0.5), 2 * spread(16));
    const auto srgb = to_display(ToneMap::srgb, {16, 1.6, 1.6});
    EXPECT_EQ(srgb[0], srgb[1]) << "cut off";
}

TEST(ToneMap, WhatIsNoNumberIsBlack)
{
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    for (const ToneMap map : {ToneMap::srgb, ToneMap::agx, ToneMap::none, ToneMap::gamma22, ToneMap::clamped}) {
        for (const double x : to_display(map, {nan, -1, -infinity})) EXPECT_LT(x, 0.005);
        for (const double x : to_display(map, {infinity, infinity, infinity})) EXPECT_GT(x, 0.98);
    }
}

TEST(ToneMap, DecidesTheStepsOfAPng)
{
    const TempFolder folder;
    Image image = make_image(1, 1);
    image.at(0, 0) = {0.25f, 0.5f, 2};
    const auto step = [&](ToneMap map) {
        write_png(folder.file("a.png"), image, {}, {.tonemap = map});
        const Color c = read_png(folder.file("a.png"), Encoding::linear).at(0, 0);
        return std::array{std::lround(c.r * 255), std::lround(c.g * 255), std::lround(c.b * 255)};
    };
    EXPECT_EQ(step(ToneMap::none), (std::array{64l, 128l, 255l}));
    EXPECT_EQ(step(ToneMap::srgb), (std::array{137l, 188l, 255l}));
    EXPECT_LT(step(ToneMap::agx)[2], 255);
    // 0.25^(1/2.2) is 135.8 steps and 0.5^(1/2.2) 186.1; without a curve 63.75 and 127.5.
    EXPECT_EQ(step(ToneMap::gamma22), (std::array{135l, 186l, 255l}));
    EXPECT_EQ(step(ToneMap::clamped), (std::array{63l, 127l, 255l}));
}

// The student's program took the power of a radiance that was 255^2.2 times as large, and cut the fraction off.
TEST(ToneMap, Gamma22IsThePowerOfTheProgram)
{
    for (double x = 1e-4; x < 2; x *= 1.37) {
        const double theirs = std::min(255.0, std::pow(x * std::pow(255, 2.2), 1 / 2.2));
        EXPECT_NEAR(255 * to_display(ToneMap::gamma22, {x, 0, 0})[0], theirs, 1e-9);
    }
}

TEST(ToneMap, DitherTakesTheMeanOfARoundingDownToTheTruth)
{
    Image image = make_image(64, 64);
    for (Color& c : image.pixels) c = {0.3f, 0.3f, 0.3f};  // 76.5 steps
    const auto mean = [&](bool dither) {
        double sum = 0;
        for (const uint8_t b : to_bytes(image, {.dither = dither, .tonemap = ToneMap::clamped})) sum += b;
        return sum / (3 * 64 * 64);
    };
    EXPECT_EQ(mean(false), 76);
    EXPECT_NEAR(mean(true), 76.5, 0.03);
}

}  // namespace
}  // namespace lancer
