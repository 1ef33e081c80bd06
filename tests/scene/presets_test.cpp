// Materials known by name, and what a mix is to the classic integrators.
#include "scene/description/presets.h"

#include <gtest/gtest.h>

#include "materials/material.h"
#include "support/scenes/scenes.h"

namespace lancer {
namespace {

SceneDescription ball_of(const std::string& material)
{
    SceneDescription d;
    d.spheres.push_back(sphere_of({}, 1, material));
    d.lights.push_back(sky_of({1, 1, 1}));
    return d;
}

TEST(Presets, AreThereForEveryShapeAndMadeOnce)
{
    for (const std::string_view name : names_of_presets()) {
        SceneDescription d = ball_of(std::string(name));
        d.planes.push_back(plane_of({0, -1, 0}, {0, 1, 0}, std::string(name)));
        MeshDescription mesh = make_mesh(make_cube());
        mesh.material = name;
        d.meshes.push_back(mesh);
        const Scene s = build_scene(d);
        ASSERT_EQ(s.materials.size(), 1u) << name;
        EXPECT_EQ(s.material_names[0], name);
        EXPECT_TRUE(std::holds_alternative<Interface>(s.materials[0]));
        const Phong p = s.phong(0, {}), expected = find_preset(name)->phong;
        EXPECT_EQ(p.diffuse, find_preset(name)->base_color) << name;
        EXPECT_EQ(p.diffuse, expected.diffuse) << name;
        EXPECT_EQ(p.specular, expected.specular) << name;
        EXPECT_EQ(p.ambient, expected.ambient) << name;
    }
    EXPECT_EQ(names_of_presets().size(), 13u);
    for (const char* none : {"", "whitePlastic", "Bronze", "bronze "}) EXPECT_FALSE(find_preset(none)) << none;
}

TEST(Presets, AreHiddenByAMaterialOfTheirName)
{
    SceneDescription d = ball_of("bronze");
    d.materials.push_back(make_lambert("bronze", {0.1f, 0.2f, 0.3f}));
    const Scene s = build_scene(d);
    ASSERT_EQ(s.materials.size(), 1u);
    EXPECT_EQ(std::get<Lambert>(s.materials[0]).albedo.value, (Color{0.1f, 0.2f, 0.3f}));
    const auto names = names_of_materials(d);
    EXPECT_EQ(names.size(), 13u);
    EXPECT_EQ(names.front(), "bronze");
}

// What docs/integrators.md says of each: the factor that leaves it no more light than there is.
TEST(Presets, AreScaledToConserveEnergy)
{
    const std::vector<std::pair<std::string_view, double>> factors{
        {"white_plastic", 0.6135}, {"red_plastic", 0.5263}, {"bronze", 0.6748}, {"emerald", 0.7061},
        {"glass", 0.9524},         {"black_matter", 1},     {"sand", 0.5},      {"mirror", 0.9995},
        {"blue_water", 0.9823},    {"grey_matter", 1},      {"steel", 1},       {"ruby", 0.8511},
        {"grey_metallic", 0.5814}};
    ASSERT_EQ(factors.size(), names_of_presets().size());
    for (const auto& [name, factor] : factors) {
        const Phong p = find_preset(name)->phong;
        const Vec3 wo{0.6f, 0, 0.8f}, back = normalize(Vec3{0.99f, 0, 0.1f});  // far from the highlight
        const float diffuse = InterfaceBsdf(p, true).eval(wo, back).f_cos.r * pi / back.z;
        EXPECT_NEAR(static_cast<double>(diffuse / (p.diffuse.r * p.diffusion)), factor, 1e-4) << name;
    }
}

// The colours of shadows behind one ball of two surfaces.
TEST(Presets, TintWhatGoesThrough)
{
    const auto twice = [](std::string_view name, const auto channel) {
        const Phong p = find_preset(name)->phong;
        const double once = static_cast<double>(p.diffuse.*channel * p.refraction);
        return once * once;
    };
    EXPECT_NEAR(twice("glass", &Color::r), 0.8668, 5e-5);
    EXPECT_NEAR(twice("glass", &Color::b), 0.9604, 5e-5);
    EXPECT_NEAR(twice("emerald", &Color::r), 0.00387, 1e-5);
    EXPECT_NEAR(twice("emerald", &Color::g), 0.25326, 1e-5);
    EXPECT_NEAR(twice("emerald", &Color::b), 0.00423, 1e-5);
    EXPECT_EQ(twice("bronze", &Color::g), 0);
}

TEST(Presets, MirrorWhereTheyReflectOrRefract)
{
    const auto mirrors = [](const std::string& name) { return build_scene(ball_of(name)).traits[0].mirrors; };
    for (const char* name : {"white_plastic", "bronze", "emerald", "glass", "blue_water", "mirror", "steel"})
        EXPECT_TRUE(mirrors(name)) << name;
    for (const char* name : {"sand", "black_matter", "grey_matter"}) EXPECT_FALSE(mirrors(name)) << name;
}

TEST(Presets, ArePartsOfMixesAsAnyMaterial)
{
    SceneDescription d = ball_of("half");
    MaterialDescription half{.name = "half", .where = {}, .type = MaterialType::mix};
    half.first = "bronze", half.second = "glass", half.weight = 0.25f;
    d.materials.push_back(half);
    const Scene s = build_scene(d);
    const Phong p = s.phong(s.sphere_material[0], {}), a = find_preset("bronze")->phong,
                b = find_preset("glass")->phong;
    const auto quarter = [](float x, float y) { return 0.75f * x + 0.25f * y; };
    for (const auto channel : {&Color::r, &Color::g, &Color::b})
        for (const auto color : {&Phong::ambient, &Phong::diffuse, &Phong::specular})
            EXPECT_NEAR((p.*color).*channel, quarter((a.*color).*channel, (b.*color).*channel), 1e-6);
    for (const auto number : {&Phong::shininess, &Phong::diffusion, &Phong::reflexion, &Phong::refraction,
                              &Phong::inside_ior, &Phong::outside_ior})
        EXPECT_NEAR(p.*number, quarter(a.*number, b.*number), 1e-5f * (1 + p.*number));
    EXPECT_TRUE(s.traits[s.sphere_material[0]].mirrors);
}

TEST(Presets, IndicesWhoseRatioIsNoNumberAreAnError)
{
    SceneDescription d = ball_of("far");
    MaterialDescription far = *find_preset("glass");
    far.name = "far", far.phong.inside_ior = 1e30f, far.phong.outside_ior = 1e-30f;
    d.materials.push_back(far);
    EXPECT_THROW(build_scene(d), Error);
    d.materials[0].phong.outside_ior = 1e30f;
    EXPECT_NO_THROW(build_scene(d));
}

}  // namespace
}  // namespace lancer
