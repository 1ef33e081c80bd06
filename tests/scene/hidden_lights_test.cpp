// Lights that no technique finds, and those that it does.
#include "scene/hidden_lights.h"

#include <gtest/gtest.h>

#include "support/stage.h"

namespace lancer {
namespace {

MaterialDescription default_of(const std::string& name, MaterialType type)
{
    MaterialDescription m = default_description(type);
    m.name = name;
    return m;
}
SceneDescription on_floor()
{
    SceneDescription d;
    d.planes = {plane_of({0, 0, 0}, {0, 1, 0})};
    d.materials = {default_of("glass", MaterialType::glass), default_of("mirror", MaterialType::mirror)};
    d.camera = make_camera({0, 2, 6}, {0, 1, 0}, 40);
    return d;
}
size_t hidden(const SceneDescription& d)
{
    const Stage stage(d);
    Diagnostics problems;
    const PictureSize size{64, 48};
    const Camera camera(*d.camera, stage.scene.normalisation, size.width, size.height);
    const uint32_t n = warn_of_hidden_lights(d, stage.scene, *stage.embree, camera, size, problems);
    uint64_t warned = 0;
    for (const auto& w : problems.warnings()) warned += w.count;
    EXPECT_EQ(warned, n);
    return n;
}

TEST(HiddenLights, AreThoseInsideOfGlassOrMirrors)
{
    for (const char* material : {"glass", "mirror"}) {
        SceneDescription d = on_floor();
        d.lights = {light_of(LightType::point, {10, 10, 10}, {0, 1, 0})};
        d.spheres = {sphere_of({0, 1, 0}, 0.5, material)};
        EXPECT_EQ(hidden(d), 1u) << material;
        d.spheres[0].center = {2, 1, 0};
        EXPECT_EQ(hidden(d), 0u) << material;
        d.spheres.clear();
        EXPECT_EQ(hidden(d), 0u);
        // The camera is inside as well, and sees nothing else.
        d.spheres = {sphere_of({0, 0, 0}, 50, material)};
        d.planes.clear();
        EXPECT_EQ(hidden(d), 1u) << material;
    }
}

TEST(HiddenLights, AreOnlyThoseThatAreHidden)
{
    SceneDescription d = on_floor();
    d.lights = {light_of(LightType::point, {10, 10, 10}, {0, 1, 0}),
                light_of(LightType::point, {10, 10, 10}, {1.5, 1, 0})};
    d.lights[0].where = {"scene", 7, 0};
    d.spheres = {sphere_of({0, 1, 0}, 0.5, "glass")};
    const Stage stage(d);
    Diagnostics problems;
    const Camera camera(*d.camera, stage.scene.normalisation, 64, 48);
    EXPECT_EQ(warn_of_hidden_lights(d, stage.scene, *stage.embree, camera, {64, 48}, problems), 1u);
    ASSERT_EQ(problems.warnings().size(), 1u);
    EXPECT_EQ(problems.warnings()[0].where.line, 7u);
}

TEST(HiddenLights, AreNotThoseThatShineStraightThroughGlass)
{
    SceneDescription d = on_floor();
    d.render.straight_shadows = true;
    d.lights = {light_of(LightType::point, {10, 10, 10}, {0, 1, 0})};
    d.spheres = {sphere_of({0, 1, 0}, 0.5, "glass")};
    EXPECT_EQ(hidden(d), 0u);
    d.spheres[0].material = "mirror";
    EXPECT_EQ(hidden(d), 1u);
}

// Facets spread light to both sides, so that the surface of a rough bulb samples the light in it.
TEST(HiddenLights, AreNotThoseInRoughGlass)
{
    SceneDescription d = on_floor();
    d.materials[0].roughness = 0.5f;
    d.lights = {light_of(LightType::point, {10, 10, 10}, {0, 1, 0})};
    d.spheres = {sphere_of({0, 1, 0}, 0.5, "glass")};
    EXPECT_EQ(hidden(d), 0u);
}

// Half a shade of glass.
TEST(HiddenLights, AreNotThoseThatArePartlySeen)
{
    SceneDescription d = on_floor();
    d.lights = {light_of(LightType::point, {10, 10, 10}, {0, 1, 0})};
    MeshData ball = *make_uv_sphere(16, 32, 0, d.materials[0]);
    ball.triangles.resize(ball.triangles.size() / 2);
    d.meshes = {make_mesh(std::make_shared<const MeshData>(ball), {{0, 1, 0}, {180, 0, 0}, {0.5, 0.5, 0.5}})};
    EXPECT_EQ(hidden(d), 0u);
}

enum class Pane { none, sheet, block };
SceneDescription room(Pane pane, bool closed)
{
    SceneDescription d;
    const auto wall = [&](Vec3d a, Vec3d b, Vec3d c, Vec3d e) {
        d.meshes.push_back(make_mesh(make_quad(a, b, c, e, make_lambert("wall", {0.8f, 0.8f, 0.8f}))));
    };
    wall({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
    wall({-2, 3, -2}, {2, 3, -2}, {2, 3, 2}, {-2, 3, 2});
    wall({-2, 0, -2}, {2, 0, -2}, {2, 3, -2}, {-2, 3, -2});
    wall({-2, 0, 2}, {-2, 0, -2}, {-2, 3, -2}, {-2, 3, 2});
    if (closed) wall({2, 0, 2}, {-2, 0, 2}, {-2, 3, 2}, {2, 3, 2});
    const MaterialDescription glass = default_of("pane", MaterialType::glass);
    if (pane == Pane::sheet)
        d.meshes.push_back(make_mesh(make_quad({2, 0, 2}, {2, 0, -2}, {2, 3, -2}, {2, 3, 2}, glass)));
    if (pane == Pane::block)
        d.meshes.push_back(make_mesh(make_cube(glass), {.translate = {2, 1.5, 0}, .scale = {0.15, 1.5, 2}}));
    LightDescription sun = light_of(LightType::directional, {5, 5, 5});
    sun.direction = {-1, -0.5, -0.1};
    d.lights = {sun};
    d.camera = make_camera({0.5, 1.5, 1.9}, {-1.5, 0.8, -2}, 70);
    return d;
}
// A body of glass turns the light, and only BSDF sampling goes along. Shadow rays pass sheets.
TEST(HiddenLights, AreSunsBehindBlocksOfGlass)
{
    for (const bool closed : {false, true}) {
        EXPECT_EQ(hidden(room(Pane::block, closed)), 1u);
        EXPECT_EQ(hidden(room(Pane::sheet, closed)), 0u);
        EXPECT_EQ(hidden(room(Pane::none, closed)), 0u);
    }
}

// What walls alone keep out is meant.
TEST(HiddenLights, AreNotThoseBehindWalls)
{
    SceneDescription d = room(Pane::none, true);
    d.meshes.push_back(make_mesh(make_quad({2, 0, 2}, {2, 0, -2}, {2, 3, -2}, {2, 3, 2})));
    EXPECT_EQ(hidden(d), 0u);
    d.materials = {default_of("glass", MaterialType::glass)};
    d.spheres = {sphere_of({0, 1, 0}, 0.3, "glass")};
    EXPECT_EQ(hidden(d), 0u);
}

}  // namespace
}  // namespace lancer
