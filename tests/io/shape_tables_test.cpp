// [[plane]] with axes and bands, [[water]], [[bubble]], [[triangle]], [[pyramid]], and textures that are formulas.
#include "io/scene/shape_tables.h"

#include <gtest/gtest.h>

#include "scene_test_support.h"

namespace lancer {
namespace {

using Part = SphereDescription::Part;

class ShapeTables : public SceneFileTest {
protected:
    void check(const std::vector<std::pair<const char*, const char*>>& mistakes)
    {
        for (const auto& [text, message] : mistakes)
            EXPECT_EQ(problems(text), "s.toml:" + std::string(message)) << text;
    }
};

TEST_F(ShapeTables, EveryKeyOfPlane)
{
    const SceneDescription s = scene(R"(
[[plane]]
point = [1, 2, 3]
u = [5, 0, 0]
v = [0, 0, -4]
material = "white"
band_material = "black"
band_width = 0.25
[[plane]]
u = [0, 2, 0]
v = [0, 0, 4]
normal = [3, 0, 0]
band_material = "black"
[[plane]]
[material.white]
[material.black])");
    ASSERT_EQ(s.planes.size(), 3u);
    const PlaneDescription &floor = s.planes[0], &wall = s.planes[1];
    EXPECT_EQ(floor.normal, (Vec3d{0, 1, 0}));
    ASSERT_TRUE(floor.axes && floor.bands && wall.axes && wall.bands);
    EXPECT_EQ((*floor.axes)[0], (Vec3d{5, 0, 0}));
    EXPECT_EQ((*floor.axes)[1], (Vec3d{0, 0, -4}));
    EXPECT_EQ(floor.material, "white");
    EXPECT_EQ(floor.bands->material, "black");
    EXPECT_EQ(floor.bands->width, 0.25f);
    EXPECT_FALSE(floor.is_water);
    EXPECT_EQ(wall.normal, (Vec3d{1, 0, 0}));
    EXPECT_EQ(wall.bands->width, 0.05f);
    EXPECT_EQ(wall.material, "");
    EXPECT_FALSE(s.planes[2].axes || s.planes[2].bands);
}

TEST_F(ShapeTables, Water)
{
    const SceneDescription s = scene(R"(
[[water]]
point = [1, 2, 3]
normal = [0, 0, 2]
material = "sea"
waves = [[0.5, 1, 2, -3], [1, 0, 10, 0]]
[[water]]
u = [2, 0, 0]
v = [0, 0, -2]
[material.sea])");
    ASSERT_EQ(s.planes.size(), 2u);
    EXPECT_TRUE(s.planes[0].is_water && s.planes[1].is_water);
    EXPECT_EQ(s.planes[0].waves, (std::vector<Wave>{{0.5, 1, 2, -3}, {1, 0, 10, 0}}));
    EXPECT_EQ(s.planes[0].material, "sea");
    EXPECT_EQ(s.planes[0].axes.value(), (std::array<Vec3d, 2>{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}}));
    EXPECT_EQ(s.planes[1].axes.value()[1], (Vec3d{0, 0, -2}));
    EXPECT_TRUE(s.planes[1].waves.empty());
}

TEST_F(ShapeTables, ABubbleIsTwoSpheres)
{
    const SceneDescription s = scene(
        "[[bubble]]\ncenter = [1, 2, 3]\nradius = 2\nthickness = 0.5\nmaterial = \"glass\"\n"
        "[[bubble]]\nmaterial = \"glass\"\n[material.glass]\ntype = \"glass\"");
    ASSERT_EQ(s.spheres.size(), 4u);
    EXPECT_EQ(s.spheres[0].radius, 2);
    EXPECT_EQ(s.spheres[1].radius, 1.5);
    EXPECT_EQ(s.spheres[3].radius, 1 - 0.02);
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(s.spheres[i].part, i % 2 ? Part::inside_of_bubble : Part::bubble);
        EXPECT_EQ(s.spheres[i].center, i < 2 ? (Vec3d{1, 2, 3}) : Vec3d{});
        EXPECT_EQ(s.spheres[i].material, "glass");
        EXPECT_EQ(s.spheres[i].where.line, i < 2 ? 1u : 6u);
    }
}

TEST_F(ShapeTables, TrianglesAndPyramidsComeAfterTheMeshes)
{
    write("a.obj", "");
    const SceneDescription s = scene(R"(
[[pyramid]]
center = [1, 0, 0]
side = 2
up = "z"
band_material = "black"
[[triangle]]
a = [0, 0, 0]
b = [1, 0, 0]
c = [0, 1, 0]
material = "black"
[[mesh]]
file = "a.obj"
[[pyramid]]
[material.black])");
    ASSERT_EQ(s.meshes.size(), 4u);
    EXPECT_EQ(s.meshes[0].data->file, path("a.obj"));
    EXPECT_EQ(s.meshes[1].data->shape, "triangle");
    EXPECT_EQ(s.meshes[1].where.line, 7u);
    EXPECT_EQ(s.meshes[1].data->positions, (std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(s.meshes[1].material, "black");
    EXPECT_EQ(s.meshes[2].data->shape, "pyramid");
    EXPECT_EQ(s.meshes[2].bands.value().material, "black");
    EXPECT_EQ(s.meshes[2].data->positions[4], (Vec3d{1, 0, std::sqrt(0.5) * 2}));
    EXPECT_EQ(s.meshes[3].data->positions[4], (Vec3d{0, std::sqrt(0.5), 0}));
    EXPECT_EQ(loaded_, std::vector<std::string>{"a.obj"});
}

TEST_F(ShapeTables, TexturesThatAreFormulas)
{
    const SceneDescription s = scene(R"(
[material.tiles]
texture = "tiles"
bump_texture = { type = "waves", waves = [[0.1, 0, 1, 0]], scale = 2 }
[material.half]
type = "mix"
first = "tiles"
second = "tiles"
weight_texture = { type = "grid" }
[texture.tiles]
type = "grid"
band = 0.25
ground = [1, 0.5, 0]
width = 0.125
offset = [0.5, 0])");
    const MaterialDescription &tiles = s.materials.at(0), &half = s.materials.at(1);
    ASSERT_TRUE(tiles.base_color_map && tiles.bump_map && half.weight_map);
    EXPECT_EQ(tiles.base_color_map->type, TextureType::grid);
    EXPECT_EQ(tiles.base_color_map->band, (Color{0.25f, 0.25f, 0.25f}));
    EXPECT_EQ(tiles.base_color_map->ground, (Color{1, 0.5f, 0}));
    EXPECT_EQ(tiles.base_color_map->band_width, 0.125f);
    EXPECT_EQ(tiles.base_color_map->use.offset, (Vec2{0.5f, 0}));
    EXPECT_EQ(tiles.bump_map->type, TextureType::waves);
    EXPECT_EQ(tiles.bump_map->waves, (std::vector<Wave>{{0.1, 0, 1, 0}}));
    EXPECT_EQ(tiles.bump_map->use.scale, (Vec2{2, 2}));
    EXPECT_EQ(half.weight_map->band, (Color{1, 1, 1}));
    EXPECT_EQ(half.weight_map->ground, Color{});
    EXPECT_EQ(half.weight_map->band_width, 0.05f);
}

TEST_F(ShapeTables, MistakesOfPlanes)
{
    check(
        {{"[[plane]]\nu = [1, 0, 0]", "2:5: error: 'u' in [[plane]] needs 'v'"},
         {"[[plane]]\nu = [1, 0, 0]\nv = [-2, 0, 0]", "3:5: error: 'v' in [[plane]] must not be parallel to 'u'"},
         {"[[plane]]\nu = [0, 0, 0]\nv = [-2, 0, 0]", "2:5: error: 'u' in [[plane]] must not be the zero vector"},
         {"[[plane]]\nu = [1, 0, 0]\nv = [0, 0, 1]\nnormal = [0, 1, 0]",
          "4:10: error: 'normal' in [[plane]] must be the direction of u x v, or not be given"},
         {"[[plane]]\nband_width = 0.5", "2:14: error: 'band_width' in [[plane]] needs 'band_material'"},
         {"[[plane]]\nband_material = \"a\"",
          "2:17: error: unknown material 'a'; known: white_plastic, red_plastic, bronze, "
          "emerald, glass, black_matter, sand, mirror, blue_water, grey_matter, steel, ruby, grey_metallic"},
         {"[[plane]]\nband_material = \"a\"\nband_width = 1.5\n[material.a]",
          "3:14: error: 'band_width' in [[plane]] must be from 0 to 1, not 1.5"},
         {"[[water]]\nwaves = []",
          "2:9: error: 'waves' in [[water]] must be a list of [amplitude, direction, length, phase], not empty"},
         {"[[water]]\nwaves = [[1, 2, 3, 4], [1, 2, 3]]",
          "2:24: error: 'waves' in [[water]] must be a list of [amplitude, direction, length, phase]: four numbers "
          "each, not 3"},
         {"[[water]]\nwaves = [[1, 2, 0, 4]]", "2:9: error: 'waves' in [[water]] must have lengths greater than 0"},
         {"[[water]]\nwaves = [[1, \"2\", 1, 4]]", "2:14: error: 'waves' in [[water]] must be a number, not a string"},
         {"[[water]]\nband_width = 0.5",
          "2:1: error: unknown key 'band_width' in [[water]]; known: point, normal, u, v, material, waves"}});
}

TEST_F(ShapeTables, MistakesOfOtherShapes)
{
    check({{"[[bubble]]", "1:1: error: [[bubble]] needs 'material'"},
           {"[[bubble]]\nmaterial = \"a\"\nthickness = 1\n[material.a]",
            "3:13: error: 'thickness' in [[bubble]] must be less than the radius"},
           {"[[bubble]]\nmaterial = \"a\"\nradius = 0.01\n[material.a]",
            "3:10: error: 'radius' in [[bubble]] must be greater than 'thickness', which is 0.02"},
           {"[[triangle]]\na = [0, 0, 0]\nb = [1, 0, 0]", "1:1: error: [[triangle]] needs 'c'"},
           {"[[triangle]]\na = [0, 0, 0]\nb = [1, 1, 0]\nc = [-2, -2, 0]",
            "4:5: error: 'c' in [[triangle]]: the three corners must not lie on one line"},
           {"[[pyramid]]\nside = 0", "2:8: error: 'side' in [[pyramid]] must be greater than 0, not 0"},
           {"[[pyramid]]\nup = \"x\"", "2:6: error: unknown up 'x' in [[pyramid]]; known: y, z"},
           {"[[pyramid]]\nup = [0, 0, 0]", "2:6: error: 'up' in [[pyramid]] must not be the zero vector"}});
}

TEST_F(ShapeTables, MistakesOfTextures)
{
    check({{"[texture.a]\ntype = \"waves\"", "1:1: error: [texture.a] of type 'waves' needs 'waves'"},
           {"[material.a]\ntexture = { type = \"waves\", waves = [[1, 2, 3, 4]] }",
            "2:11: error: 'texture' in [material.a] must not be waves: they are heights, for 'bump_texture' alone"},
           {"[material.a]\nbump_texture = { type = \"grid\" }",
            "2:16: error: 'bump_texture' in [material.a] must be a picture: the bands of a grid have no slopes"},
           {"[material.a]\ntexture = { type = \"grid\", wdth = 1 }",
            "2:28: error: unknown key 'wdth' in 'texture' in [material.a]; did you mean 'width'? known: type, scale, "
            "offset, file, encoding, wrap, channel, gain, bias, uv_set, even, odd, band, ground, width, waves"},
           {"[material.a]\ntexture = { type = \"grid\", even = 1 }",
            "2:35: error: 'even' in 'texture' in [material.a] needs type 'checker', not 'grid'"}});
}

}  // namespace
}  // namespace lancer
