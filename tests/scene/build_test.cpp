// From a description to a scene: names, warnings, what is left out, where things end up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "materials/material.h"
#include "support/stage.h"

namespace lancer {
namespace {

using testing::HasSubstr;

std::string error_of(const SceneDescription& d)
{
    Diagnostics diagnostics;
    try {
        Scene::build(d, d.render, diagnostics);
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::invalid_input);
        return e.what();
    }
    return "no error";
}
std::vector<std::string> warnings_of(const SceneDescription& d)
{
    Diagnostics diagnostics;
    Scene::build(d, d.render, diagnostics);
    std::vector<std::string> all;
    for (const auto& w : diagnostics.warnings()) all.push_back(to_string(w));
    return all;
}

SceneDescription lit_sphere()
{
    SceneDescription d;
    d.file = "s.toml";
    d.materials = {make_lambert("chalk", {0.9f, 0.8f, 0.7f}), make_emitter("lamp", {1, 2, 3})};
    d.materials[0].where = {"s.toml", 3, 1};
    d.spheres.push_back(sphere_of({}, 1, "chalk", {"s.toml", 9, 1}));
    d.spheres.push_back(sphere_of({0, 3, 0}, 0.5, "lamp", {"s.toml", 12, 1}));
    return d;
}

TEST(Build, ResolvesNames)
{
    const Scene s = build_scene(lit_sphere());
    ASSERT_EQ(s.sphere_material.size(), 2u);
    EXPECT_EQ(s.material_names[s.sphere_material[0]], "chalk");
    EXPECT_EQ(std::get<Lambert>(s.materials[s.sphere_material[0]]).albedo.value, (Color{0.9f, 0.8f, 0.7f}));
    EXPECT_EQ(s.emission[s.sphere_material[1]].radiance.value, (Color{1, 2, 3}));
    EXPECT_TRUE(is_black(s.emission[s.sphere_material[0]].radiance.value));
}

TEST(Build, EveryTypeOfMaterialIsItsOwn)
{
    SceneDescription d = lit_sphere();
    d.materials[0].type = MaterialType::mirror;
    EXPECT_EQ(std::get<Mirror>(build_scene(d).materials[0]).tint.value, (Color{0.9f, 0.8f, 0.7f}));
    d.materials[0].type = MaterialType::glass;
    d.materials[0].ior = 1.7f;
    EXPECT_EQ(std::get<Glass>(build_scene(d).materials[0]).ior, 1.7f);
}

TEST(Build, NoNameIsTheDefaultGrey)
{
    SceneDescription d = lit_sphere();
    d.spheres[0].material.clear();
    d.planes.push_back(plane_of({0, -1, 0}, {0, 2, 0}));
    const Scene s = build_scene(d);
    EXPECT_EQ(std::get<Lambert>(s.materials[s.sphere_material[0]]).albedo.value, (Color{0.8f, 0.8f, 0.8f}));
    EXPECT_EQ(s.sphere_material[0], s.plane_material[0]);
}

TEST(Build, UnknownMaterialNamesPlaceAndNeighbour)
{
    SceneDescription d = lit_sphere();
    d.spheres[0].material = "chlak";
    EXPECT_EQ(error_of(d),
              "s.toml:9:1: error: unknown material 'chlak'; did you mean 'chalk'? known: chalk, lamp, white_plastic, "
              "red_plastic, bronze, emerald, glass, black_matter, sand, mirror, blue_water, grey_matter, steel, ruby, "
              "grey_metallic");
}

TEST(Build, UnknownMaterialWhereOnlyPresetsAreKnown)
{
    SceneDescription d;
    d.spheres.push_back(sphere_of({}, 1, "chalk", {"s.toml", 9, 1}));
    const std::string known =
        "; known: white_plastic, red_plastic, bronze, emerald, glass, black_matter, sand, mirror, blue_water, "
        "grey_matter, steel, ruby, grey_metallic";
    EXPECT_EQ(error_of(d), "s.toml:9:1: error: unknown material 'chalk'" + known);
    MeshDescription mesh = make_mesh(make_cube());
    mesh.where = {"s.toml", 5, 1};
    mesh.material = "stone";
    d.spheres.clear();
    d.meshes = {mesh};
    EXPECT_EQ(error_of(d), "s.toml:5:1: error: unknown material 'stone'" + known);
}

TEST(Build, AllErrorsAreReportedAtOnce)
{
    SceneDescription d = lit_sphere();
    d.spheres[0].material = "chlak";
    d.spheres[1].material = "laamp";
    d.instances.push_back(instance_of("tree", {}, {"s.toml", 20, 1}));
    EXPECT_THAT(error_of(d), testing::AllOf(HasSubstr("'chlak'"), HasSubstr("did you mean 'lamp'"),
                                            HasSubstr("s.toml:20:1: error: unknown mesh 'tree'")));
}

TEST(Build, UnknownMeshNamesItsNeighbour)
{
    SceneDescription d = lit_sphere();
    d.meshes.push_back(make_mesh(make_cube()));
    d.meshes.back().name = "tree";
    d.instances.push_back(instance_of("trea", {}, {"s.toml", 20, 1}));
    EXPECT_EQ(error_of(d), "s.toml:20:1: error: unknown mesh 'trea'; did you mean 'tree'? known: tree");
}

TEST(Build, WhatLiesOutOfReachIsAnError)
{
    SceneDescription d = lit_sphere();
    d.planes.push_back(plane_of({0, -1e30, 0}, {0, 1, 0}, "chalk", {"s.toml", 7, 1}));
    EXPECT_THAT(error_of(d), HasSubstr("s.toml:7:1: error: this plane lies too far"));
    d = lit_sphere();
    d.lights.push_back(light_of(LightType::point, {1, 1, 1}, {1e20, 0, 0}, 1, {"s.toml", 8, 1}));
    EXPECT_THAT(error_of(d), HasSubstr("s.toml:8:1: error: this light lies too far"));
}

TEST(Build, WarnsOfUnusedMaterialsAndOfDarkness)
{
    EXPECT_THAT(warnings_of(lit_sphere()), testing::IsEmpty());
    SceneDescription d = lit_sphere();
    d.spheres.pop_back();
    d.spheres[0].material.clear();
    EXPECT_THAT(warnings_of(d),
                testing::ElementsAre("s.toml:3:1: warning: material 'chalk' and 'lamp' is not used",
                                     "s.toml: warning: nothing emits light: the picture will be black"));
    // Each of these gives light.
    d.lights = {sky_of({0, 0.1f, 0})};
    EXPECT_EQ(warnings_of(d).size(), 1u);
    d.lights = {light_of(LightType::point, {0, 0.1f, 0}, {}, 1)};
    EXPECT_EQ(warnings_of(d).size(), 1u);
    d.lights.clear();
    d.planes.push_back(plane_of({}, {0, 1, 0}, "lamp"));
    EXPECT_EQ(warnings_of(d).size(), 1u);
}

// What it says by its numbers alone; textures can only dim.
TEST(Build, WarnsOnceOfASheetThatWouldMakeLight)
{
    SceneDescription d = lit_sphere();
    d.materials[0] = make_translucent("chalk", {0.5f, 0.25f, 0.7f}, {0.5f, 0.75f, 0.3f});
    d.materials[0].where = {"s.toml", 3, 1};
    EXPECT_THAT(warnings_of(d), testing::IsEmpty());
    d.materials[0].transmittance = {0.6f, 0.75f, 0.7f};
    d.spheres.push_back(d.spheres[0]);
    EXPECT_THAT(warnings_of(d),
                testing::ElementsAre("s.toml:3:1: warning: the 'base_color' and 'transmittance' of 'chalk' add up to "
                                     "more than 1 in some channel; both are divided by the largest sum"));
    d.materials[0].base_color_map.emplace();
    d.materials[0].base_color_map->type = TextureType::checker;
    EXPECT_THAT(warnings_of(d), testing::IsEmpty());
}

TEST(Build, LightsWithoutPowerAreLeftOut)
{
    SceneDescription d = lit_sphere();
    for (const LightType t : {LightType::point, LightType::sphere, LightType::environment})
        d.lights.push_back(light_of(t, {}, {0, 5, 0}, 1));
    d.meshes.push_back(make_mesh(make_cube(make_emitter("dark", {}))));
    const Scene s = build_scene(d);
    ASSERT_EQ(s.lights.lights.size(), 1u);
    EXPECT_EQ(std::get<SphereLight>(s.lights.lights[0]).sphere, 1u);
    EXPECT_EQ(s.geometry.spheres.size(), 2u) << "nor are they seen";
    EXPECT_EQ(s.environment_light, Scene::none);
}

// Emitting triangles without area would make a density infinite: they may be listed but are never drawn.
TEST(Build, EmittersWithoutAreaAreNeverChosen)
{
    SceneDescription d = lit_sphere();
    d.meshes.push_back(triangle_mesh({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, make_emitter("line", {1, 1, 1})));
    const Scene s = build_scene(d);
    for (uint32_t i = 0; i < s.lights.lights.size(); ++i)
        EXPECT_EQ(s.lights.pick.probability(i) == 0, std::holds_alternative<TriangleLight>(s.lights.lights[i]));
    for (const float u : {0.0f, 0.3f, 1 - 0x1p-24f})
        EXPECT_TRUE(std::holds_alternative<SphereLight>(s.lights.lights[s.lights.pick.sample(u)]));
}

// A mesh that an instance names is drawn only there.
TEST(Build, InstancedMeshIsDrawnOnlyThroughItsInstances)
{
    SceneDescription d = lit_sphere();
    d.meshes.push_back(make_mesh(make_cube(), {{10, 0, 0}, {}, {1, 1, 1}}));
    d.meshes.back().name = "cube";
    const Stage before(d);
    EXPECT_TRUE(before.look(before.to_scene({4, 0, 0}), {1, 0, 0})) << "not instanced: as it stands";
    d.instances.push_back(instance_of("cube", {{0, 0, 20}, {0, 90, 0}, {1, 1, 1}}));
    const Stage stage(d);
    EXPECT_FALSE(stage.look(stage.to_scene({4, 0, 0}), {1, 0, 0}));
    // The mesh's own transform first, to x = 10; then the instance's, which turns that to z = -10 and moves it.
    const auto there = stage.look(stage.to_scene({0, 0, 2}), {0, 0, 1});
    ASSERT_TRUE(there);
    const Vec3d p = stage.scene.normalisation.to_file(to_double(there->p));
    EXPECT_NEAR(p.x, 0, 1e-5);
    EXPECT_NEAR(p.z, 9, 1e-5);
}

TEST(Build, EveryInstanceOfAnEmitterIsALightOfItsOwn)
{
    SceneDescription d;
    d.meshes.push_back(
        make_mesh(make_quad({-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, make_emitter("lamp", {1, 1, 1}))));
    d.meshes.back().name = "lamp";
    d.instances.push_back(instance_of("lamp", {{0, 0, 0}, {}, {1, 1, 1}}));
    d.instances.push_back(instance_of("lamp", {{5, 0, 0}, {}, {2, 1, 3}}));
    const Stage stage(d);
    ASSERT_EQ(stage.scene.lights.lights.size(), 4u);
    float total = 0;
    for (const uint32_t first : {0u, 2u}) {
        const float share = stage.scene.lights.pick.probability(first) + stage.scene.lights.pick.probability(first + 1);
        EXPECT_NEAR(share, first == 0 ? 1 / 7.0f : 6 / 7.0f, 1e-6f);
        total += share;
    }
    EXPECT_NEAR(total, 1, 1e-6f);
    // What is hit knows which of them it is.
    const auto one = stage.look(stage.to_scene({0.2, 1, 0}), {0, -1, 0}),
               two = stage.look(stage.to_scene({5.2, 1, 0}), {0, -1, 0});
    ASSERT_TRUE(one && two);
    EXPECT_EQ(std::get<TriangleLight>(stage.scene.lights.lights[one->light]).instance, 0u);
    EXPECT_EQ(std::get<TriangleLight>(stage.scene.lights.lights[two->light]).instance, 1u);
}

// Only some faces of a mesh emit: the others belong to no light, and each emitter is found under its own id.
TEST(Build, EmittingFacesKeepTheirNumbers)
{
    MeshData data;
    for (int i = 0; i < 4; ++i)
        for (const Vec3d p : {Vec3d{0, 0, 0}, Vec3d{0, 0, 1}, Vec3d{1, 0, 0}})
            data.positions.push_back(p + Vec3d{2.0 * i, 0, 0});
    data.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}};
    data.face_material = {0, 1, 0, 1};
    data.materials = {make_lambert("dark", {}), make_emitter("lamp", {1, 1, 1})};
    SceneDescription d;
    d.meshes.push_back(make_mesh(std::make_shared<const MeshData>(data)));
    const Stage stage(d);
    for (uint32_t i = 0; i < 4; ++i) {
        const auto s = stage.look(stage.to_scene({2.0 * i + 0.2, 1, 0.2}), {0, -1, 0});
        ASSERT_TRUE(s);
        if (i % 2 == 0) {
            EXPECT_EQ(s->light, Scene::none);
        } else {
            EXPECT_EQ(std::get<TriangleLight>(stage.scene.lights.lights[s->light]).triangle, i);
        }
    }
}

}  // namespace
}  // namespace lancer
