// A camera that moves while its shutter is open.
#include <gtest/gtest.h>

#include "support/shoot.h"
#include "support/statistics/significance.h"

namespace lancer {
namespace {

// A wall of light left of x = 0, in a picture of 40x20 pixels that is 20 units wide at the wall. The camera goes to the
// right by 2 units: the edge goes to the left by 4 pixels, from the middle.
SceneDescription edge_of_light()
{
    SceneDescription d;
    d.meshes = {
        make_mesh(make_quad({-50, -50, 0}, {0, -50, 0}, {0, 50, 0}, {-50, 50, 0}, make_emitter("wall", {1, 1, 1})))};
    for (const double x : {0.0, 1.0, 2.0}) d.camera_path.push_back(make_camera({x, 0, 5}, {x, 0, 0}, 90));
    d.camera = d.camera_path.front();
    return d;
}

// All samples of a column.
stats::Tally column(const Film& film, uint32_t x)
{
    stats::Tally all;
    for (uint32_t y = 0; y < film.height; ++y) {
        const stats::Tally one = tally(film.at(x, y));
        const double n = all.n + one.n, apart = one.mean - all.mean;
        all.m2 += one.m2 + apart * apart * all.n * one.n / n;
        all.mean += apart * one.n / n;
        all.n = n;
    }
    return all;
}
// lit(x): part of the time, and of the pixel, in which a column is lit.
template <class Lit>
void expect_columns(const Film& film, const Lit& lit)
{
    stats::Family family;
    for (uint32_t x = 0; x < film.width; ++x) {
        const stats::Tally seen = column(film, x);
        if (const double part = lit(x); part == 0 || part == 1)
            EXPECT_EQ(seen.mean, part) << x;
        else
            family.add(stats::mean_p(seen, part, 1e-6), "column " + std::to_string(x));
    }
}

TEST(Shutter, AnEdgeIsSpreadOverItsWay)
{
    const Film film =
        shoot(edge_of_light(), {.width = 40, .height = 20, .spp = 64, .sampler = SamplerKind::independent});
    expect_columns(film, [](uint32_t x) { return x < 16 ? 1 : x >= 20 ? 0 : (19.5 - x) / 4; });
}

// Less noise than by chance: a quarter of it.
TEST(Shutter, TimesAreStratified)
{
    const auto error = [](SamplerKind sampler) {
        const Film film = shoot(edge_of_light(), {.width = 40, .height = 20, .spp = 64, .sampler = sampler});
        double sum = 0;
        for (uint32_t y = 0; y < film.height; ++y)
            for (uint32_t x = 16; x < 20; ++x) sum += std::pow(tally(film.at(x, y)).mean - (19.5 - x) / 4, 2);
        return sum;
    };
    EXPECT_LT(error(SamplerKind::sobol), 0.5 * error(SamplerKind::independent));
}

TEST(Shutter, OneThatStandsStillHasTheBitsOfNoShutter)
{
    SceneDescription d = edge_of_light();
    d.camera_path.assign(3, *d.camera);
    SceneDescription without = d;
    without.camera_path.clear();
    const Film a = shoot(d, {}), b = shoot(without, {});
    for (size_t i = 0; i < a.pixels.size(); ++i) EXPECT_EQ(a.pixels[i].sum, b.pixels[i].sum);
}

// Black things before a bright sky, which goes on where they are not.
SceneDescription black_thing()
{
    SceneDescription d;
    d.lights = {sky_of({1, 1, 1})};
    d.materials = {make_lambert("black", {0, 0, 0})};
    return d;
}

// A ball of radius 1 that goes by 6 units, seen from so far that its outline is a circle: what part of the time a point
// of the picture is dark is known.
TEST(Shutter, ABallIsSpreadOverItsWay)
{
    constexpr double far = 4000, half_width = 5, from = -3, way = 6;
    constexpr uint32_t width = 40, height = 16;
    SceneDescription d = black_thing();
    d.camera = make_camera({0, 0, far}, {0, 0, 0}, 2 * std::atan(half_width * height / width / far) * 180 / pi_d);
    SphereDescription ball{.where = {}, .center = {from, 0, 0}, .radius = 1, .material = "black"};
    for (const double x : {0.0, 0.5, 1.0}) ball.path.push_back({{from + way * x, 0, 0}, 1});
    d.spheres = {ball};
    const Film film = shoot(
        d,
        {.width = width, .height = height, .spp = 256, .sampler = SamplerKind::independent, .accel = AccelKind::bvh8});
    const auto dark = [&](double x, double y) {
        const double half = std::sqrt(std::max(0.0, 1 - y * y));
        const auto time = [&](double at) { return std::clamp((at - from) / way, 0.0, 1.0); };
        return time(x + half) - time(x - half);
    };
    expect_columns(film, [&](uint32_t x) {
        constexpr int fine = 64;
        double sum = 0;
        for (int j = 0; j < fine * static_cast<int>(height); ++j)
            for (int i = 0; i < fine; ++i)
                sum += dark(((x + (i + 0.5) / fine) / width * 2 - 1) * half_width,
                            (j + 0.5) / fine * 2 / width * half_width - half_width * height / width);
        return 1 - sum / (fine * fine * height);
    });
}

// The edge of a wall, an instance, that goes as the camera did above.
TEST(Shutter, AnInstanceIsSpreadOverItsWay)
{
    SceneDescription d = black_thing();
    MeshDescription wall = make_mesh(make_quad({-50, -50, 0}, {0, -50, 0}, {0, 50, 0}, {-50, 50, 0}));
    wall.name = "wall", wall.material = "black";
    d.meshes = {wall};
    InstanceDescription instance{.where = {}, .mesh = "wall", .transform = {}};
    for (const double x : {0.0, 1.0, 2.0}) instance.path.push_back({.translate = {-x, 0, 0}});
    d.instances = {instance};
    d.camera = make_camera({0, 0, 5}, {0, 0, 0}, 90);
    const Film film =
        shoot(d, {.width = 40, .height = 20, .spp = 64, .sampler = SamplerKind::independent, .accel = AccelKind::bvh8});
    expect_columns(film, [](uint32_t x) { return x < 16 ? 0 : x >= 20 ? 1 : 1 - (19.5 - x) / 4; });
}

// A wall before a floor goes away to the left. The light stands at the camera, so that no point that it sees is in
// shadow at the time of its camera ray, but most of them are as the shutter opens.
TEST(Shutter, ShadowsAreOfTheSameTime)
{
    SceneDescription d;
    d.materials = {make_lambert("black", {0, 0, 0}), make_lambert("white", {1, 1, 1})};
    MeshDescription wall = make_mesh(make_quad({-50, -50, 1}, {0, -50, 1}, {0, 50, 1}, {-50, 50, 1}));
    wall.name = "wall", wall.material = "black";
    MeshDescription floor = make_mesh(make_quad({-90, -90, 0}, {90, -90, 0}, {90, 90, 0}, {-90, 90, 0}));
    floor.material = "white";
    d.meshes = {wall, floor};
    const auto place = [](double time) { return TransformDescription{.translate = {4 * (1 - time), 0, 0}}; };
    d.instances = {{.where = {}, .mesh = "wall", .transform = place(0)}};
    d.instances[0].path = {place(0), place(1)};
    d.camera = make_camera({0, 0, 5}, {0, 0, 0}, 60);
    d.lights = {light_of(LightType::point, {25, 25, 25}, {0, 0, 5})};
    const auto seen = [](const SceneDescription& s, uint32_t spp) {
        return tally(shoot(s, {.integrator = Path{.max_depth = 2},
                               .width = 24,
                               .height = 8,
                               .spp = spp,
                               .sampler = SamplerKind::independent,
                               .accel = AccelKind::bvh8}));
    };
    // The mean over the time, by pictures of instants.
    double expected = 0, variance = 0;
    constexpr int instants = 64;
    for (int i = 0; i < instants; ++i) {
        SceneDescription then = d;
        then.instances[0].path.clear();
        then.instances[0].transform = place((i + 0.5) / instants);
        const stats::Tally instant = seen(then, 64);
        expected += instant.mean / instants, variance += std::pow(instant.error() / instants, 2);
    }
    const stats::Tally blurred = seen(d, 1024);
    EXPECT_LT(blurred.error(), 0.005 * blurred.mean);
    EXPECT_NEAR(blurred.mean, expected, 4 * std::sqrt(std::pow(blurred.error(), 2) + variance));
}

TEST(Shutter, WhatShinesStaysAndIsWarnedOf)
{
    SceneDescription d = edge_of_light();
    d.camera_path.clear();
    d.meshes[0].name = "wall";
    d.instances = {{.where = {}, .mesh = "wall", .transform = {}}};
    const Film still = shoot(d, {.accel = AccelKind::bvh8});
    for (const double x : {0.0, 1.0}) d.instances[0].path.push_back({.translate = {x, 0, 0}});
    EXPECT_TRUE(same_bits(still, shoot(d, {.accel = AccelKind::bvh8})));
    Diagnostics diagnostics;
    SceneBuilder(d, {}, diagnostics, test_picture).finish(diagnostics);
    EXPECT_EQ(diagnostics.warnings().size(), 1u);
}

}  // namespace
}  // namespace lancer
