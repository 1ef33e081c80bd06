// Which parameter of a description goes where.
#include "scene/build/material_builder.h"

#include <gtest/gtest.h>

namespace lancer {
namespace {

// Textures are told apart by their files: "3" has the id 3.
uint32_t id_of(const TextureUse& use) { return use ? static_cast<uint32_t>(std::stoi(use->file)) : no_texture; }

TextureUse picture(const std::string& file)
{
    TextureDescription t;
    t.file = file;
    return t;
}

MaterialDescription description(MaterialType type)
{
    MaterialDescription m;
    m.type = type;
    m.base_color = {0.1f, 0.2f, 0.3f};
    m.base_color_map = picture("1");
    m.roughness = 0.5f;
    m.roughness_map = picture("2");
    m.ior = 1.7f;
    m.specular = {0.4f, 0.5f, 0.6f};
    return m;
}

template <class M>
M made(const MaterialDescription& m, MaterialOptions options = {})
{
    return std::get<M>(MaterialBuilder(options).make(m, id_of));
}

void expect_base(const ColorParam& p)
{
    EXPECT_EQ(p.value, (Color{0.1f, 0.2f, 0.3f}));
    EXPECT_EQ(p.texture, 1u);
}
void expect_roughness(const FloatParam& p)
{
    EXPECT_EQ(p.value, 0.5f);
    EXPECT_EQ(p.texture, 2u);
}

TEST(MaterialBuilder, LambertAndMirrorHaveTheirColour)
{
    expect_base(made<Lambert>(description(MaterialType::lambert)).albedo);
    expect_base(made<Mirror>(description(MaterialType::mirror)).tint);
}

TEST(MaterialBuilder, TranslucentSheetsHaveTwoColours)
{
    MaterialDescription m = description(MaterialType::translucent);
    m.transmittance = {0.7f, 0.8f, 0.9f};
    m.transmittance_map = picture("5");
    const Translucent sheet = made<Translucent>(m);
    expect_base(sheet.reflectance);
    EXPECT_EQ(sheet.transmittance.value, m.transmittance);
    EXPECT_EQ(sheet.transmittance.texture, 5u);
}

TEST(MaterialBuilder, MetalByItsColourOrItsIndex)
{
    MaterialDescription m = description(MaterialType::metal);
    const Metal coloured = made<Metal>(m);
    expect_base(coloured.color);
    expect_roughness(coloured.roughness);
    EXPECT_FALSE(coloured.conductor);
    EXPECT_NE(coloured.compensation, nullptr);
    EXPECT_EQ(made<Metal>(m, {.multiscatter = false}).compensation, nullptr);
    m.eta = Color{0.1f, 0.4f, 1.4f}, m.k = Color{4, 2, 1.6f};
    const Metal gold = made<Metal>(m);
    ASSERT_TRUE(gold.conductor);
    EXPECT_EQ(gold.conductor->eta, *m.eta);
    EXPECT_EQ(gold.conductor->k, *m.k);
}

TEST(MaterialBuilder, GlassHasItsIndex)
{
    const Glass glass = made<Glass>(description(MaterialType::glass));
    expect_base(glass.tint);
    expect_roughness(glass.roughness);
    EXPECT_EQ(glass.ior, 1.7f);
    EXPECT_TRUE(glass.fresnel);
    EXPECT_FALSE(made<Glass>(description(MaterialType::glass), {.fresnel = false}).fresnel);
}

TEST(MaterialBuilder, InterfaceIsWhatItSaysWithTheBaseColourAsItsDiffuseOne)
{
    MaterialDescription m = description(MaterialType::interface);
    m.phong = {.diffuse = {9, 9, 9}, .specular = {0.7f, 0.8f, 0.9f}, .shininess = 12, .reflexion = 0.5f};
    const Interface made_of_it = made<Interface>(m);
    expect_base(made_of_it.base);
    EXPECT_EQ(made_of_it.rest.specular, m.phong.specular);
    EXPECT_EQ(made_of_it.rest.shininess, 12);
    EXPECT_EQ(made_of_it.rest.reflexion, 0.5f);
    const Texture white = Checker{.even = {0.5f, 1, 1}, .odd = {0.5f, 1, 1}};
    const std::vector<Texture> textures(2, white);
    EXPECT_EQ(made_of_it.phong({.textures = textures.data()}).diffuse, (Color{0.05f, 0.2f, 0.3f}));
}

TEST(MaterialBuilder, RoughPlasticsOfOneIndexShareTheirTable)
{
    MaterialBuilder builder({});
    MaterialDescription m = description(MaterialType::plastic);
    const auto first = std::get<Plastic>(builder.make(m, id_of)), second = std::get<Plastic>(builder.make(m, id_of));
    expect_base(first.base);
    expect_roughness(first.roughness);
    EXPECT_EQ(first.ior, 1.7f);
    EXPECT_EQ(first.specular, m.specular);
    EXPECT_EQ(first.mean_through, static_cast<float>(mean_transmittance(double{1.7f})));
    EXPECT_TRUE(first.coat);
    EXPECT_EQ(first.coat, second.coat);
    m.ior = 1.3f;
    EXPECT_NE(std::get<Plastic>(builder.make(m, id_of)).coat, first.coat);
    m.roughness = 0;
    EXPECT_FALSE(std::get<Plastic>(builder.make(m, id_of)).coat);
}

}  // namespace
}  // namespace lancer
