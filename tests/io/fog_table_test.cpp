// [fog], and what materials say of media that scatter.
#include <gtest/gtest.h>

#include "scene_test_support.h"

namespace lancer {
namespace {

using FogTable = SceneFileTest;

TEST_F(FogTable, EveryKeyIsRead)
{
    EXPECT_FALSE(scene("version = 1").fog);
    const SceneDescription s = scene(R"(
[fog]
scattering = [0.1, 0.2, 0.3]
absorption = 0.5
anisotropy = -0.4
min = [-1, -2, -3]
max = [1, 2, 3])");
    ASSERT_TRUE(s.fog);
    EXPECT_EQ(s.fog->scattering, (Color{0.1f, 0.2f, 0.3f}));
    EXPECT_EQ(s.fog->absorption, (Color{0.5f, 0.5f, 0.5f}));
    EXPECT_EQ(s.fog->anisotropy, -0.4f);
    EXPECT_EQ(s.fog->low, (Vec3d{-1, -2, -3}));
    EXPECT_EQ(s.fog->high, (Vec3d{1, 2, 3}));
    EXPECT_FALSE(s.fog->height);
    const SceneDescription high = scene("[fog]\nheight = 7\nup = \"z\"");
    EXPECT_EQ(high.fog->height, 7);
    EXPECT_TRUE(high.fog->z_up);
    EXPECT_FALSE(high.fog->low);
}

TEST_F(FogTable, RefusesWhatCannotBe)
{
    const auto says = [&](const std::string& text, const std::string& what) {
        const std::string told = problems("[fog]\n" + text);
        EXPECT_NE(told.find(what), std::string::npos) << text << ": " << told;
    };
    says("anisotropy = 1", "from -0.999 to 0.999");
    says("scattering = -1", "scattering");
    says("height = 1\nmin = [0, 0, 0]", "cannot be given beside 'min' and 'max'");
    says("up = \"z\"", "needs a 'height'");
    says("min = [0, 0, 0]\nmax = [1, 0, 1]", "must be above 'min' along each axis");
    says("denisty = 1", "unknown key 'denisty' in [fog]");
}

TEST_F(FogTable, MaterialsSayWhatIsInside)
{
    const SceneDescription s = scene(R"(
[material.milk]
type = "glass"
scattering = [1, 2, 3]
scattering_anisotropy = 0.7
[material.wax]
type = "glass"
subsurface_color = [0.9, 0.5, 0.2]
subsurface_radius = 0.1)");
    EXPECT_EQ(s.materials.at(0).scattering, (Color{1, 2, 3}));
    EXPECT_EQ(s.materials.at(0).scattering_anisotropy, 0.7f);
    EXPECT_FALSE(s.materials.at(0).subsurface_color);
    EXPECT_EQ(s.materials.at(1).subsurface_color, (Color{0.9f, 0.5f, 0.2f}));
    EXPECT_EQ(s.materials.at(1).subsurface_radius, (Color{0.1f, 0.1f, 0.1f}));
    EXPECT_NE(problems("[material.a]\ntype = \"glass\"\nscattering_anisotropy = 1"), "");
    EXPECT_NE(problems("[material.a]\ntype = \"glass\"\nsubsurface_radius = 0"), "");
    EXPECT_NE(problems("[material.a]\nscattering = 1"), "");
}

}  // namespace
}  // namespace lancer
