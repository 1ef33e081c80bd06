// The colour of a thick body, against Chandrasekhar's exact reflection of a half-space.
#include "materials/subsurface.h"

#include <gtest/gtest.h>

#include "support/half_space.h"

namespace lancer {
namespace {

TEST(Subsurface, ColorIsThatOfAHalfSpace)
{
    for (const double color : {0.02, 0.1, 0.3, 0.5, 0.8, 0.95, 1.0}) {
        const double albedo = albedo_of_scattering(color, 0);
        EXPECT_GE(albedo, 0);
        EXPECT_LE(albedo, 1);
        EXPECT_NEAR(HalfSpace(albedo).reflects_even_light(), color, 0.01 * color + 0.001) << color;
    }
    EXPECT_EQ(albedo_of_scattering(0, 0.5), 0);
    EXPECT_EQ(albedo_of_scattering(1, 0.5), 1);
}

// What scatters forwards needs a higher albedo for the same colour: similarity, (1 - albedo) / (1 - g albedo).
TEST(Subsurface, ForwardScatteringNeedsMoreOfIt)
{
    for (const double color : {0.2, 0.7}) {
        const double even = albedo_of_scattering(color, 0), forwards = albedo_of_scattering(color, 0.8);
        EXPECT_GT(forwards, even);
        EXPECT_NEAR((1 - forwards) / (1 - 0.8 * forwards), 1 - even, 1e-12);
    }
}

TEST(Subsurface, RadiusIsTheMeanFreePath)
{
    const Subsurface s({0.8f, 0.5f, 0.2f}, {2, 1, 0.25f}, 0, 1);
    EXPECT_NEAR(s.scattering.r + s.absorption.r, 0.5f, 1e-6f);
    EXPECT_NEAR(s.scattering.g + s.absorption.g, 1, 1e-6f);
    EXPECT_NEAR(s.scattering.b + s.absorption.b, 4, 1e-6f);
    EXPECT_GT(s.scattering.r * 2, s.scattering.b / 4) << "the brighter, the more is scattered";
}

}  // namespace
}  // namespace lancer
