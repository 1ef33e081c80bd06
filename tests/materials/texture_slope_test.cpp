// Slopes for bump maps, and checkers.
#include <gtest/gtest.h>

#include "materials/texture_samples.h"

namespace lancer {
namespace {

TEST(TextureSlope, OfARampIsItsStepPerTexelAtEveryFootprint)
{
    // Rises by 0.5 per texel to the right and by 0.25 per texel downwards.
    const Raster ramp =
        float_raster({64, 64}, 3, [](uint32_t x, uint32_t y, uint32_t c) { return c == 0 ? 0.5 * x + 0.25 * y : 9; });
    const ImageTexture texture(ramp, {.wrap = Wrap::clamp, .gain = 2, .bias = 5});
    for (const float texels : {0.0f, 1.0f, 1.7f, 2.0f, 3.0f, 4.0f, 8.0f}) {
        const Vec2 s = texture.slope({0.51f, 0.47f}, texels / 64);
        EXPECT_NEAR(s.x, 1, 1e-5) << texels;
        EXPECT_NEAR(s.y, -0.5, 1e-5) << texels;  // v points up
    }
    EXPECT_EQ(texture.slope({-3, 0.5f}, 0).x, 0);  // beyond the edge all is level
    EXPECT_NEAR(texture.slope({-3, 0.5f}, 0).y, -0.5, 1e-5);
    // Turned round, the surface climbs the other way.
    const ImageTexture mirrored(ramp, {.wrap = Wrap::clamp, .scale = {-1, 1}, .offset = {1, 0}, .gain = 2});
    EXPECT_NEAR(mirrored.slope({0.5f, 0.5f}, 0).x, -1, 1e-5);
    EXPECT_NEAR(mirrored.slope({0.5f, 0.5f}, 0).y, -0.5, 1e-5);
}

TEST(TextureSlope, IsTheDifferenceOverOneTexelAlsoAcrossTheSeam)
{
    Random random(6);
    const auto noise = [&](uint32_t, uint32_t, uint32_t) { return random.below(256); };
    for (const Size size : odd_and_even_sizes) {
        const ImageTexture texture(byte_raster(size, 1, noise), {.encoding = Encoding::linear});
        const float du = 0.5f / static_cast<float>(size.width), dv = 0.5f / static_cast<float>(size.height);
        for (int i = 0; i < 100; ++i) {
            const Vec2 uv = i % 2 ? random.unit2() : Vec2{0.0f, 1.0f};
            const auto at = [&](float x, float y) { return texture.eval({uv.x + x, uv.y + y}, 0).r; };
            const Vec2 s = texture.slope(uv, 0);
            EXPECT_NEAR(s.x, at(du, 0) - at(-du, 0), 1e-4);
            EXPECT_NEAR(s.y, at(0, dv) - at(0, -dv), 1e-4);
        }
    }
}

TEST(Checker, ColoursAlternateOnBothSidesOfTheOrigin)
{
    for (const float scale : {1.0f, 10.0f, -4.0f, 0.5f}) {
        const Checker checker = {.even = {1, 0, 0}, .odd = {0, 0, 1}, .scale = {scale, scale}};
        for (int y = -5; y <= 5; ++y) {
            for (int x = -5; x <= 5; ++x) {
                const Vec2 centre = {(static_cast<float>(x) + 0.5f) / scale, (static_cast<float>(y) + 0.5f) / scale};
                EXPECT_EQ(checker.eval(centre, 0), (x + y) % 2 == 0 ? checker.even : checker.odd) << x << ' ' << y;
            }
        }
    }
}

TEST(Checker, ABorderBelongsToTheCellAboveIt)
{
    const Checker checker;
    for (const float border : {0.0f, 1.0f, -1.0f, -2.0f, 255.0f, 8388607.0f, -16777215.0f}) {
        const bool even = std::fmod(border, 2.0f) == 0;
        EXPECT_EQ(checker.eval({border, 0.5f}, 0).r, even ? 1 : 0) << border;
        EXPECT_EQ(checker.eval({0.5f, border}, 0).r, even ? 1 : 0) << border;
    }
    EXPECT_EQ(checker.eval({std::nextafter(0.0f, -1.0f), 0.5f}, 0).r, 0);
    EXPECT_EQ(checker.eval({std::nextafter(1.0f, 0.0f), 0.5f}, 0).r, 1);
}

TEST(Checker, FarAwayItIsWhatDoubleSays)
{
    Random random(7);
    const Checker checker = {.scale = {1000.5f, 3}};
    for (int i = 0; i < 10000; ++i) {
        const auto u = static_cast<float>(random.log_uniform(-2, 8)), v = static_cast<float>(random.log_uniform(-2, 8));
        const auto a = static_cast<int64_t>(std::floor(1000.5 * static_cast<double>(u)));
        const auto b = static_cast<int64_t>(std::floor(3 * static_cast<double>(v)));
        EXPECT_EQ(checker.eval({u, v}, 0).r, (a + b) % 2 == 0 ? 1 : 0);
    }
    for (const float u : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
        EXPECT_EQ(checker.eval({u, 0}, 0), checker.odd);
}

}  // namespace
}  // namespace lancer
