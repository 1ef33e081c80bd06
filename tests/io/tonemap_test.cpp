#include "io/tonemap.h"

#include <gtest/gtest.h>

#include <limits>

#include "io/png.h"
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
    for (const ToneMap map : {ToneMap::srgb, ToneMap::agx, ToneMap::none}) {
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
}

}  // namespace
}  // namespace lancer
