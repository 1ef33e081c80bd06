// The table [background]: what its keys become, and what is refused.
#include <gtest/gtest.h>

#include "io/scene_test_support.h"

namespace lancer {
namespace {

class BackgroundTables : public SceneFileTest {
protected:
    BackgroundTables() { write("sky.png", ""), write("ground.png", ""); }
    BackgroundDescription background(const std::string& text) const
    {
        const SceneDescription s = scene("[background]\n" + text);
        EXPECT_TRUE(s.background);
        return s.background.value_or(BackgroundDescription{});
    }
};

TEST_F(BackgroundTables, NoneUnlessSaid) { EXPECT_FALSE(scene("version = 1").background); }

TEST_F(BackgroundTables, SkiesByNameAndColour)
{
    using S = SkyType;
    const std::vector<std::pair<std::string, S>> names{
        {"gradient", S::gradient}, {"night", S::night}, {"dawn", S::dawn}, {"dusk", S::dusk}, {"noon", S::noon}};
    for (const auto& [name, type] : names) EXPECT_EQ(background("sky = \"" + name + "\"").sky, type) << name;
    EXPECT_EQ(background("").sky, S::color);
    EXPECT_EQ(background("").sky_color, Color{});
    EXPECT_EQ(background("sky = [1, 2, 3]").sky_color, (Color{1, 2, 3}));
    const BackgroundDescription b =
        background("sky = \"dawn\"\nground = \"checker\"\nfade = 0.5\nup = \"z\"\nstrength = 2\nglow = true");
    EXPECT_EQ(b.ground, GroundType::checker);
    EXPECT_EQ(b.fade, (Color{0.5f, 0.5f, 0.5f}));
    EXPECT_TRUE(b.z_up);
    EXPECT_EQ(b.strength, 2);
    EXPECT_TRUE(b.glow);
    EXPECT_EQ(background("ground = 0.5").ground, GroundType::color);
    EXPECT_EQ(background("").ground, GroundType::none);
}

TEST_F(BackgroundTables, Pictures)
{
    const std::vector<std::pair<std::string, Projection>> names{
        {"latlong", Projection::latlong},         {"lachaud", Projection::lachaud},
        {"equidistant", Projection::equidistant}, {"orthographic", Projection::orthographic},
        {"equisolid", Projection::equisolid},     {"planar", Projection::planar}};
    for (const auto& [name, projection] : names) {
        const auto b =
            background("ground = {file = \"ground.png\", projection = \"" + name + "\", rotate = 20, scale = 3}");
        EXPECT_EQ(b.ground, GroundType::picture) << name;
        EXPECT_EQ(b.ground_picture.projection, projection) << name;
        EXPECT_EQ(b.ground_picture.rotate_deg, 20);
        EXPECT_EQ(b.ground_picture.scale, (Color{3, 3, 3}));
        EXPECT_EQ(b.ground_picture.margin, projection == Projection::lachaud ? 15 : 0);
    }
    const auto b =
        background("[background.sky]\nfile = \"sky.png\"\nprojection = \"equisolid\"\nfov = 220\nmargin = 4");
    EXPECT_EQ(b.sky, SkyType::picture);
    EXPECT_EQ(b.sky_picture.fov_deg, 220);
    EXPECT_EQ(b.sky_picture.margin, 4);
    EXPECT_EQ(without_folder(b.sky_picture.file), "sky.png");
    EXPECT_EQ(b.sky_picture.where.line, 2u);
    EXPECT_EQ(background("ground = {file = \"ground.png\", projection = \"planar\", size = 5}").ground_picture.size, 5);
}

TEST_F(BackgroundTables, Mistakes)
{
    const std::vector<std::pair<std::string, std::string>> cases{
        {"sky = \"down\"",
         "2:7: error: unknown sky 'down' in [background]; did you mean 'dawn'? known: gradient, night, dawn, dusk, "
         "noon"},
        {"sky = true", "2:7: error: 'sky' in [background] must be one number or three, not a boolean"},
        {"sky = [0, -1, 0]", "2:11: error: 'sky' in [background] must be from 0 to 3.4e38, not -1"},
        {"ground = \"grass\"", "2:10: error: unknown ground 'grass' in [background]; known: checker"},
        {"up = \"x\"", "2:6: error: unknown up 'x' in [background]; known: y, z"},
        {"fade = 1", "2:8: error: 'fade' in [background] needs a ground that is a checker or a planar picture"},
        {"skye = 1",
         "2:1: error: unknown key 'skye' in [background]; did you mean 'sky'? known: sky, ground, fade, up, strength, "
         "glow, group"},
        {"sky = {projection = \"lachaud\"}", "2:7: error: [background.sky] needs 'file'"},
        {"sky = {file = \"sly.png\"}", "2:15: error: picture 'sly.png' does not exist"},
        {"sky = {file = \"sky.png\", projection = \"planar\"}",
         "2:39: error: unknown projection 'planar' in [background.sky]; known: latlong, lachaud, equidistant, "
         "orthographic, equisolid"},
        {"sky = {file = \"sky.png\", fov = 90}",
         "2:32: error: 'fov' in [background.sky] needs the projection 'equidistant', 'orthographic' or 'equisolid'"},
        {"sky = {file = \"sky.png\", projection = \"lachaud\", fov = 90}",
         "2:56: error: 'fov' in [background.sky] needs the projection 'equidistant', 'orthographic' or 'equisolid'"},
        {"sky = {file = \"sky.png\", margin = 3}",
         "2:35: error: 'margin' in [background.sky] needs the projection of a fish-eye"},
        {"ground = {file = \"sky.png\", size = 3}",
         "2:36: error: 'size' in [background.ground] needs the projection 'planar'"},
        {"sky = {file = \"sky.png\", projection = \"orthographic\", fov = 181}",
         "2:61: error: 'fov' in [background.sky] must be at most 180 with the projection 'orthographic'"}};
    for (const auto& [text, message] : cases) EXPECT_EQ(problems("[background]\n" + text), "s.toml:" + message) << text;
}

}  // namespace
}  // namespace lancer
