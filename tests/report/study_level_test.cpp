// The level of pictures against pictures of which the truth is known: a part taken off everywhere, and noise.
#include "report/study/level.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/random.h"

namespace lancer {
namespace {

constexpr int32_t width = 40;

// 1 everywhere, times `level`, with noise of this standard deviation in each channel.
Image noisy(double level, double deviation, Random& random)
{
    Image image = make_image(width, width);
    const auto value = [&] {
        return static_cast<float>(level + deviation * std::sqrt(12.0) * (random.uniform() - 0.5));
    };
    for (Color& pixel : image.pixels) pixel = {value(), value(), value()};
    return image;
}

PictureLevel level_at(double level, double deviation, uint64_t seed, size_t pictures = 8)
{
    Random random(seed);
    std::vector<Image> images;
    for (size_t i = 0; i < pictures; ++i) images.push_back(noisy(level, deviation, random));
    return level_of(images, noisy(1, deviation / 4, random), noisy(1, deviation / 4, random));
}

TEST(StudyLevel, TellsWhatIsThereWithoutTheNoise)
{
    // Noise alone would make a relMSE of 0.01; what is systematic is 0.02² / 1.01.
    const PictureLevel level = level_at(0.98, 0.1, 1);
    EXPECT_EQ(level.pictures, 8u);
    for (size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(level.ratio[c], 0.98, 5 * 0.1 / width / std::sqrt(8.0));
        EXPECT_LE(level.ratio_interval[c].low, level.ratio[c]);
        EXPECT_GE(level.ratio_interval[c].high, level.ratio[c]);
    }
    // Over 28 pairs and 4800 values, products of noise have a standard deviation of 0.01 / sqrt(28 * 4800), those of
    // noise with the difference 2 * 0.02 * 0.1 / sqrt(8 * 4800).
    EXPECT_NEAR(level.systematic_relmse, 4e-4 / 1.01,
                5 * (0.01 / std::sqrt(28.0 * 4800) + 0.004 / std::sqrt(8.0 * 4800)));
    EXPECT_GT(level.systematic_interval.low, 0);
    EXPECT_LT(level.systematic_interval.high, 1e-3);
}

TEST(StudyLevel, FindsNothingWhereThereIsNothing)
{
    size_t above = 0, below = 0;
    for (uint64_t seed = 1; seed <= 40; ++seed) {
        const PictureLevel level = level_at(1, 0.2, seed);
        above += level.systematic_relmse > 0;
        below += level.systematic_relmse < 0;
        EXPECT_EQ(why_other_level(level), "");
    }
    // Unbiased: of 40 halves, 8 or fewer on a side have a probability below 1e-4.
    EXPECT_GT(above, 8u);
    EXPECT_GT(below, 8u);
}

TEST(StudyLevel, AnotherLevelIsSaidBeyondDoubtAlone)
{
    EXPECT_EQ(why_other_level(level_at(0.97, 0.02, 1)).rfind("not comparable: its mean radiance is 0.97", 0), 0u);
    EXPECT_EQ(why_other_level(level_at(0.985, 0.02, 1)), "");
    PictureLevel doubtful = level_at(0.97, 0.02, 1);
    for (Interval& i : doubtful.ratio_interval) i = {0.9, 1.1};
    EXPECT_EQ(why_other_level(doubtful), "");
}

TEST(StudyLevel, OnePictureTellsNoSystematicPart)
{
    const PictureLevel level = level_at(0.9, 0.1, 3, 1);
    EXPECT_TRUE(std::isnan(level.systematic_relmse));
    EXPECT_NEAR(level.ratio[0], 0.9, 0.02);
    Random random(1);
    // Two have one pair, of which no interval could be drawn.
    EXPECT_FALSE(std::isnan(level_at(0.9, 0.1, 3, 2).systematic_relmse));
    EXPECT_TRUE(std::isnan(level_at(0.9, 0.1, 3, 2).systematic_interval.low));
    EXPECT_NE(why_other_level(level), "");
    EXPECT_THROW(level_of({make_image(3, 3)}, noisy(1, 0, random), noisy(1, 0, random)), Error);
}

}  // namespace
}  // namespace lancer
