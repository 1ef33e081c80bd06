// From pictures to the textures of a scene, and what happens without the pictures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <map>

#include "materials/material.h"
#include "scene/build/scene_builder.h"
#include "support/scenes/scenes.h"

namespace lancer {
namespace {

using testing::ElementsAre;

TextureDescription picture(const std::string& file, uint32_t line, Channel channel = Channel::color)
{
    TextureDescription t;
    t.where = {"s.toml", line, 3};
    t.file = file;
    t.use.channel = channel;
    return t;
}

// Grey pictures of 2 x 2 with alpha, by name, of 0.2 and 0.4 in the mean; "broken" and what is not listed cannot be
// read.
class Pictures {
public:
    RasterSource source()
    {
        return [this](const std::string& file) {
            std::promise<std::shared_ptr<const Raster>> promise;
            if (file == "broken.png") {
                promise.set_exception(
                    std::make_exception_ptr(Error(ErrorKind::invalid_input, {file, 0, 0}, "the file ends too early")));
            } else {
                auto& raster = kept_[file];
                std::shared_ptr<const Raster> shared = raster.lock();
                if (!shared) {
                    const bool is_bad = file == "nan.exr";
                    Raster r = {.width = 2, .height = 2, .channels = 2, .bytes = {}, .floats = {}, .is_float = is_bad};
                    if (is_bad) r.floats = {std::numeric_limits<float>::quiet_NaN(), 1, 1, 1, 1, 1, 1, 1};
                    if (!is_bad) r.bytes = {50, 101, 52, 103, 51, 102, 51, 102};
                    shared = std::make_shared<const Raster>(std::move(r));
                    raster = shared;
                }
                promise.set_value(shared);
            }
            return promise.get_future().share();
        };
    }
    bool is_kept(const std::string& file) const { return !kept_.at(file).expired(); }

private:
    std::map<std::string, std::weak_ptr<const Raster>> kept_;
};

SceneDescription scene_of(std::vector<MaterialDescription> materials)
{
    SceneDescription d;
    d.file = "s.toml";
    d.materials = std::move(materials);
    d.materials.push_back(make_emitter("lamp", {1, 2, 3}));
    for (size_t i = 0; i < d.materials.size(); ++i)
        d.spheres.push_back(sphere_of({3.0 * static_cast<double>(i), 0, 0}, 1, d.materials[i].name, {"s.toml", 9, 1}));
    return d;
}

std::vector<std::string> warnings(const Diagnostics& diagnostics)
{
    std::vector<std::string> all;
    for (const auto& w : diagnostics.warnings()) all.push_back(to_string(w));
    return all;
}

Color color_of(const Scene& scene, uint32_t texture)
{
    return ShadingPoint{.textures = scene.textures.data()}.eval(texture);
}

TEST(TextureTable, OnePictureServesManyUsesAndIsThenFreed)
{
    MaterialDescription chalk = make_lambert("chalk", {1, 1, 1});
    chalk.base_color_map = picture("wall.png", 1);
    chalk.base_color_map->use.encoding = Encoding::linear;
    chalk.opacity_map = picture("wall.png", 2, Channel::alpha);
    Pictures pictures;
    Diagnostics diagnostics;
    SceneBuilder builder = Scene::begin(scene_of({chalk}), {}, diagnostics, pictures.source());
    EXPECT_TRUE(pictures.is_kept("wall.png"));
    ASSERT_EQ(builder.unfinished().textures.size(), 2u);
    EXPECT_EQ(color_of(builder.unfinished(), 0), (Color{1, 1, 1}));  // until it has arrived
    const std::unique_ptr<const Scene> finished = builder.finish(diagnostics);
    const Scene& scene = *finished;
    EXPECT_FALSE(pictures.is_kept("wall.png"));
    const uint32_t material = scene.sphere_material[0];
    EXPECT_FLOAT_EQ(color_of(scene, std::get<Lambert>(scene.materials[material]).albedo.texture).g, 0.2f);
    EXPECT_FLOAT_EQ(color_of(scene, scene.traits[material].opacity.texture).g, 0.4f);
    EXPECT_THAT(warnings(diagnostics), ElementsAre());
}

TEST(TextureTable, ABrokenPictureIsNamedOnceAndItsTexturesAreOne)
{
    MaterialDescription a = make_lambert("a", {1, 1, 1}), b = make_lambert("b", {1, 1, 1});
    a.base_color_map = picture("broken.png", 4);
    b.base_color_map = picture("broken.png", 5, Channel::red);
    b.opacity_map = picture("broken.png", 6, Channel::alpha);
    Pictures pictures;
    Diagnostics diagnostics;
    const Scene scene = Scene::build(scene_of({a, b}), {}, diagnostics, pictures.source());
    ASSERT_EQ(scene.textures.size(), 3u);
    for (uint32_t i = 0; i < 3; ++i) EXPECT_EQ(color_of(scene, i), (Color{1, 1, 1}));
    EXPECT_THAT(warnings(diagnostics),
                ElementsAre("s.toml:4:3: warning: picture 'broken.png' is not used: the file ends too early; 1 is used "
                            "instead (3 times)"));
}

TEST(TextureTable, ABrokenPictureGivesNoBumps)
{
    MaterialDescription a = make_lambert("a", {1, 1, 1});
    a.bump_map = picture("broken.png", 4, Channel::red);
    a.normal_map = picture("wall.png", 5);
    Pictures pictures;
    {
        Diagnostics diagnostics;
        const Scene scene = Scene::build(scene_of({a}), {}, diagnostics, pictures.source());
        const MaterialTraits& traits = scene.traits[scene.sphere_material[0]];
        EXPECT_EQ(traits.bump, no_texture);
        EXPECT_NE(traits.normal_map, no_texture);
        EXPECT_THAT(warnings(diagnostics),
                    ElementsAre("s.toml:4:3: warning: picture 'broken.png' is not used: the file "
                                "ends too early; surfaces have no bumps instead"));
    }
    a.base_color_map = picture("broken.png", 7);
    Diagnostics diagnostics;
    const Scene scene = Scene::build(scene_of({a}), {}, diagnostics, pictures.source());
    ASSERT_EQ(diagnostics.warnings().size(), 1u);
    EXPECT_THAT(warnings(diagnostics)[0], testing::HasSubstr("1 is used instead, and no bumps (2 times)"));
}

// Exporters name maps of normals as heights.
TEST(TextureTable, HeightsThatLookLikeNormalsBecomeNormals)
{
    for (const bool may_be : {true, false})
        for (const char* file : {"tilted normals", "flat normals", "waves", "colours"}) {
            MaterialDescription a = make_lambert("a", {1, 1, 1});
            a.bump_map = picture(file, 4, Channel::red);
            a.bump_map->may_be_normals = may_be;
            a.bump_map->use.encoding = Encoding::linear;
            a.roughness_map = picture(file, 5, Channel::red);
            Diagnostics diagnostics;
            const Scene scene = Scene::build(scene_of({a}), {}, diagnostics, test_picture);
            const MaterialTraits& traits = scene.traits[scene.sphere_material[0]];
            const bool is_constant = std::string_view(file).ends_with("normals"), is_normals = may_be && is_constant;
            EXPECT_EQ(traits.normal_map != no_texture, is_normals) << file;
            EXPECT_EQ(traits.bump == no_texture, is_constant) << file;  // which as heights are folded
            EXPECT_EQ(diagnostics.warnings().size(), is_normals ? 1u : 0u) << file;
            if (is_normals) {
                EXPECT_GT(color_of(scene, traits.normal_map).b, 0.8f) << file;
                EXPECT_THAT(warnings(diagnostics)[0], testing::HasSubstr("used as normals"));
            }
        }
}

TEST(TextureTable, WithoutASourceNothingIsReadButAllIsBuilt)
{
    MaterialDescription a = make_lambert("a", {1, 1, 1});
    a.base_color_map = picture("wall.png", 4);
    Diagnostics diagnostics;
    const Scene scene = Scene::build(scene_of({a}), {}, diagnostics);
    EXPECT_EQ(color_of(scene, 0), (Color{1, 1, 1}));
    ASSERT_EQ(diagnostics.warnings().size(), 1u);
    EXPECT_THAT(warnings(diagnostics)[0], testing::HasSubstr("'wall.png' is not used: "));
}

TEST(TextureTable, NumbersThatAreNotFiniteAreCounted)
{
    MaterialDescription a = make_lambert("a", {1, 1, 1});
    a.base_color_map = picture("nan.exr", 4);
    Pictures pictures;
    Diagnostics diagnostics;
    const Scene scene = Scene::build(scene_of({a}), {}, diagnostics, pictures.source());
    EXPECT_EQ(std::get<ImageTexture>(scene.textures[0]).mean().r, 0.75f);
    EXPECT_THAT(warnings(diagnostics), ElementsAre("s.toml:4:3: warning: numbers of picture 'nan.exr' are not finite; "
                                                   "they count as 0"));
}

}  // namespace
}  // namespace lancer
