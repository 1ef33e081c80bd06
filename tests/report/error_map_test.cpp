#include "report/metrics/error_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/srgb.h"
#include "report/metrics/flip_color.h"

namespace lancer {
namespace {

TEST(ErrorMap, ColoursGetEvenlyLighter)
{
    const auto lightness = [](double t) {
        flip::Triple rgb = cubehelix(t);
        for (double& c : rgb) c = linear_from_srgb(c);
        return flip::lab_from_rgb(rgb)[0];
    };
    EXPECT_NEAR(lightness(0), 0, 1e-9);
    EXPECT_NEAR(lightness(1), 100, 1e-9);
    constexpr int steps = 32;
    double least = 100, most = 0;
    for (int i = 0; i < steps; ++i) {
        const double rise = lightness((i + 1.0) / steps) - lightness(i * 1.0 / steps);
        least = std::min(least, rise), most = std::max(most, rise);
    }
    // Even would be 3.1 each; a rainbow falls on the way.
    EXPECT_GT(least, 1);
    EXPECT_LT(most, 6);
}

TEST(ErrorMap, OutOfRangeIsTheNearestColour)
{
    EXPECT_EQ(cubehelix(-1), cubehelix(0));
    EXPECT_EQ(cubehelix(2), cubehelix(1));
    EXPECT_EQ(cubehelix(std::nan("")), cubehelix(0));
}

TEST(ErrorMap, ScalesAreThoseOfTheirErrors)
{
    const Image like = make_image({0, 0, 10, 10}, {4, 5, 8, 6});
    const float errors[] = {0, 1e-5f, 10, std::numeric_limits<float>::infinity()};
    const Image powers = draw_error_powers(like, errors);
    EXPECT_EQ(powers.data, like.data);
    EXPECT_EQ(powers.display, like.display);
    EXPECT_EQ(powers.pixels[0], (Color{0, 0, 0}));
    EXPECT_NEAR(powers.pixels[1].r, 0, 1e-6f);
    EXPECT_NEAR(powers.pixels[2].r, 1, 1e-6f);
    EXPECT_EQ(powers.pixels[3], (Color{1, 1, 1}));
    const float middle[] = {0.5f, 0.5f, 0.5f, 0.5f}, middle_power[] = {1e-2f, 1e-2f, 1e-2f, 1e-2f};
    EXPECT_NEAR(draw_errors(like, middle).pixels[0].g, draw_error_powers(like, middle_power).pixels[0].g, 1e-6f);
    EXPECT_NEAR(srgb_from_linear(static_cast<double>(draw_errors(like, middle).pixels[0].g)), cubehelix(0.5)[1], 1e-6);
}

}  // namespace
}  // namespace lancer
