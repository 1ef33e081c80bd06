#include "io/image/color_space.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lancer {
namespace {

// As the Academy and OpenColorIO publish it, to the digits that they give.
TEST(ColorSpace, TheMatrixIsThatOfTheAcademy)
{
    constexpr double published[3][3] = {
        {0.613097, 0.339523, 0.047379}, {0.070194, 0.916354, 0.013452}, {0.020616, 0.109570, 0.869815}};
    const ColorMatrix m = to_space(ColorSpace::acescg);
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j) EXPECT_NEAR(m[i][j], published[i][j], 2e-6) << i << " " << j;
}

TEST(ColorSpace, GreyStaysGreyAndColoursComeBack)
{
    const ColorMatrix to = to_space(ColorSpace::acescg), back = from_space(ColorSpace::acescg);
    const Color white = transformed(to, {1, 1, 1});
    for (const float x : {white.r, white.g, white.b}) EXPECT_NEAR(x, 1, 1e-6);
    for (const Color c : {Color{1, 0, 0}, Color{0, 2, 0}, Color{0, 0, 3}, Color{0.2f, 0.5f, 0.9f}}) {
        const Color there = transformed(to, c), again = transformed(back, there);
        EXPECT_GE(std::min({there.r, there.g, there.b}), 0);  // the space is the larger one
        EXPECT_NEAR(again.r, c.r, 2e-6);
        EXPECT_NEAR(again.g, c.g, 2e-6);
        EXPECT_NEAR(again.b, c.b, 2e-6);
    }
    EXPECT_EQ(transformed(to_space(ColorSpace::lin_rec709), {0.1f, -2, 3}), (Color{0.1f, -2, 3}));
}

}  // namespace
}  // namespace lancer
