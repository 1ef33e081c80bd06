#include "render/denoise/denoise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/parallel.h"
#include "support/random.h"

namespace lancer {
namespace {

// A picture in memory of its own, as the denoiser takes it.
struct Picture {
    uint32_t width = 0, height = 0;
    std::array<std::array<std::vector<float>, 10>, 2> planes;  // of each half: colour, albedo, normal, depth
    std::vector<float> variance;

    Picture(uint32_t w, uint32_t h) : width(w), height(h), variance(size())
    {
        for (auto& half : planes)
            for (auto& plane : half) plane.resize(size());
    }
    size_t size() const { return size_t{width} * height; }
    DenoiseInput input() const
    {
        DenoiseInput in{.width = width, .height = height, .halves = {}, .variance = variance};
        for (size_t h = 0; h < 2; ++h)
            for (size_t c = 0; c < 3; ++c) {
                in.halves[h].color[c] = planes[h][c];
                in.halves[h].albedo[c] = planes[h][3 + c];
                in.halves[h].normal[c] = planes[h][6 + c];
                in.halves[h].depth = planes[h][9];
            }
        return in;
    }
    // The mean of both halves in a channel.
    float noisy(size_t i, size_t c) const { return 0.5f * (planes[0][c][i] + planes[1][c][i]); }
};

float channel(Color c, size_t i) { return i == 0 ? c.r : i == 1 ? c.g : c.b; }

double gaussian(Random& random)
{
    const double u = random.uniform(), v = random.uniform();
    return std::sqrt(-2 * std::log(1 - u)) * std::cos(2 * std::numbers::pi * v);
}

// A floor with tiles of two colours and a wall, whose colour is an affine function of albedo and normal; noise of
// standard deviation `noise` in each half.
struct Affine {
    Picture picture{120, 90};
    std::vector<Color> truth;

    explicit Affine(double noise, uint64_t seed)
    {
        Random random(seed);
        truth.resize(picture.size());
        for (uint32_t y = 0; y < picture.height; ++y)
            for (uint32_t x = 0; x < picture.width; ++x) {
                const size_t i = size_t{y} * picture.width + x;
                const bool wall = y < 40, dark = (x / 6 + y / 6) % 2 == 0;
                const std::array<float, 3> albedo{dark ? 0.2f : 0.7f, 0.5f, dark ? 0.6f : 0.3f};
                const std::array<float, 3> normal{0, wall ? 0.0f : 1.0f, wall ? 1.0f : 0.0f};
                const float depth = wall ? 10.0f : 10.0f - 0.1f * static_cast<float>(y - 40);
                truth[i] = {0.1f + 0.5f * albedo[0] + 0.2f * normal[1], 0.3f + 0.1f * albedo[0] + 0.1f * normal[2],
                            0.1f + 0.4f * albedo[2]};
                for (auto& half : picture.planes) {
                    for (size_t c = 0; c < 3; ++c) {
                        half[c][i] = channel(truth[i], c) + static_cast<float>(noise * gaussian(random));
                        half[3 + c][i] = albedo[c], half[6 + c][i] = normal[c];
                    }
                    half[9][i] = depth;
                }
                picture.variance[i] = static_cast<float>(noise * noise);
            }
    }
    // Mean squared error of a picture whose channels are value(pixel, channel).
    double error(const std::function<float(size_t, size_t)>& value) const
    {
        double sum = 0;
        for (size_t i = 0; i < picture.size(); ++i)
            for (size_t c = 0; c < 3; ++c) sum += std::pow(double{value(i, c) - channel(truth[i], c)}, 2);
        return sum / static_cast<double>(3 * picture.size());
    }
};

std::vector<Color> denoised(const Picture& picture, unsigned threads = 2)
{
    Denoised result;
    with_threads(threads, [&] { result = denoise_picture(picture.input()); });
    EXPECT_EQ(result.pixels.size(), picture.size());
    return result.pixels;
}

// Random halves of any statistics.
Picture random_picture(uint32_t width, uint32_t height, uint64_t seed)
{
    Picture picture(width, height);
    Random random(seed);
    for (auto& half : picture.planes)
        for (auto& plane : half)
            for (float& v : plane) v = static_cast<float>(-std::log(1 - random.uniform()));
    for (float& v : picture.variance) v = random.unit();
    return picture;
}

TEST(Denoise, RestoresAffineFunctionsOfFeatures)
{
    const Affine scene(0.1, 1);
    const std::vector<Color> result = denoised(scene.picture);
    const double before = scene.error([&](size_t i, size_t c) { return scene.picture.noisy(i, c); });
    const double after = scene.error([&](size_t i, size_t c) { return channel(result[i], c); });
    EXPECT_NEAR(before, 0.5 * 0.1 * 0.1, 0.0005);
    EXPECT_LT(after, before / 60);
}

TEST(Denoise, LeavesAConstantPictureAlone)
{
    Picture picture(70, 41);
    for (auto& half : picture.planes)
        for (size_t c = 0; c < 3; ++c) half[c].assign(picture.size(), 0.1f + 0.3f * static_cast<float>(c));
    for (const Color& pixel : denoised(picture))
        for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(channel(pixel, c), 0.1f + 0.3f * static_cast<float>(c), 1e-5f);
}

// Where both halves agree nothing is noise, and James-Stein returns to the picture however bad the fits are.
TEST(Denoise, LeavesHalvesThatAgreeAlone)
{
    Picture picture = random_picture(70, 41, 2);
    picture.planes[1] = picture.planes[0];
    picture.variance.assign(picture.size(), 0);
    const std::vector<Color> result = denoised(picture);
    for (size_t i = 0; i < picture.size(); ++i)
        for (size_t c = 0; c < 3; ++c) ASSERT_NEAR(channel(result[i], c), picture.noisy(i, c), 1e-5f) << i;
}

// A texture as fine as pixels that no feature shows: fits take it for noise, James-Stein does not.
TEST(Denoise, IsNoWorseThanTheNoisyPictureWhereFitsErr)
{
    Affine scene(0.05, 12);
    Random random(13);
    for (size_t i = 0; i < scene.picture.size(); ++i) {
        const float texture = random.unit() < 0.5f ? -0.05f : 0.05f;
        scene.truth[i] = scene.truth[i] + Color{texture, texture, texture};
        for (auto& half : scene.picture.planes)
            for (size_t c = 0; c < 3; ++c) half[c][i] += texture;
    }
    const std::vector<Color> result = denoised(scene.picture);
    const double before = scene.error([&](size_t i, size_t c) { return scene.picture.noisy(i, c); });
    EXPECT_LT(scene.error([&](size_t i, size_t c) { return channel(result[i], c); }), 0.8 * before);
}

TEST(Denoise, HasTheSameBitsOnAnyNumberOfThreads)
{
    const Picture picture = random_picture(150, 77, 3);
    const std::vector<Color> one = denoised(picture, 1);
    EXPECT_EQ(denoised(picture, 2), one);
    EXPECT_EQ(denoised(picture, 5), one);
}

// Colours are scaled by a power of two; nothing depends on their unit.
// A picture of many rows, with lamps, outliers and noise that varies, so that fits in between are wanted everywhere.
TEST(Denoise, HasTheSameBitsInBands)
{
    Picture picture(40, 500);
    Random random(5);
    for (size_t i = 0; i < picture.size(); ++i) {
        const size_t y = i / picture.width, x = i % picture.width;
        const bool is_lamp = y % 37 < 3 && x % 13 < 4;
        for (size_t h = 0; h < 2; ++h)
            for (size_t c = 0; c < 10; ++c) {
                const double mean = c >= 3 ? 0.5 : is_lamp ? 30 : 0.1 + 0.01 * static_cast<double>(y % 61);
                const double noise = c >= 3 ? 0.05 : random.below(40) == 0 ? 4 : 0.2;
                picture.planes[h][c][i] = static_cast<float>(mean + noise * random.uniform(0, 1));
            }
        picture.variance[i] = static_cast<float>(random.uniform(0.01, 0.1));
    }
    const Denoised whole = denoise_picture(picture.input(), {}, 500), bands = denoise_picture(picture.input(), {}, 64);
    for (size_t i = 0; i < picture.size(); ++i) {
        ASSERT_EQ(whole.pixels[i], bands.pixels[i]) << "row " << i / picture.width;
        ASSERT_EQ(whole.error[i], bands.error[i]) << "row " << i / picture.width;
    }
}

TEST(Denoise, DoesNotDependOnTheUnitOfRadiance)
{
    const Picture picture = random_picture(40, 30, 4);
    Picture scaled = picture;
    for (auto& half : scaled.planes)
        for (size_t c = 0; c < 3; ++c)
            for (float& v : half[c]) v *= 4096;
    for (float& v : scaled.variance) v *= 16;  // only its distribution over pixels counts
    const std::vector<Color> expected = denoised(picture), result = denoised(scaled);
    for (size_t i = 0; i < picture.size(); ++i) ASSERT_EQ(result[i], expected[i] * 4096.0f);
}

TEST(Denoise, GivesFiniteNumbersForAnyInput)
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    std::vector<Picture> pictures;
    for (const auto& [w, h] : {std::pair{1u, 1u}, {1u, 30u}, {3u, 2u}, {65u, 33u}}) {
        pictures.emplace_back(w, h);
        pictures.push_back(random_picture(w, h, 5));
        Picture& huge = pictures.emplace_back(random_picture(w, h, 6));
        for (auto& half : huge.planes)
            for (auto& plane : half) plane[plane.size() / 2] = std::numeric_limits<float>::max();
        Picture& tiny = pictures.emplace_back(random_picture(w, h, 7));
        for (auto& half : tiny.planes)
            for (auto& plane : half)
                for (float& v : plane) v *= 1e-37f;
        Picture& broken = pictures.emplace_back(random_picture(w, h, 8));
        for (auto& half : broken.planes)
            for (auto& plane : half) plane[0] = nan, plane.back() = inf;
        broken.variance[0] = nan;
    }
    for (size_t i = 0; i < pictures.size(); ++i)
        for (const Color& pixel : denoised(pictures[i]))
            ASSERT_TRUE(is_finite(pixel)) << i % 5 << ' ' << pictures[i].width;
    EXPECT_TRUE(denoise_picture({}).pixels.empty());
    const std::vector<float> plane(64 * 3, 0.5f);  // without features and variance
    DenoiseInput only_colors{.width = 64, .height = 3, .halves = {}, .variance = {}};
    for (DenoiseHalf& half : only_colors.halves) half.color.fill(plane);
    for (const Color& pixel : denoise_picture(only_colors).pixels) EXPECT_NEAR(pixel.r, 0.5f, 1e-6f);
}

// A lamp whose edges no feature shows, with rows and columns of pixels that it covers in part: they are unlike all
// others, and fits of these would put anything there.
TEST(Denoise, KeepsTheEdgesOfABrightLamp)
{
    for (const uint32_t shift : {0u, 1u}) {
        Affine scene(0.05, 10);
        Random random(11);
        const uint32_t x0 = 30 + shift, x1 = 71 + shift, y0 = 50 + shift, y1 = 63 + shift;
        for (uint32_t y = y0; y < y1; ++y)
            for (uint32_t x = x0; x < x1; ++x) {
                const bool is_edge = x == x0 || x + 1 == x1 || y == y0 || y + 1 == y1;
                const size_t i = size_t{y} * scene.picture.width + x;
                const float covered = is_edge ? 0.4f : 1.0f;
                scene.truth[i] = scene.truth[i] * (1 - covered) + Color{20, 18, 15} * covered;
                for (auto& half : scene.picture.planes) {
                    const float seen = is_edge ? covered + 0.05f * static_cast<float>(gaussian(random)) : 1.0f;
                    for (size_t c = 0; c < 3; ++c)
                        half[c][i] = half[c][i] * (1 - seen) + std::array{20.0f, 18.0f, 15.0f}[c] * seen;
                }
                scene.picture.variance[i] = is_edge ? 1.0f : 0.0f;
            }
        const std::vector<Color> result = denoised(scene.picture);
        const auto relative_error = [&](const std::function<float(size_t, size_t)>& value) {
            double sum = 0;
            for (size_t i = 0; i < scene.picture.size(); ++i)
                for (size_t c = 0; c < 3; ++c) {
                    const double truth = double{channel(scene.truth[i], c)}, e = double{value(i, c)} - truth;
                    sum += e * e / (truth * truth + 0.01);
                }
            return sum;
        };
        const double before = relative_error([&](size_t i, size_t c) { return scene.picture.noisy(i, c); });
        EXPECT_LT(relative_error([&](size_t i, size_t c) { return channel(result[i], c); }), before / 4) << shift;
    }
}

// One sample of a thousand times the light: it leaves no bright pixel, and most of its light stays in the picture.
TEST(Denoise, SpreadsTheLightOfAnOutlier)
{
    Affine scene(0.02, 9);
    const size_t at = 45 * scene.picture.width + 60;
    for (size_t c = 0; c < 3; ++c) scene.picture.planes[0][c][at] += 100;
    scene.picture.variance[at] = 100 * 100;
    double light = 0, expected = 0;
    for (size_t i = 0; const Color& pixel : denoised(scene.picture)) {
        light += double{pixel.g}, expected += double{scene.picture.noisy(i++, 1)};
        EXPECT_LT(pixel.g, 1.0f);
    }
    EXPECT_NEAR(light, expected, 25);
}

}  // namespace
}  // namespace lancer
