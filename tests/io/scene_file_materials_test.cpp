// What materials, textures and overrides of a scene file mean, and what is said of wrong ones.
#include <gtest/gtest.h>

#include <sstream>

#include "materials/metal.h"
#include "scene/description/metals.h"
#include "scene/description/presets.h"
#include "scene_test_support.h"

namespace lancer {
namespace {

class SceneMaterials : public SceneFileTest {
protected:
    SceneMaterials()
    {
        for (const char* name : {"c.png", "r.png", "m.png", "o.png", "b.png", "n.png", "e.exr", "w.png", "a.obj"})
            write(name, "");
    }
    std::string file_of(const TextureUse& use) const { return use ? without_folder(use->file) : "none"; }
};

TEST_F(SceneMaterials, MeasuredMetalsHaveTheirIndices)
{
    const SceneDescription s = scene(R"(
[material.a]
type = "metal"
metal = "Au"
[material.b]
type = "metal"
metal = "gold"
base_color = 0.5
[material.c]
type = "metal"
metal = "brass"
roughness = 0.5
[[material_override]]
match = "x"
type = "metal"
metal = "Ag"
)");
    ASSERT_EQ(s.materials.size(), 3u);
    EXPECT_EQ(s.materials[0].eta, (Color{0.0588f, 0.491f, 1.483f}));
    EXPECT_EQ(s.materials[0].k, (Color{3.613f, 2.24f, 1.781f}));
    EXPECT_EQ(s.materials[0].base_color, (Color{1, 1, 1}));
    EXPECT_EQ(s.materials[1].eta, s.materials[0].eta);
    EXPECT_EQ(s.materials[1].base_color, (Color{0.5f, 0.5f, 0.5f}));
    EXPECT_EQ(s.materials[2].roughness, 0.5f);
    EXPECT_EQ(s.overrides.at(0).change({}).eta, find_metal("silver")->eta);
    const auto of = [&](const std::string& keys) { return problems("[material.a]\n" + keys + "\n"); };
    EXPECT_NE(of("type = \"metal\"\nmetal = \"Agg\"").find("unknown metal 'Agg'; did you mean 'Ag'?"),
              std::string::npos);
    EXPECT_NE(of("type = \"metal\"\nmetal = \"Ag\"\neta = 1\nk = 1").find("is given by 'metal'"), std::string::npos);
    EXPECT_NE(of("metal = \"Ag\"").find("metal"), std::string::npos);
}

// What docs/scene-format.md says that they reflect from the front: the spectra's colours, to 0.001.
TEST_F(SceneMaterials, MeasuredMetalsReflectWhatTheirSpectraDo)
{
    const std::vector<std::pair<std::string_view, Color>> expected{
        {"Ag", {0.9894f, 0.9839f, 0.9779f}}, {"Al", {0.9061f, 0.9161f, 0.9225f}},   {"Au", {0.9834f, 0.7286f, 0.3645f}},
        {"Cr", {0.5496f, 0.5560f, 0.5543f}}, {"Cu", {0.9317f, 0.6226f, 0.5224f}},   {"Fe", {0.5297f, 0.5132f, 0.4942f}},
        {"Ni", {0.6971f, 0.6405f, 0.5633f}}, {"Pt", {0.6779f, 0.6377f, 0.5837f}},   {"Ti", {0.6186f, 0.5794f, 0.5425f}},
        {"W", {0.5159f, 0.4963f, 0.4674f}},  {"brass", {0.9097f, 0.7784f, 0.4225f}}};
    for (const auto& [name, color] : expected) {
        const MeasuredMetal metal = find_metal(name).value();
        const Color found = make_conductor(metal.eta, metal.k).normal;
        EXPECT_NEAR(found.r, color.r, 1e-3f) << name;
        EXPECT_NEAR(found.g, color.g, 1e-3f) << name;
        EXPECT_NEAR(found.b, color.b, 1e-3f) << name;
    }
    EXPECT_EQ(names_of_metals().size(), 2 * expected.size() - 1);
}

TEST_F(SceneMaterials, DisplacementAndSetsOfCoordinatesAreRead)
{
    const SceneDescription s = scene(R"(
[[mesh]]
file = "a.obj"
material = "a"
subdivision_edge = 2.5
subdivision_level = 6
[[mesh]]
file = "a.obj"
subdivision_level = 3
[[mesh]]
file = "a.obj"
[material.a]
displacement_texture = "b.png"
displacement_scale = -0.25
displacement_midlevel = 0.5
texture = { file = "c.png", uv_set = 1 }
)");
    const MaterialDescription& m = s.materials.at(0);
    EXPECT_EQ(file_of(m.displacement_map), "b.png");
    EXPECT_EQ(m.displacement_scale, -0.25f);
    EXPECT_EQ(m.displacement_midlevel, 0.5f);
    EXPECT_TRUE(m.base_color_map->use.by_second_uv);
    EXPECT_FALSE(m.displacement_map->use.by_second_uv);
    EXPECT_EQ(s.meshes[0].subdivision.edge_pixels, 2.5);
    EXPECT_EQ(s.meshes[0].subdivision.level, 6u);
    EXPECT_EQ(s.meshes[1].subdivision.edge_pixels, 0) << "a level alone is that of all triangles";
    EXPECT_EQ(s.meshes[1].subdivision.level, 3u);
    EXPECT_FALSE(s.meshes[2].subdivision.is_asked);
    EXPECT_NE(problems("[material.a]\ndisplacement_texture = { type = \"checker\" }\n").find("must be a picture"),
              std::string::npos);
    EXPECT_NE(problems("[[mesh]]\nfile = \"a.obj\"\nsubdivision_level = 13\n").find("subdivision_level"),
              std::string::npos);
    EXPECT_NE(problems("[[mesh]]\nfile = \"a.obj\"\nsubdivision_edge = 0\n").find("greater than 0"), std::string::npos);
}

TEST_F(SceneMaterials, EveryKeyIsRead)
{
    const SceneDescription s = scene(R"(
[material.a]
type = "plastic"
base_color = [0.1, 0.2, 0.3]
texture = "c.png"
roughness = 0.25
roughness_texture = "r.png"
metallic = 0.5
metallic_texture = "m.png"
ior = 1.4
specular = [0.7, 0.8, 0.9]
opacity = 0.75
opacity_texture = "o.png"
bump_texture = "b.png"
bump_scale = -2
normal_texture = "n.png"
emission = 3
emission_texture = "e.exr"
emission_sides = "both"
[material.b]
type = "metal"
eta = [0.2, 0.9, 1.1]
k = [3.9, 2.4, 2.2]
[material.c]
type = "mix"
first = "a"
second = "b"
weight = 0.125
weight_texture = "w.png"
[material.d]
type = "glass"
thin = true
[material.e]
type = "glass"
thin = false
[material.f]
type = "glass"
[material.g]
type = "translucent"
texture = "c.png"
transmittance = [0.3, 0.2, 0.1]
transmittance_texture = "r.png"
[material.h]
type = "translucent"
transmittance_texture = "r.png")");
    const MaterialDescription &g = s.materials.at(6), &h = s.materials.at(7);
    EXPECT_EQ(g.type, MaterialType::translucent);
    EXPECT_EQ(g.base_color, (Color{1, 1, 1})) << "a texture alone is not dimmed";
    EXPECT_EQ(g.transmittance, (Color{0.3f, 0.2f, 0.1f}));
    EXPECT_EQ(file_of(g.transmittance_map), "r.png");
    EXPECT_EQ(h.base_color, (Color{0.4f, 0.4f, 0.4f}));
    EXPECT_EQ(h.transmittance, (Color{1, 1, 1}));
    EXPECT_EQ(s.materials.at(3).thin, true);
    EXPECT_EQ(s.materials.at(4).thin, false);
    EXPECT_FALSE(s.materials.at(5).thin.has_value()) << "the shape decides";
    const MaterialDescription &a = s.materials.at(0), &b = s.materials.at(1), &c = s.materials.at(2);
    EXPECT_EQ(a.type, MaterialType::plastic);
    EXPECT_EQ(a.base_color, (Color{0.1f, 0.2f, 0.3f}));
    EXPECT_EQ(file_of(a.base_color_map), "c.png");
    EXPECT_EQ(a.roughness, 0.25f);
    EXPECT_EQ(file_of(a.roughness_map), "r.png");
    EXPECT_EQ(a.metallic, 0.5f);
    EXPECT_EQ(file_of(a.metallic_map), "m.png");
    EXPECT_EQ(a.ior, 1.4f);
    EXPECT_EQ(a.specular, (Color{0.7f, 0.8f, 0.9f}));
    EXPECT_EQ(a.opacity, 0.75f);
    EXPECT_EQ(file_of(a.opacity_map), "o.png");
    EXPECT_EQ(file_of(a.bump_map), "b.png");
    EXPECT_EQ(a.bump_scale, -2);
    EXPECT_EQ(file_of(a.normal_map), "n.png");
    EXPECT_EQ(a.emission, (Color{3, 3, 3}));
    EXPECT_EQ(file_of(a.emission_map), "e.exr");
    EXPECT_TRUE(a.emission_both_sides);
    EXPECT_EQ(b.type, MaterialType::metal);
    EXPECT_EQ(b.eta, (Color{0.2f, 0.9f, 1.1f}));
    EXPECT_EQ(b.k, (Color{3.9f, 2.4f, 2.2f}));
    EXPECT_EQ(b.base_color, (Color{1, 1, 1})) << "only a tint beside eta and k";
    EXPECT_EQ(c.type, MaterialType::mix);
    EXPECT_EQ(c.first, "a");
    EXPECT_EQ(c.second, "b");
    EXPECT_EQ(c.weight, 0.125f);
    EXPECT_EQ(file_of(c.weight_map), "w.png");
}

TEST_F(SceneMaterials, EveryKeyOfInterfacesIsRead)
{
    const SceneDescription s = scene(R"(
[material.a]
type = "interface"
ambient = [0.1, 0.2, 4]
base_color = [0.2, 0.3, 0.4]
specular = [0.7, 0.8, 0.9]
shininess = 50
diffusion = 0.25
reflexion = 0.5
refraction = 0.75
ior = 1.4
outside_ior = 1.2
opacity = 0.5
emission = 3
[material.b]
type = "interface")");
    const MaterialDescription &a = s.materials.at(0), &b = s.materials.at(1);
    EXPECT_EQ(a.type, MaterialType::interface);
    EXPECT_EQ(a.base_color, (Color{0.2f, 0.3f, 0.4f}));
    EXPECT_EQ(a.phong.ambient, (Color{0.1f, 0.2f, 4}));
    EXPECT_EQ(a.phong.specular, (Color{0.7f, 0.8f, 0.9f}));
    EXPECT_EQ(a.phong.shininess, 50);
    EXPECT_EQ(a.phong.diffusion, 0.25f);
    EXPECT_EQ(a.phong.reflexion, 0.5f);
    EXPECT_EQ(a.phong.refraction, 0.75f);
    EXPECT_EQ(a.phong.inside_ior, 1.4f);
    EXPECT_EQ(a.phong.outside_ior, 1.2f);
    EXPECT_EQ(a.opacity, 0.5f);
    EXPECT_EQ(a.emission, (Color{3, 3, 3}));
    EXPECT_EQ(b.base_color, (Color{0.8f, 0.8f, 0.8f}));
    EXPECT_TRUE(is_black(b.phong.specular) && is_black(b.phong.ambient));
    EXPECT_EQ(b.phong.diffusion, 1);
    EXPECT_EQ(b.phong.reflexion, 0);
    EXPECT_EQ(b.phong.refraction, 0);
    EXPECT_EQ(b.phong.inside_ior, 1.5f);
    EXPECT_EQ(b.phong.outside_ior, 1);
}

TEST_F(SceneMaterials, APresetIsKnownByNameAndCanBeChanged)
{
    const SceneDescription s = scene(R"(
[[sphere]]
material = "bronze"
[[plane]]
material = "old_bronze"
[material.old_bronze]
preset = "bronze"
shininess = 5
[material.wood]
preset = "sand"
texture = "c.png"
[material.both]
type = "mix"
first = "ruby"
second = "wood"
[[material_override]]
match = "*"
material = "steel")");
    EXPECT_EQ(s.spheres.at(0).material, "bronze");
    const MaterialDescription &old = s.materials.at(0), &wood = s.materials.at(1);
    EXPECT_EQ(old.name, "old_bronze");
    EXPECT_EQ(old.type, MaterialType::interface);
    EXPECT_EQ(old.where.line, 6u);
    EXPECT_EQ(old.base_color, (Color{0.714f, 0.4284f, 0.18144f}));
    EXPECT_EQ(old.phong.reflexion, 0.75f);
    EXPECT_EQ(old.phong.specular, (Color{0.9f, 0.8f, 0.7f}));
    EXPECT_EQ(old.phong.shininess, 5);
    EXPECT_EQ(wood.base_color, (Color{1, 1, 1})) << "a texture takes the place of the colour";
    EXPECT_EQ(wood.phong.shininess, 2);
    EXPECT_EQ(s.materials.at(2).first, "ruby");
}

// The manual's table of presets, each row read as an interface that says its numbers itself.
TEST_F(SceneMaterials, PresetsAreWhatTheManualSays)
{
    const std::vector<std::string> keys{"ambient",   "base_color", "specular",   "shininess",
                                        "diffusion", "reflexion",  "refraction", "ior"};
    std::ifstream manual(LANCER_SOURCE_DIR "/docs/scene-format.md");
    std::string text;
    std::vector<std::string> named;
    for (std::string line; std::getline(manual, line);) {
        std::vector<std::string> cells;
        for (std::istringstream row(line); std::getline(row, line, '|');) cells.push_back(line);
        if (cells.size() != keys.size() + 2 || cells[1].size() < 5) continue;
        const std::string name = cells[1].substr(2, cells[1].size() - 4);
        if (!find_preset(name)) continue;
        named.push_back(name);
        text += "[material." + name + "]\ntype = \"interface\"\n";
        for (size_t i = 0; i < keys.size(); ++i) text += keys[i] + " =" + cells[i + 2] + "\n";
    }
    ASSERT_EQ(named.size(), names_of_presets().size());
    const SceneDescription s = scene(text);
    for (size_t i = 0; i < named.size(); ++i) {
        const MaterialDescription &said = s.materials.at(i), preset = *find_preset(named[i]);
        EXPECT_EQ(said.base_color, preset.base_color) << named[i];
        EXPECT_EQ(said.phong.ambient, preset.phong.ambient) << named[i];
        EXPECT_EQ(said.phong.specular, preset.phong.specular) << named[i];
        for (const auto number : {&Phong::shininess, &Phong::diffusion, &Phong::reflexion, &Phong::refraction,
                                  &Phong::inside_ior, &Phong::outside_ior})
            EXPECT_EQ(said.phong.*number, preset.phong.*number) << named[i];
    }
}

TEST_F(SceneMaterials, WhatIsNotSaidHasTheDefaultsOfItsType)
{
    const SceneDescription s = scene(
        "[material.l]\n[material.m]\ntype = \"mirror\"\n[material.e]\ntype = \"metal\"\n[material.g]\ntype = "
        "\"glass\"\n[material.p]\ntype = \"plastic\"\n[material.x]\ntype = \"mix\"\nfirst = \"l\"\nsecond = \"g\"");
    const MaterialDescription untold;
    for (const MaterialDescription& m : s.materials) {
        const bool tints = m.type == MaterialType::mirror || m.type == MaterialType::glass;
        EXPECT_EQ(m.base_color, (tints ? Color{1, 1, 1} : untold.base_color)) << m.name;
        EXPECT_EQ(m.roughness, 0);
        EXPECT_EQ(m.opacity, 1);
        EXPECT_EQ(m.bump_scale, 1);
        EXPECT_EQ(m.ior, 1.5f);
        EXPECT_EQ(m.weight, 0.5f);
        EXPECT_EQ(m.specular, (Color{1, 1, 1}));
        EXPECT_FALSE(m.eta || m.k || m.base_color_map || m.opacity_map || m.weight_map);
        const bool is_metal = m.type == MaterialType::metal, may_be = is_metal || m.type == MaterialType::plastic;
        EXPECT_EQ(m.metallic, may_be ? std::optional(is_metal ? 1.0f : 0.0f) : std::nullopt) << m.name;
    }
}

TEST_F(SceneMaterials, MediaHaveAbsorptionAndAPriorityIfSaid)
{
    const SceneDescription s = scene(R"(
[material.water]
type = "glass"
absorption = [0.4, 0.1, 0]
priority = -2
[material.plain]
type = "glass"
[[material_override]]
match = "lake"
type = "glass"
absorption = 3
priority = 1)");
    EXPECT_EQ(s.materials.at(0).absorption, (Color{0.4f, 0.1f, 0}));
    EXPECT_EQ(s.materials.at(0).priority, -2);
    EXPECT_EQ(s.materials.at(1).absorption, Color{});
    EXPECT_FALSE(s.materials.at(1).priority);
    const MaterialDescription lake = s.overrides.at(0).change({});
    EXPECT_EQ(lake.absorption, (Color{3, 3, 3}));
    EXPECT_EQ(lake.priority, 1);
    const MaterialDescription matt =
        scene("[[material_override]]\nmatch = \"x\"\ntype = \"lambert\"").overrides.at(0).change(lake);
    EXPECT_EQ(matt.absorption, Color{});
    EXPECT_FALSE(matt.priority);
    EXPECT_NE(problems("[material.a]\ntype = \"glass\"\nabsorption = [0, -1, 0]"), "");
    EXPECT_NE(problems("[material.a]\ntype = \"glass\"\npriority = 1.5"), "");
    EXPECT_NE(problems("[material.a]\ntype = \"mirror\"\npriority = 1"), "");
}

TEST_F(SceneMaterials, ATextureIsNotDimmedByANumberThatNobodySaid)
{
    const SceneDescription s = scene(R"(
[material.a]
type = "plastic"
texture = "c.png"
roughness_texture = "r.png"
metallic_texture = "m.png"
emission_texture = "e.exr"
[material.b]
type = "mix"
first = "a"
second = "a"
weight_texture = "w.png")");
    const MaterialDescription& a = s.materials.at(0);
    EXPECT_EQ(a.base_color, (Color{1, 1, 1}));
    EXPECT_EQ(a.roughness, 1);
    EXPECT_EQ(a.metallic, 1.0f);
    EXPECT_EQ(a.emission, (Color{1, 1, 1}));
    EXPECT_EQ(s.materials.at(1).weight, 1);
}

TEST_F(SceneMaterials, AUseDecidesHowItsPictureIsRead)
{
    const MaterialDescription a =
        scene(
            "[material.a]\ntype = \"plastic\"\ntexture = \"c.png\"\nroughness_texture = \"c.png\"\nopacity_texture = "
            "\"c.png\"\nnormal_texture = \"c.png\"\nemission_texture = \"c.png\"\nbump_texture = \"c.png\"")
            .materials.at(0);
    const auto is = [](const TextureUse& use, Encoding encoding, Channel channel) {
        return use && use->use.encoding == encoding && use->use.channel == channel;
    };
    EXPECT_TRUE(is(a.base_color_map, Encoding::of_file, Channel::color));
    EXPECT_TRUE(is(a.emission_map, Encoding::of_file, Channel::color));
    EXPECT_TRUE(is(a.normal_map, Encoding::linear, Channel::color));
    EXPECT_TRUE(is(a.roughness_map, Encoding::linear, Channel::luminance));
    EXPECT_TRUE(is(a.bump_map, Encoding::linear, Channel::luminance));
    EXPECT_TRUE(is(a.opacity_map, Encoding::linear, Channel::automatic));
}

TEST_F(SceneMaterials, EveryKeyOfTexturesIsRead)
{
    const SceneDescription s = scene(R"(
[texture.wood]
file = "c.png"
encoding = "linear"
wrap = "clamp"
scale = [2, 3]
offset = 0.5
channel = "g"
gain = 2
bias = -0.25
[texture."c.png"]
type = "checker"
even = [1, 0, 0]
odd = 0.25
scale = 8
[material.a]
texture = "wood"
emission_texture = "c.png")");
    const MaterialDescription& a = s.materials.at(0);
    const TextureDescription wood = a.base_color_map.value(), checker = a.emission_map.value();
    EXPECT_EQ(wood.type, TextureType::image);
    EXPECT_EQ(without_folder(wood.file), "c.png");
    EXPECT_EQ(wood.use, (ImageUse{.encoding = Encoding::linear,
                                  .channel = Channel::green,
                                  .wrap = Wrap::clamp,
                                  .scale = {2, 3},
                                  .offset = {0.5f, 0.5f},
                                  .gain = 2,
                                  .bias = -0.25f}));
    EXPECT_EQ(checker.type, TextureType::checker) << "the name of a table comes before that of a file";
    EXPECT_EQ(checker.even, (Color{1, 0, 0}));
    EXPECT_EQ(checker.odd, (Color{0.25f, 0.25f, 0.25f}));
    EXPECT_EQ(checker.use.scale, (Vec2{8, 8}));
}

// The materials of mesh files as the first matching override makes them.
class SceneOverrides : public SceneMaterials {
protected:
    MaterialDescription changed(const std::string& text) const
    {
        const SceneDescription s = scene("[[material_override]]\nmatch = \"*\"\n" + text);
        return s.overrides.at(0).change(before);
    }
    SceneOverrides()
    {
        before.name = "x";
        before.type = MaterialType::plastic;
        before.base_color = {0.5f, 0.25f, 0};
        before.base_color_map.emplace().file = "old.png";
        before.ior = 1.7f;
        before.roughness = 0.3f;
        before.specular = {0.5f, 0.5f, 0.5f};
        before.opacity = 0.5f;
    }

    MaterialDescription before;
};

TEST_F(SceneOverrides, KeysThatAreGivenReplaceAndAllElseStays)
{
    const MaterialDescription m = changed("roughness = 0.75\nemission = 2\nnormal_texture = \"n.png\"");
    EXPECT_EQ(m.roughness, 0.75f);
    EXPECT_EQ(m.emission, (Color{2, 2, 2}));
    EXPECT_EQ(file_of(m.normal_map), "n.png");
    EXPECT_EQ(m.name, "x");
    EXPECT_EQ(m.type, MaterialType::plastic);
    EXPECT_EQ(m.base_color, before.base_color);
    EXPECT_EQ(file_of(m.base_color_map), "old.png");
    EXPECT_EQ(m.ior, 1.7f);
    EXPECT_EQ(m.specular, before.specular);
    EXPECT_EQ(m.opacity, 0.5f);
}

TEST_F(SceneOverrides, AnotherTypeBringsItsDefaultsButKeepsColourAndMaps)
{
    const MaterialDescription m = changed("type = \"glass\"\nroughness = 0.125");
    EXPECT_EQ(m.type, MaterialType::glass);
    EXPECT_EQ(m.roughness, 0.125f);
    EXPECT_EQ(m.ior, 1.5f);
    EXPECT_EQ(m.specular, (Color{1, 1, 1}));
    EXPECT_EQ(m.base_color, before.base_color);
    EXPECT_EQ(file_of(m.base_color_map), "old.png");
    EXPECT_EQ(m.opacity, 0.5f);
    EXPECT_EQ(changed("type = \"metal\"").roughness, 0);
    const MaterialDescription shiny = changed("type = \"interface\"\nspecular = 1\nreflexion = 0.5");
    EXPECT_EQ(shiny.type, MaterialType::interface);
    EXPECT_EQ(shiny.base_color, before.base_color);
    EXPECT_EQ(shiny.phong.specular, (Color{1, 1, 1}));
    EXPECT_EQ(shiny.phong.reflexion, 0.5f);
    EXPECT_EQ(shiny.phong.inside_ior, 1.5f);
}

TEST_F(SceneOverrides, AMaterialCanTakeThePlace)
{
    const SceneDescription s =
        scene("[[material_override]]\nmatch = \"glass*\"\nmaterial = \"g\"\n[material.g]\ntype = \"glass\"");
    EXPECT_EQ(s.overrides.at(0).match, "glass*");
    EXPECT_EQ(s.overrides.at(0).material, "g");
    EXPECT_EQ(s.overrides.at(0).where.line, 1u);
}

TEST_F(SceneMaterials, MistakesAreNamed)
{
    const std::vector<std::pair<const char*, const char*>> mistakes{
        {"[material.a]\nroughness = 0.5",
         "2:13: error: 'roughness' in [material.a] needs type 'metal' or 'glass' or 'plastic' or 'principled', not "
         "'lambert'"},
        {"[material.a]\ntype = \"mix\"\nfirst = \"b\"\nbase_color = 1\n[material.b]",
         "1:1: error: [material.a] of type 'mix' needs 'second'\n"
         "s.toml:4:14: error: 'base_color' in [material.a] needs type 'lambert' or 'translucent' or 'mirror' or "
         "'metal' or 'glass' or 'plastic' or 'interface' or 'principled', not 'mix'"},
        {"[material.a]\ntransmittance = 0.5",
         "2:17: error: 'transmittance' in [material.a] needs type 'translucent' or 'principled', not 'lambert'"},
        {"[material.a]\ntype = \"mix\"\nfirst = \"a\"\nsecond = \"bb\"\n[material.b]",
         "4:10: error: unknown material 'bb'; did you mean 'b'? known: a, b, white_plastic, red_plastic, bronze, "
         "emerald, glass, black_matter, sand, mirror, blue_water, grey_matter, steel, ruby, grey_metallic"},
        {"[material.a]\ntype = \"metal\"\nk = 1", "1:1: error: [material.a] of type 'metal' needs 'eta'"},
        {"[material.a]\nshininess = 5",
         "2:13: error: 'shininess' in [material.a] needs type 'interface', not 'lambert'"},
        {"[material.a]\ntype = \"interface\"\nreflexion = 0.5\nshininess = 5",
         "1:1: error: [material.a] of type 'interface' needs 'specular'"},
        {"[material.a]\ntype = \"interface\"\nshininess = -1\nspecular = 2\ndiffusion = 1.5\noutside_ior = 0",
         "3:13: error: 'shininess' in [material.a] must be from 0 to 3.4e38, not -1\n"
         "s.toml:4:12: error: 'specular' in [material.a] must be from 0 to 1, not 2\n"
         "s.toml:5:13: error: 'diffusion' in [material.a] must be from 0 to 1, not 1.5\n"
         "s.toml:6:15: error: 'outside_ior' in [material.a] must be greater than 0 and at most 3.4e38, not 0"},
        {"[material.a]\npreset = \"bronce\"",
         "2:10: error: unknown preset 'bronce'; did you mean 'bronze'? known: white_plastic, red_plastic, bronze, "
         "emerald, glass, black_matter, sand, mirror, blue_water, grey_matter, steel, ruby, grey_metallic"},
        {"[material.a]\npreset = \"bronze\"\ntype = \"metal\"",
         "2:10: error: 'preset' in [material.a] needs type 'interface', not 'metal'"},
        {"[[sphere]]\nmaterial = \"whitePlastic\"",
         "2:12: error: unknown material 'whitePlastic'; did you mean 'white_plastic'? known: white_plastic, "
         "red_plastic, bronze, emerald, glass, black_matter, sand, mirror, blue_water, grey_matter, steel, ruby, "
         "grey_metallic"},
        {"[material.a]\nopacity = 1.5", "2:11: error: 'opacity' in [material.a] must be from 0 to 1, not 1.5"},
        {"[material.a]\ntexture = \"d.png\"", "2:11: error: picture 'd.png' does not exist"},
        {"[texture.wood]\nfile = \"c.png\"\n[material.a]\ntexture = \"woood\"",
         "4:11: error: no [texture.NAME] has this name, and picture 'woood' does not exist; did you mean 'wood'? "
         "known: wood"},
        {"[material.a]\nbump_texture = \"t\"\n[texture.t]\ntype = \"checker\"",
         "2:16: error: 'bump_texture' in [material.a] must be a picture: the squares of a checker have no slopes"},
        {"[texture.a]", "1:1: error: [texture.a] of type 'image' needs 'file'"},
        {"[texture.a]\nfile = \"../c.png\"",
         "2:8: error: picture '../c.png' lies outside of the folder of the scene; --asset-root FOLDER allows another "
         "folder"},
        {"[texture.a]\ntype = \"checker\"\nfile = \"c.png\"",
         "3:8: error: 'file' in [texture.a] needs type 'image', not 'checker'"},
        {"[texture.a]\ntype = \"checker\"\nscale = [1, 2, 3]",
         "3:9: error: 'scale' in [texture.a] must be one number or two, not 3"},
        {"[texture.a]\nfile = \"c.png\"\nchannel = \"red\"",
         "3:11: error: unknown channel 'red' in [texture.a]; known: r, g, b, a, luminance, auto"},
        {"[texture.a]\nfile = \"c.png\"\nwarp = \"clamp\"",
         "3:1: error: unknown key 'warp' in [texture.a]; did you mean 'wrap'? known: type, scale, offset, file, "
         "encoding, wrap, channel, gain, bias, uv_set, even, odd, band, ground, width, waves"},
        {"[[material_override]]\nroughness = 1", "1:1: error: [[material_override]] needs 'match'"},
        {"[[material_override]]\nmatch = \"*\"\nmaterial = \"a\"",
         "3:12: error: unknown material 'a'; known: white_plastic, red_plastic, bronze, emerald, glass, black_matter, "
         "sand, mirror, blue_water, grey_matter, steel, ruby, grey_metallic"},
        {"[[material_override]]\nmatch = \"*\"\nmaterial = \"a\"\nior = 2\n[material.a]",
         "3:12: error: 'material' in [[material_override]] takes the place of a material as a whole: no other key than "
         "'match' can stand beside it"},
        {"[[material_override]]\nmatch = \"*\"\ntype = \"mirror\"\nior = 2",
         "4:7: error: 'ior' in [[material_override]] needs type 'glass' or 'plastic' or 'interface' or 'principled', "
         "not "
         "'mirror'"}};
    for (const auto& [text, message] : mistakes) EXPECT_EQ(problems(text), "s.toml:" + std::string(message)) << text;
}

}  // namespace
}  // namespace lancer
