#include "report/metrics/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "core/error.h"

namespace lancer {
namespace {

constexpr float float_infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

Image constant(int32_t width, int32_t height, Color c)
{
    Image image = make_image(width, height);
    for (Color& p : image.pixels) p = c;
    return image;
}

TEST(Metrics, HandComputedValues)
{
    Image x = make_image(2, 1), r = make_image(2, 1);
    r.at(0, 0) = {1, 2, 0}, x.at(0, 0) = {1.5f, 2, 0.25f};
    r.at(1, 0) = {3, 0, 1}, x.at(1, 0) = {3, 0, -1};
    const Metrics m = compare(x, r);
    // Squared differences 0.25, 0, 0.0625, 0, 0, 4.
    EXPECT_DOUBLE_EQ(m.rmse, std::sqrt(4.3125 / 6));
    EXPECT_NEAR(m.relmse, (0.25 / 1.01 + 0.0625 / 0.01 + 4 / 1.01) / 6, 1e-15);
    EXPECT_DOUBLE_EQ(m.relmse_trimmed, m.relmse);  // two pixels: a thousandth of them is none
    EXPECT_DOUBLE_EQ(m.mean[0], 2.25);
    EXPECT_DOUBLE_EQ(m.reference_mean[0], 2);
    EXPECT_DOUBLE_EQ(m.mean_ratio[0], 1.125);
    EXPECT_DOUBLE_EQ(m.mean_ratio[1], 1);
    EXPECT_DOUBLE_EQ(m.mean[2], -0.375);
    EXPECT_DOUBLE_EQ(m.max_difference, 2);
    EXPECT_EQ(m.max_x, 1);
    EXPECT_EQ(m.max_y, 0);
    EXPECT_EQ(m.differing_pixels, 2u);
    EXPECT_EQ(m.non_finite_pixels + m.reference_non_finite, 0u);
}

TEST(Metrics, EqualPicturesHaveNoError)
{
    const Image x = constant(7, 5, {0.1f, 2, 30});
    const Metrics m = compare(x, x);
    EXPECT_EQ(m.rmse, 0);
    EXPECT_EQ(m.relmse, 0);
    EXPECT_EQ(m.relmse_trimmed, 0);
    EXPECT_EQ(m.max_difference, 0);
    EXPECT_EQ(m.differing_pixels, 0u);
    EXPECT_EQ(m.mean_ratio, (std::array<double, 3>{1, 1, 1}));
}

// 2000 pixels: the two largest errors are dropped, also when the third is as large as the second.
TEST(Metrics, TrimmingDropsAThousandth)
{
    const Image r = constant(50, 40, {0, 0, 0});
    Image x = r;
    for (Color& c : x.pixels) c = {0.1f, 0.1f, 0.1f};
    x.at(49, 39) = {10, 10, 10};
    x.at(0, 0) = {1, 1, 1};
    const double base = std::pow(static_cast<double>(0.1f), 2) / 0.01;
    EXPECT_NEAR(compare(x, r).relmse_trimmed, base, 1e-12);
    EXPECT_NEAR(compare(x, r).relmse, (1998 * base + 10000 + 100) / 2000, 1e-9);
    x.at(1, 0) = {1, 1, 1};
    EXPECT_NEAR(compare(x, r).relmse_trimmed, (1997 * base + 100) / 1998, 1e-12);
}

TEST(Metrics, NonFinitePixelsFailEveryLimit)
{
    const Image r = constant(50, 40, {1, 1, 1});
    Image x = r;
    x.at(7, 3) = {1, nan, 1};
    x.at(8, 3) = {float_infinity, 1, 1};
    Metrics m = compare(x, r);
    EXPECT_EQ(m.rmse, float_infinity);
    EXPECT_EQ(m.relmse, float_infinity);
    EXPECT_EQ(m.relmse_trimmed, 0);  // both are within the thousandth
    EXPECT_EQ(m.max_difference, float_infinity);
    EXPECT_EQ(m.max_x, 7);
    EXPECT_EQ(m.max_y, 3);
    EXPECT_EQ(m.non_finite_pixels, 2u);
    EXPECT_EQ(m.differing_pixels, 2u);
    m = compare(x, x);  // the same bits, but no picture to be content with
    EXPECT_EQ(m.differing_pixels, 0u);
    EXPECT_EQ(m.rmse, float_infinity);
    EXPECT_EQ(m.reference_non_finite, 2u);
}

TEST(Metrics, SymmetricErrorOfHandComputedValues)
{
    Image x = make_image(2, 1), r = make_image(2, 1);
    x.at(0, 0) = {1, 0, 0}, r.at(0, 0) = {3, 0, 2};             // 2/4, none, all
    x.at(1, 0) = {-1, 5, 1e-30f}, r.at(1, 0) = {1, 5, 3e-30f};  // all, none, 2/4: scale does not matter
    EXPECT_NEAR(compare(x, r).smape, (0.5 + 1 + 1 + 0.5) / 6, 1e-7);
    EXPECT_EQ(compare(x, r).smape, compare(r, x).smape);
    x.at(0, 0) = {nan, float_infinity, 0}, r.at(0, 0) = {1, float_infinity, 0};
    EXPECT_NEAR(compare(x, r).smape, (1 + 1 + 0 + 1 + 0 + 0.5) / 6, 1e-7);
}

TEST(Metrics, The99thPercentileIsAnErrorByRank)
{
    const Image r = constant(20, 10, {0, 0, 0});
    Image x = r;
    for (size_t i = 0; i < 200; ++i) x.pixels[(i * 77) % 200] = Color{0.1f, 0.1f, 0.1f} * static_cast<float>(i);
    // Of 200 pixels 198 are not above it: the one with 197 below it.
    EXPECT_NEAR(compare(x, r).relmse_p99, 197.0 * 197.0, 0.01);
    EXPECT_EQ(relative_squared_errors(x, r)[(197 * 77) % 200], compare(x, r).relmse_p99);
    EXPECT_EQ(compare(constant(1, 1, {1, 1, 1}), constant(1, 1, {1, 1, 1})).relmse_p99, 0);
}

TEST(Metrics, BitsDecideWhatDiffers)
{
    const Metrics m = compare(constant(2, 2, {0, 0, 0}), constant(2, 2, {-0.0f, 0, 0}));
    EXPECT_EQ(m.differing_pixels, 4u);
    EXPECT_EQ(m.rmse, 0);
}

TEST(Metrics, PlacesAreThoseOfTheWholePicture)
{
    const Image r = make_image({0, 0, 100, 100}, {30, 40, 33, 43});
    Image x = r;
    x.at(32, 41).g = -4;
    const Metrics m = compare(x, r);
    EXPECT_EQ(m.max_difference, 4);
    EXPECT_EQ(m.max_x, 32);
    EXPECT_EQ(m.max_y, 41);
}

TEST(Metrics, DifferentWindowsAreRefusedWithBoth)
{
    const auto message = [](const Image& a, const Image& b) -> std::string {
        try {
            compare(a, b);
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::invalid_input);
            return e.what();
        }
        return "";
    };
    EXPECT_EQ(message(make_image(4, 2), make_image(2, 4)),
              "error: the pictures differ in size: 4 x 2 at (0, 0) against 2 x 4 at (0, 0)");
    EXPECT_EQ(message(make_image({0, 0, 9, 9}, {1, 1, 5, 3}), make_image(4, 2)),
              "error: the pictures differ in size: 4 x 2 at (1, 1) of 9 x 9 at (0, 0) against 4 x 2 at (0, 0)");
    EXPECT_NE(message(Image{}, Image{}), "");
}

TEST(Metrics, UnbiasedErrorOfTwoReferences)
{
    Image x = make_image(1, 1), a = x, b = x;
    x.at(0, 0) = {2, 1, 0}, a.at(0, 0) = {1, 1, 0.5f}, b.at(0, 0) = {1.5f, 3, -0.25f};
    // (1)(0.5)/(1.5 + 0.01), 0, (-0.5)(0.25)/(-0.125 + 0.01)
    EXPECT_NEAR(unbiased_squared_error(x, a, b), (0.5 / 1.51 + 0.125 / 0.115) / 3, 1e-14);
    EXPECT_NEAR(unbiased_squared_error(x, a, a), compare(x, a).relmse, 1e-15);
    EXPECT_THROW(unbiased_squared_error(x, a, make_image(2, 1)), Error);
}

// References of one truth with independent noise: the estimate for the truth itself is about 0, while either
// reference alone calls it wrong by the whole variance of its noise.
TEST(Metrics, UnbiasedErrorIgnoresTheReferencesNoise)
{
    const Image x = constant(200, 200, {1, 1, 1});
    Image a = x, b = x;
    uint32_t h = 1;
    const auto noise = [&] { return static_cast<float>((h = h * 1664525u + 1013904223u) >> 8) * 0x1p-24f - 0.5f; };
    for (Image* image : {&a, &b}) {
        for (Color& c : image->pixels) c += {0.1f * noise(), 0.1f * noise(), 0.1f * noise()};
    }
    EXPECT_NEAR(compare(x, a).relmse, 0.01 / 12, 5e-5);
    EXPECT_NEAR(unbiased_squared_error(x, a, b), 0, 1e-5);  // four standard deviations: 4 * (0.01 / 12) / sqrt(120000)
}

TEST(Metrics, CountsPixelsBeyondALimit)
{
    Image a = make_image(3, 2), b = a;
    EXPECT_EQ(pixels_beyond(0, a, b), 0u);
    a.at(1, 0) = {2, -2, 1.5f};
    a.at(2, 1).b = 1.5f;
    a.at(0, 0).g = 1;
    EXPECT_EQ(pixels_beyond(1.5, a, b), 1u);
    EXPECT_EQ(pixels_beyond(1.25, a, b), 2u);
    b.at(0, 1).r = std::nanf("");
    EXPECT_EQ(pixels_beyond(1.5, a, b), 2u);
    EXPECT_THROW(pixels_beyond(1, a, make_image(2, 3)), Error);
}

}  // namespace
}  // namespace lancer
