#include "report/metrics/worst_blocks.h"

#include <gtest/gtest.h>

#include <limits>

#include "report/metrics/metrics.h"
#include "support/random.h"

namespace lancer {
namespace {

Image grey(int32_t width, int32_t height, float value)
{
    Image image = make_image(width, height);
    for (Color& pixel : image.pixels) pixel = {value, value, value};
    return image;
}

TEST(WorstBlocks, CoverThePictureOnceAndKeepTheirSize)
{
    Random random(1);
    for (const auto& [width, height] : {std::pair{100, 70}, {32, 32}, {33, 31}, {5, 3}, {1, 200}}) {
        const Image reference = grey(width, height, 1);
        Image picture = reference;
        for (Color& pixel : picture.pixels) pixel.r += 0.1f + static_cast<float>(random.uniform());
        std::vector<int> seen(picture.pixels.size());
        for (const Window& w : worst_blocks(reference, {&picture}, 32, 1000)) {
            EXPECT_LE(w.width(), 32);
            EXPECT_LE(w.height(), 32);
            for (int32_t y = w.y0; y < w.y1; ++y)
                for (int32_t x = w.x0; x < w.x1; ++x) ++seen[static_cast<size_t>(y * width + x)];
        }
        EXPECT_EQ(seen, std::vector<int>(picture.pixels.size(), 1));
    }
}

TEST(WorstBlocks, TheWorstComeFirstWithTheSameWeightForEachPicture)
{
    const Image reference = grey(96, 64, 1);
    Image loud = grey(96, 64, 2), quiet = reference;  // loud is bad everywhere, and a little worse in one place
    loud.at(3, 50) = {2.5f, 2.5f, 2.5f};
    quiet.at(40, 10).g = 1.01f;
    quiet.at(70, 40).g = 1.02f;
    const auto found = worst_blocks(reference, {&loud, &quiet}, 32, 2);
    EXPECT_EQ(found, (std::vector<Window>{{64, 32, 96, 64}, {32, 0, 64, 32}}));
}

TEST(WorstBlocks, NothingToSayIsNone)
{
    const Image reference = grey(64, 64, 1);
    Image broken = reference;
    broken.at(3, 3).r = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(worst_blocks(reference, {}, 32, 3).empty());
    EXPECT_TRUE(worst_blocks(reference, {&reference, &broken}, 32, 3).empty());
}

TEST(WorstBlocks, APartIsThatPartOfThePicture)
{
    Image image = make_image({0, 0, 9, 9}, {2, 3, 8, 7});
    for (int32_t y = 3; y < 7; ++y)
        for (int32_t x = 2; x < 8; ++x) image.at(x, y) = {static_cast<float>(x), static_cast<float>(y), 0};
    const Image part = part_of(image, {4, 5, 7, 6});
    EXPECT_EQ(part.data, (Window{0, 0, 3, 1}));
    EXPECT_EQ(part.at(2, 0).r, 6);
    EXPECT_EQ(part.at(2, 0).g, 5);
}

}  // namespace
}  // namespace lancer
