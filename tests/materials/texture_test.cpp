// What every texture keeps, whatever its size, storage, channels and wrap.
#include "materials/textures/texture.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/srgb.h"
#include "materials/texture_samples.h"

namespace lancer {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();

// One number per channel everywhere, in each way that a raster can hold it.
std::vector<Raster> constant_rasters(Size size, uint32_t channels)
{
    const auto byte = [](uint32_t, uint32_t, uint32_t c) { return 37 + 50 * c; };
    const auto exact_half = [](uint32_t, uint32_t, uint32_t c) { return 0.25f + static_cast<float>(c); };
    const auto no_half = [](uint32_t, uint32_t, uint32_t c) { return 0.1f / (1 + static_cast<float>(c)); };
    const auto bright = [](uint32_t, uint32_t, uint32_t c) { return 123456.7f + static_cast<float>(c); };
    std::vector<Raster> all = {byte_raster(size, channels, byte), float_raster(size, channels, exact_half),
                               float_raster(size, channels, no_half), float_raster(size, channels, bright),
                               float_raster(size, channels, no_half)};
    all.back().is_float = false;  // integers of 16 bits
    return all;
}

TEST(Texture, AConstantPictureIsThatConstantEverywhere)
{
    Random random(1);
    for (const Size size : odd_and_even_sizes) {
        for (const uint32_t channels : {1u, 2u, 3u, 4u}) {
            for (const Raster& raster : constant_rasters(size, channels)) {
                for (const Channel channel : {Channel::color, Channel::green, Channel::alpha, Channel::luminance}) {
                    const ImageUse use = {.encoding = random.below(2) ? Encoding::srgb : Encoding::linear,
                                          .channel = channel,
                                          .wrap = random.below(2) ? Wrap::repeat : Wrap::clamp,
                                          .scale = {3, -0.7f},
                                          .gain = 1.5f,
                                          .bias = -0.25f};
                    const ImageTexture texture(raster, use);
                    const Color expected = texture.eval({}, 0);
                    EXPECT_EQ(texture.mean(), expected);
                    for (int i = 0; i < 20; ++i) {
                        const Vec2 uv = {static_cast<float>(random.log_uniform(-6, 6)),
                                         static_cast<float>(random.log_uniform(-6, 6))};
                        const auto width = static_cast<float>(std::abs(random.log_uniform(-4, 4)));
                        EXPECT_EQ(texture.eval(uv, width), expected) << size.width << " x " << size.height;
                        EXPECT_EQ(texture.slope(uv, width), Vec2{});
                    }
                }
            }
        }
    }
}

TEST(Texture, TexelsLieAtTheirCentresAndTheFirstRowIsOnTop)
{
    for (const Size size : odd_and_even_sizes) {
        const auto value = [](uint32_t x, uint32_t y, uint32_t c) { return 1 + x + 10 * y + 100 * c; };
        const ImageTexture texture(float_raster(size, 3, value), {});
        for (uint32_t y = 0; y < size.height; ++y) {
            for (uint32_t x = 0; x < size.width; ++x) {
                const auto at = [](uint32_t i, uint32_t n) {
                    return (static_cast<float>(i) + 0.5f) / static_cast<float>(n);
                };
                for (const float period : {0.0f, 1.0f, -3.0f}) {
                    const Color c = texture.eval({at(x, size.width) + period, 1 - at(y, size.height) - period}, 0);
                    const auto expected = static_cast<float>(value(x, y, 0));
                    EXPECT_NEAR(c.r, expected, 0.03f);  // a neighbour differs by 1 at least
                    EXPECT_NEAR(c.b, expected + 200, 0.03f);
                }
            }
        }
    }
}

// Bilinear interpolation is integrated exactly by points that lie symmetrically about the texels' centres.
Color mean_over_a_period(const ImageTexture& texture, uint32_t columns, uint32_t rows, float width)
{
    double r = 0, g = 0, b = 0;
    for (uint32_t y = 0; y < rows; ++y) {
        for (uint32_t x = 0; x < columns; ++x) {
            const Color c = texture.eval({(static_cast<float>(x) + 0.5f) / static_cast<float>(columns),
                                          (static_cast<float>(y) + 0.5f) / static_cast<float>(rows)},
                                         width);
            r += static_cast<double>(c.r), g += static_cast<double>(c.g), b += static_cast<double>(c.b);
        }
    }
    const double n = static_cast<double>(columns) * rows;
    return {static_cast<float>(r / n), static_cast<float>(g / n), static_cast<float>(b / n)};
}

TEST(Texture, EveryLevelHasTheMeanOfThePicture)
{
    Random random(2);
    for (const Size size : odd_and_even_sizes) {
        const auto noise = [&](uint32_t, uint32_t, uint32_t) { return random.below(256); };
        const Raster bytes = byte_raster(size, 3, noise);
        const Raster floats = float_raster(size, 3, [&](uint32_t, uint32_t, uint32_t) {
            return 1000 * std::abs(random.log_uniform(-3, 3));  // float, not half
        });
        for (const Raster* raster : {&bytes, &floats}) {
            double exact = 0;
            for (size_t i = 0; i < raster->value_count(); i += 3)
                exact += raster->floats.empty() ? linear_from_srgb(raster->bytes[i] / 255.0)
                                                : static_cast<double>(raster->floats[i]);
            exact /= size.width * size.height;
            const ImageTexture texture(*raster, {});
            EXPECT_NEAR(texture.mean().r, exact, 1e-6 * exact);
            uint32_t w = size.width, h = size.height;
            for (uint32_t level = 0;; ++level) {
                const float width =
                    std::ldexp(1.0f, static_cast<int>(level)) / static_cast<float>(std::max(size.width, size.height));
                // Half a step of a byte, at most 1/255 / 2 * the curve's slope at 1, and by chance either way.
                const double tolerance =
                    raster->floats.empty() && level > 0 ? 0.0045 / std::sqrt(static_cast<double>(w * h)) : 3e-6 * exact;
                EXPECT_NEAR(mean_over_a_period(texture, 2 * w, 2 * h, width).r, exact, tolerance)
                    << size.width << " x " << size.height << ", level " << level;
                if (w == 1 && h == 1) break;
                w = std::max(w / 2, 1u), h = std::max(h / 2, 1u);
            }
        }
    }
}

TEST(Texture, ARepeatedPictureHasNoSeam)
{
    Random random(3);
    for (const Size size : odd_and_even_sizes) {
        const ImageTexture texture(
            byte_raster(size, 1, [&](uint32_t, uint32_t, uint32_t) { return random.below(256); }),
            {.encoding = Encoding::linear});
        for (const float width : {0.0f, 0.05f, 0.4f}) {
            for (const float at : {0.0f, 1.0f, -1.0f, 17.0f}) {
                const float other = random.unit(), step = 0x1p-19f, most = 4 * step * 64;
                const auto across = [&](float s) { return texture.eval({at + s, other}, width).r; };
                const auto down = [&](float s) { return texture.eval({other, at + s}, width).r; };
                EXPECT_NEAR(across(-step), across(step), most);
                EXPECT_NEAR(down(-step), down(step), most);
                EXPECT_NEAR(across(0), across(step), most);
                EXPECT_NEAR(down(0), down(step), most);
            }
        }
    }
}

TEST(Texture, AClampedPictureGoesOnWithItsEdges)
{
    const auto value = [](uint32_t x, uint32_t y, uint32_t) { return 1 + x + 10 * y; };
    const ImageTexture texture(float_raster({4, 3}, 1, value), {.wrap = Wrap::clamp});
    for (const float far : {0.0f, 0.1f, 7.0f, 1e30f, infinity}) {
        EXPECT_EQ(texture.eval({-far, 1 + far}, 0).r, 1);
        EXPECT_EQ(texture.eval({1 + far, 1 + far}, 0).r, 4);
        EXPECT_EQ(texture.eval({-far, -far}, 0).r, 21);
        EXPECT_EQ(texture.eval({1 + far, -far}, 0).r, 24);
    }
}

TEST(Texture, TheFootprintChoosesTheLevel)
{
    // Columns of 0 and 1 become 0.5 where a footprint covers two.
    const Raster columns = float_raster({64, 16}, 1, [](uint32_t x, uint32_t, uint32_t) { return x % 2; });
    for (const float scale : {1.0f, -4.0f}) {
        const ImageTexture texture(columns, {.scale = {scale, 1}});
        const float texel = 1 / (64 * std::abs(scale)), u = 0.5f * texel;
        EXPECT_EQ(texture.eval({u, 0}, 0).r, scale > 0 ? 0 : 1);
        EXPECT_EQ(texture.eval({u, 0}, texel).r, texture.eval({u, 0}, 0).r);
        EXPECT_EQ(texture.eval({u, 0}, 2 * texel).r, 0.5f);
        EXPECT_EQ(texture.eval({u, 0}, 1.5f * texel).r, scale > 0 ? 0.25f : 0.75f);
        for (const float width : {2.5f * texel, 1.0f, 1e20f, infinity}) EXPECT_EQ(texture.eval({u, 0}, width).r, 0.5f);
        EXPECT_EQ(texture.eval({u, 0}, nan).r, texture.eval({u, 0}, 0).r);
        EXPECT_EQ(texture.eval({u, 0}, -1).r, texture.eval({u, 0}, 0).r);
    }
}

TEST(Texture, FarFromTheOriginTexelsAreStillTheRightOnes)
{
    const auto value = [](uint32_t x, uint32_t y, uint32_t) { return 1 + x + 100 * y; };
    const ImageTexture texture(float_raster({64, 64}, 1, value), {});
    for (const float period : {1e5f, -1e5f}) {
        for (uint32_t i = 0; i < 64; ++i) {
            const float centre = (static_cast<float>(i) + 0.5f) / 64;  // as exact at 100 000 as at 0
            EXPECT_EQ(texture.eval({period + centre, period + centre}, 0).r, static_cast<float>(value(i, 63 - i, 0)));
        }
    }
    // The product is not rounded: a picture repeated 100 003 times is looked up as exactly as uv says.
    const ImageTexture often(float_raster({64, 1}, 1, value), {.scale = {100003, 1}});
    Random random(4);
    for (int i = 0; i < 1000; ++i) {
        const float u = random.unit();
        const double place = 64 * std::fmod(100003.0 * static_cast<double>(u), 1.0) - 0.5;
        if (place < 0 || place > 63) continue;
        EXPECT_NEAR(often.eval({u, 0}, 0).r, 1 + place, 1e-4);
    }
}

TEST(Texture, AnyUvGivesAColourOfThePicture)
{
    Random random(5);
    const auto noise = [&](uint32_t, uint32_t, uint32_t) { return random.below(256); };
    for (const Size size : odd_and_even_sizes) {
        for (const Wrap wrap : {Wrap::repeat, Wrap::clamp}) {
            const ImageTexture texture(byte_raster(size, 3, noise), {.wrap = wrap});
            for (const float u : {nan, infinity, -infinity, 3e38f, -3e38f, 1e6f, -1e-30f, -1e-45f, 1.0f}) {
                for (const float width : {0.0f, 0.3f, infinity}) {
                    for (const Color c : {texture.eval({u, 0.3f}, width), texture.eval({0.3f, u}, width)}) {
                        EXPECT_GE(std::min(c.r, std::min(c.g, c.b)), 0);
                        EXPECT_LE(max_component(c), 1);
                    }
                    EXPECT_LE(std::abs(texture.slope({u, u}, width).x), 1);
                }
            }
        }
    }
}

TEST(Texture, ChannelsAreTakenAsAsked)
{
    // Alpha is 51/255 = 0.2, never decoded.
    const auto rgba = [](uint32_t, uint32_t, uint32_t c) { return std::array{255, 188, 64, 51}[c]; };
    const auto grey = [](uint32_t, uint32_t, uint32_t c) { return std::array{188, 51}[c]; };
    const auto decoded = [](int step) { return static_cast<float>(linear_from_srgb(step / 255.0)); };
    const auto value = [](const Raster& r, Channel c) { return ImageTexture(r, {.channel = c}).eval({}, 0); };
    const auto all = [](float v) { return Color{v, v, v}; };
    const Raster color = byte_raster({2, 2}, 4, rgba), with_alpha = byte_raster({2, 2}, 2, grey);
    EXPECT_EQ(value(color, Channel::color), (Color{1, decoded(188), decoded(64)}));
    EXPECT_EQ(value(color, Channel::red), all(1));
    EXPECT_EQ(value(color, Channel::green), all(decoded(188)));
    EXPECT_EQ(value(color, Channel::blue), all(decoded(64)));
    EXPECT_EQ(value(color, Channel::alpha), all(0.2f));
    EXPECT_EQ(value(color, Channel::automatic), all(0.2f));
    const float grey_value = luminance({1, decoded(188), decoded(64)});
    EXPECT_NEAR(value(color, Channel::luminance).g, grey_value, 0.0045f);  // half a step
    for (const Channel c : {Channel::color, Channel::red, Channel::green, Channel::blue, Channel::luminance})
        EXPECT_EQ(value(with_alpha, c), all(decoded(188)));
    EXPECT_EQ(value(with_alpha, Channel::alpha), all(0.2f));
    EXPECT_EQ(value(byte_raster({2, 2}, 3, rgba), Channel::alpha), all(1));
    EXPECT_EQ(value(byte_raster({2, 2}, 3, rgba), Channel::automatic), all(1));  // the first channel
    const auto opaque = [](uint32_t, uint32_t, uint32_t c) { return c == 1 ? 255 : 188; };
    EXPECT_EQ(value(byte_raster({2, 2}, 2, opaque), Channel::automatic), all(decoded(188)));
    Raster floats = float_raster({2, 2}, 4, [](uint32_t x, uint32_t, uint32_t c) { return c == 3 && x ? 0.5 : 1; });
    EXPECT_EQ(ImageTexture(floats, {.channel = Channel::automatic}).mean(), all(0.75f));
}

TEST(Texture, IntegersAreDecodedFloatsAreNot)
{
    Raster raster = float_raster({1, 1}, 1, [](uint32_t, uint32_t, uint32_t) { return 0.5; });
    EXPECT_EQ(ImageTexture(raster, {}).mean().r, 0.5f);
    raster.is_float = false;
    EXPECT_EQ(ImageTexture(raster, {.encoding = Encoding::linear}).mean().r, 0.5f);
    EXPECT_NEAR(ImageTexture(raster, {}).mean().r, linear_from_srgb(0.5), 1e-5);
    EXPECT_EQ(ImageTexture(raster, {.encoding = Encoding::linear, .gain = 3, .bias = -1}).eval({}, 0).g, 0.5f);
}

TEST(Texture, StorageIsAsSmallAsThePictureAllows)
{
    const auto one_number = [](double v) { return [v](uint32_t, uint32_t, uint32_t) { return v; }; };
    const auto bytes = [](const Raster& r, Channel c) { return ImageTexture(r, {.channel = c}).bytes(); };
    constexpr uint64_t texels = 64 + 16 + 4 + 1;
    EXPECT_EQ(bytes(byte_raster({8, 8}, 4, one_number(7)), Channel::color), 3 * texels);
    EXPECT_EQ(bytes(byte_raster({8, 8}, 4, one_number(7)), Channel::luminance), texels);
    EXPECT_EQ(bytes(byte_raster({8, 8}, 1, one_number(7)), Channel::color), texels);
    EXPECT_EQ(bytes(float_raster({8, 8}, 3, one_number(0.5)), Channel::color), 2 * 3 * texels);
    EXPECT_EQ(bytes(float_raster({8, 8}, 3, one_number(65504)), Channel::color), 2 * 3 * texels);
    EXPECT_EQ(bytes(float_raster({8, 8}, 3, one_number(65505)), Channel::color), 4 * 3 * texels);
    EXPECT_EQ(bytes(float_raster({8, 8}, 3, one_number(0.1)), Channel::red), 4 * texels);
}

TEST(Texture, WhatIsNotFiniteCountsAsNothing)
{
    const Raster raster = float_raster({2, 2}, 3, [](uint32_t x, uint32_t y, uint32_t c) {
        return x + y == 0 ? (c == 0 ? nan : c == 1 ? infinity : 4.0f) : 4.0f;
    });
    const ImageTexture texture(raster, {});
    EXPECT_EQ(texture.not_finite(), 2u);
    EXPECT_EQ(texture.mean(), (Color{3, 3, 4}));
    EXPECT_EQ(ImageTexture(raster, {.channel = Channel::blue}).not_finite(), 0u);
}

}  // namespace
}  // namespace lancer
