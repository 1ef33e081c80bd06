// Each kind of light on a diffuse surface: found by light sampling, by the BSDF and by both it gives the same; and
// what can be worked out on paper comes out.
#include <gtest/gtest.h>

#include "support/random.h"
#include "support/rasters.h"
#include "support/ways.h"

namespace lancer {
namespace {

// A floor of albedo 1/2 at y = 0, of two triangles; the camera sees a part of it and nothing that hangs above.
SceneDescription floor_scene()
{
    SceneDescription d;
    d.meshes.push_back(make_mesh(
        make_quad({-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}, make_lambert("floor", {0.5f, 0.5f, 0.5f}))));
    d.camera = make_camera({0.1, 0.6, 3}, {0, 0, 0.2}, 10);
    return d;
}

struct Lit {
    std::string name;
    SceneDescription description;
    RasterSource images;
};

Raster sky_picture(float sun)
{
    return make_raster(32, 16, [=](uint32_t x, uint32_t y) {
        const float c = x == 9 && y == 4 ? sun : 0;
        return Color{c + 1 + 0.5f * std::sin(static_cast<float>(x)), c + 0.7f, c + static_cast<float>(y) / 8};
    });
}

std::vector<Lit> every_light()
{
    std::vector<Lit> all;
    const auto add = [&](const std::string& name) -> SceneDescription& {
        all.push_back({name, floor_scene(), {}});
        return all.back().description;
    };
    add("sphere").lights.push_back(light_of(LightType::sphere, {3, 2, 1}, {0.4, 1.2, 0.2}, 0.5));
    const auto triangle = [](bool textured) {
        MaterialDescription lamp = make_emitter("lamp", {4, 3, 2});
        if (textured)
            lamp.emission_map = TextureDescription{.where = {},
                                                   .type = TextureType::checker,
                                                   .file = {},
                                                   .use = {.scale = {3, 2}},
                                                   .even = {1, 0.5f, 1},
                                                   .odd = {0, 0, 0.1f}};
        MeshData data = *make_mesh_data({{-1, 1.3, -1}, {1.5, 1, -0.7}, {0.2, 1.1, 1.4}}, {{0, 1, 2}}, lamp);
        data.uvs = {{0, 0}, {1, 0}, {0.5f, 1}};
        data.uv_triangles = {{0, 1, 2}};
        return make_mesh(std::make_shared<const MeshData>(data));
    };
    add("triangle").meshes.push_back(triangle(false));
    add("textured triangle").meshes.push_back(triangle(true));
    add("sky").lights.push_back(sky_of({1, 0.8f, 0.6f}));
    add("sky map").lights.push_back(sky_map_of({1, 1, 1}, {20, 30, 40}));
    all.back().images = picture_source(sky_picture(0));
    add("sky map with a sun").lights = {sky_map_of({1, 1, 1}), sky_of({0.1f, 0.1f, 0.1f})};
    all.back().images = picture_source(sky_picture(60));
    return all;
}

TEST(EveryLight, IsTheSameByLightSamplingByTheBsdfAndByBoth)
{
    SameByAllWays same(0.03);
    for (const Lit& lit : every_light())
        same.add(lit.name, lit.description, {.width = 16, .height = 16, .spp = 64, .images = lit.images},
                 {.max_depth = 1}, 16);
}

// irradiance * cosine * albedo / pi, in every sample.
TEST(DirectionalLight, LightsAPlaneByTheCosine)
{
    for (const double angle_deg : {0.0, 30.0, 60.0, 89.0}) {
        const double angle = angle_deg * std::numbers::pi / 180;
        SceneDescription d = floor_scene();
        d.lights = {directional_of({3, 2, 1}, Vec3d{std::sin(angle), -std::cos(angle), 0} * 7.0)};
        const auto e = static_cast<float>(0.5 / std::numbers::pi * std::cos(angle));
        expect_all_equal(shoot(d, {.integrator = Path{.max_depth = 1}}), Color{3, 2, 1} * e, 1e-5f,
                         std::to_string(angle_deg));
        expect_all_equal(shoot(d, {.integrator = Path{}}), Color{3, 2, 1} * e, 1e-5f, "nothing else is there");
    }
    SceneDescription below = floor_scene();
    below.lights = {directional_of({3, 2, 1}, {0.1, 1, 0})};
    expect_all_equal(shoot(below, {}), {0, 0, 0}, 0, "from below");
}

// However far away what stands in the way.
TEST(DirectionalLight, ShadowsAreSharpAndReachToInfinity)
{
    for (const double height : {1.0, 100.0, 1e4}) {
        const Vec3d way{1, -2, 0.5};
        SceneDescription d = floor_scene();
        d.spheres.push_back(sphere_of(way * (-height / 2), 0.2));
        d.lights = {directional_of({3, 3, 3}, way)};
        d.camera = make_camera({0.05, 1.5, 3}, {0, 0, 0}, 20);
        const Film film = shoot(d, {.integrator = Path{.max_depth = 1}, .width = 48, .height = 48, .spp = 1});
        const double lit = 3 * 0.5 / std::numbers::pi * 2 / length(way);
        int shadowed = 0;
        for (const Pixel& p : film.pixels) {
            const double value = tally(p).mean;
            shadowed += value == 0;
            ASSERT_NEAR(value, value == 0 ? 0 : lit, 1e-5 * lit) << height;
        }
        // The sphere's shadow is an ellipse of semi-axes 0.2 and 0.2 over the cosine of the light.
        EXPECT_GT(shadowed, 50) << height;
        EXPECT_LT(shadowed, 200) << height;
    }
}

// A map of one colour is a constant sky; white things cannot be told from either.
TEST(EnvironmentMap, OfOneColourIsAConstantSky)
{
    constexpr Color sky{0.5f, 1, 2};
    const RasterSource picture = picture_source(make_raster(8, 4, [sky](uint32_t, uint32_t) { return sky; }));
    stats::Family family;
    for (const DirectLight how : ways) {
        SceneDescription d;
        d.materials = {make_lambert("white", {1, 1, 1})};
        d.spheres.push_back(sphere_of({0, 0, 0}, 1, "white"));
        d.lights = {sky_map_of({1, 1, 1}, {10, 20, 30})};
        d.camera = make_camera({0.4, 0.5, 3}, {0, 0, 0}, 45);
        const Film film = shoot(d, {.integrator = Path{.direct = how},
                                    .width = 16,
                                    .height = 16,
                                    .spp = 256,
                                    .sampler = SamplerKind::independent,
                                    .images = picture});
        for (const Pixel& p : film.pixels)
            family.add(stats::mean_p(tally(p), static_cast<double>(luminance(sky)), 1e-5), "a map of one colour");
    }
}

TEST(EnvironmentMap, AndDirectionalLightsScaleWithTheScene)
{
    SceneDescription d = cornell_scene();
    d.lights = {sky_map_of({1, 1, 1}, {20, 30, 40}), directional_of({1, 2, 1}, {1, -1, -3})};
    Shot shot{.width = 16, .height = 16, .spp = 4};
    shot.images = picture_source(sky_picture(60));
    const Film film = shoot(d, shot);
    for (const int k : {-20, -3, 7, 20})
        EXPECT_TRUE(same_bits(film, shoot(scaled_by(d, std::ldexp(1.0, k)), shot))) << k;
}

// A sun of a single texel among 2^25, a million times as bright as the rest: E = radiance * solid angle * cosine.
TEST(EnvironmentMap, OneTexelOfThirtyMillion)
{
    constexpr uint32_t width = 8192, height = 4096, column = 2500, row = 1100;
    Raster r{.width = width, .height = height, .channels = 1, .bytes = {}, .floats = {}};
    r.bytes.resize(size_t{width} * height);
    r.bytes[size_t{row} * width + column] = 255;
    const RasterSource picture = picture_source(std::move(r));
    const double polar = std::numbers::pi * (row + 0.5) / height, sun_radiance = 1e6, sky_radiance = 0.01;
    // The ramps on all sides hold as much as a whole texel.
    const double angle = 2 * std::numbers::pi / width * std::numbers::pi / height * std::sin(polar);
    SceneDescription d = floor_scene();
    d.lights = {sky_map_of({1e6f, 1e6f, 1e6f}), sky_of({0.01f, 0.01f, 0.01f})};
    const double expected =
        0.5 / std::numbers::pi * (sun_radiance * angle * std::cos(polar) + std::numbers::pi * sky_radiance);
    Shot shot{.integrator = Path{.max_depth = 1}, .width = 4, .height = 4, .spp = 1024};
    shot.images = picture;
    const Film film = shoot(d, shot);
    for (const Pixel& p : film.pixels) EXPECT_NEAR(tally(p).mean / expected, 1, 0.005);
}

}  // namespace
}  // namespace lancer
