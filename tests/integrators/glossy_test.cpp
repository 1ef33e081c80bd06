// Lobes of every width, seen from both sides and on tilted normals: light sampling, BSDF sampling and both weighted
// find the same light.
#include <gtest/gtest.h>

#include "support/ways.h"

namespace lancer {
namespace {

TEST(Glossy, SceneIsTheSameByAllWays)
{
    SceneDescription d = glossy_scene();
    std::erase_if(d.lights, [](const auto& l) { return l.type == LightType::point; });  // no BSDF finds a point
    SameByAllWays same(0.03);
    same.add("glossy scene", d, {.width = 32, .height = 24}, {.max_depth = 5}, 8, {1, 2, 3});
}

// A picture full of frosted glass, with nothing but a light behind it.
enum class Lamp { ball, panel, sky, sky_map };
constexpr std::array<const char*, 4> lamp_names{"ball", "panel", "sky", "sky map"};

void hang_lamp(SceneDescription& d, Lamp lamp, double z)
{
    switch (lamp) {
        case Lamp::ball:
            d.lights.push_back(light_of(LightType::sphere, {4, 3, 2}, {0.3, 0.2, z}, 0.5));
            break;
        case Lamp::panel: {
            MaterialDescription m = make_emitter("panel", {8, 7, 6});
            m.emission_map = picture_of("colours", Encoding::srgb);
            m.emission_both_sides = true;
            d.meshes.push_back(
                make_mesh(make_mapped_quad({-0.6, -0.3, z}, {0.6, -0.3, z}, {0.6, 0.7, z}, {-0.6, 0.7, z}, {1, 1}, m)));
            break;
        }
        case Lamp::sky:
            d.lights.push_back(sky_of({1, 0.8f, 0.6f}));
            break;
        case Lamp::sky_map:
            d.lights.push_back(sky_map_of({1, 1, 1}, {0, z < 0 ? 0.0 : 180.0, 0}));
            break;
    }
}

// thin: a sheet; else one face of a body.
SceneDescription behind_pane(Lamp lamp, bool from_front, float roughness, bool thin = false)
{
    SceneDescription d;
    const double front = from_front ? 1 : -1;
    MaterialDescription pane = make_glossy("pane", MaterialType::glass, {1, 1, 1}, roughness);
    pane.thin = thin;
    d.meshes.push_back(make_mesh(make_quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, pane)));
    hang_lamp(d, lamp, -front);
    d.camera = make_camera({0.2, 0.1, 2 * front}, {0, 0, 0}, 30);
    return d;
}

TEST(Glossy, LightThroughAPaneIsTheSameByAllWays)
{
    SameByAllWays same(0.06);
    for (const bool from_front : {true, false})
        for (const Lamp lamp : {Lamp::ball, Lamp::panel, Lamp::sky, Lamp::sky_map})
            same.add(
                std::string(lamp_names[static_cast<size_t>(lamp)]) + " behind the " + (from_front ? "back" : "front"),
                behind_pane(lamp, from_front, 0.85f), {.width = 16, .height = 16, .spp = 16}, {.max_depth = 1}, 8,
                {1, 4, 1});
}

TEST(Glossy, LightThroughASheetIsTheSameByAllWays)
{
    SameByAllWays same(0.06);
    for (const Lamp lamp : {Lamp::ball, Lamp::panel, Lamp::sky_map})
        same.add(lamp_names[static_cast<size_t>(lamp)], behind_pane(lamp, true, 0.95f, true),
                 {.width = 16, .height = 16, .spp = 16}, {.max_depth = 1}, 8, {1, 4, 1});
}

// Only light sampling finds a point; a ball as small as one sends the same.
TEST(Glossy, APointBehindAPaneIsASmallBall)
{
    constexpr double radius = 0.01;
    for (const bool from_front : {true, false}) {
        SceneDescription ball = behind_pane(Lamp::sky, from_front, 0.6f), point = ball;
        const Vec3d at{0.3, 0.2, from_front ? -1.0 : 1.0};
        const auto radiance = static_cast<float>(5 / (std::numbers::pi * radius * radius));
        ball.lights = {light_of(LightType::sphere, Color{1, 1, 1} * radiance, at, radius)};
        point.lights = {light_of(LightType::point, {5, 5, 5}, at)};
        const Shot shot{.integrator = Path{.max_depth = 1}, .width = 16, .height = 16, .spp = 16};
        const double mean = expect_one_mean({{ball, shot}, {point, shot}},
                                            {.pictures = 8, .detectable = 0.015, .rounding = 1e-3}, "a small ball");
        EXPECT_GT(mean, 0.05);
    }
}

TEST(Glossy, LightThroughABallOfGlassIsTheSameByAllWays)
{
    SameByAllWays same(0.06);
    SceneDescription d;
    d.materials = {make_glossy("glass", MaterialType::glass, {1, 0.9f, 0.8f}, 0.8f)};
    d.spheres.push_back(sphere_of({0, 0, 0}, 1, "glass"));
    hang_lamp(d, Lamp::ball, -1.8);
    hang_lamp(d, Lamp::sky_map, -1);
    d.camera = make_camera({0.2, 0.1, 3}, {0, 0, 0}, 30);
    const Shot shot{.width = 16, .height = 16, .spp = 16};
    same.add("ball before a lamp", d, shot, {.max_depth = 4}, 8, {1, 4, 1});
    d.lights[0].position = {0.3, 0.2, -0.3};
    d.lights[0].radius = 0.3;
    same.add("lamp in the ball", d, shot, {.max_depth = 4}, 8, {1, 2, 1});
    d.camera = make_camera({0.2, 0.1, 0.7}, {0.3, 0.2, -0.3}, 70);
    same.add("lamp and camera in the ball", d, shot, {.max_depth = 4}, 8, {1, 2, 1});
}

std::vector<MaterialDescription> every_gloss()
{
    return {make_lambert("lambert", {0.8f, 0.7f, 0.6f}),
            make_glossy("lacquer", MaterialType::plastic, {0.7f, 0.3f, 0.2f}, 0.5f),
            make_glossy("glazed", MaterialType::plastic, {0.7f, 0.3f, 0.2f}, 0), make_copper("copper", 0.8f),
            make_glossy("frosted", MaterialType::glass, {1, 1, 1}, 0.8f)};
}

// A ball on a floor, under a lamp and a sky map.
SceneDescription ball_on_floor(const MaterialDescription& ball, const MaterialDescription& floor)
{
    SceneDescription d;
    d.materials = {ball};
    d.spheres.push_back(sphere_of({0.1, 0.1, 0}, 0.6, ball.name));
    d.meshes.push_back(
        make_mesh(make_mapped_quad({-2, -0.5, 2}, {2, -0.5, 2}, {2, -0.5, -2}, {-2, -0.5, -2}, {3, 2}, floor)));
    hang_lamp(d, Lamp::sky_map, -1);
    d.lights.push_back(light_of(LightType::sphere, {3, 3, 3}, {1.2, 1.5, 1}, 0.9));
    d.camera = make_camera({0.3, 0.8, 2.5}, {0, -0.1, 0}, 40);
    return d;
}
// Light sampling alone is at its worst where lobes are narrow.
std::array<uint32_t, 3> effort_for(const MaterialDescription& m)
{
    const bool narrow = m.type == MaterialType::metal || m.type == MaterialType::glass;
    return {1, narrow ? 3u : 1u, 1};
}

TEST(Glossy, BumpsAndNormalMapsAreTheSameByAllWays)
{
    SameByAllWays same(0.06);
    for (const MaterialDescription& plain : every_gloss()) {
        MaterialDescription bumped = plain, mapped = plain;
        bumped.bump_map = heights_of("waves");
        bumped.bump_scale = 12;  // slopes up to 3
        mapped.normal_map = picture_of("tilted normals", Encoding::linear);
        const Shot shot{.width = 16, .height = 16, .spp = 16};
        same.add("bumped ball, " + plain.name, ball_on_floor(bumped, mapped), shot, {.max_depth = 3}, 8,
                 effort_for(plain));
        if (plain.type == MaterialType::plastic && plain.roughness > 0)
            same.add("bumped floor, " + plain.name, ball_on_floor(mapped, bumped), shot, {.max_depth = 3}, 8,
                     effort_for(plain));
    }
}

TEST(Glossy, InterpolatedNormalsAreTheSameByAllWays)
{
    SameByAllWays same(0.06);
    for (const MaterialDescription& m : every_gloss())
        for (const bool terminator : {false, true}) {
            if (terminator && m.type != MaterialType::plastic) continue;
            SceneDescription d = ball_on_floor(m, m);
            d.render.terminator = terminator;
            MeshData coarse = *make_uv_sphere(4, 6, 0, m);
            for (const Vec3d& p : coarse.positions) coarse.normals.push_back(to_float(normalize(p + Vec3d{0, 0.3, 0})));
            coarse.normal_triangles = coarse.triangles;
            d.spheres.clear();
            // Nothing behind the floor stops light that its normals alone would let in from below.
            MeshData floor = *d.meshes[0].data;
            floor.normals = {normalize(Vec3{1, 1, 0.5f}), normalize(Vec3{-1, 1, -0.5f})};
            floor.normal_triangles = {{0, 1, 1}, {0, 1, 0}};
            d.meshes[0].data = std::make_shared<const MeshData>(floor);
            d.meshes.push_back(
                make_mesh(std::make_shared<const MeshData>(coarse), {{0.1, 0.1, 0}, {20, 30, 0}, {0.6, 0.6, 0.6}}));
            same.add("coarse ball and floor, " + m.name + (terminator ? ", moved origins" : ""), d,
                     {.width = 16, .height = 16, .spp = 16}, {.max_depth = 3}, 8, effort_for(m));
        }
}

}  // namespace
}  // namespace lancer
