// Backgrounds as light: found by light sampling, by the BSDF and by both they give the same; and what only eyes see.
#include <gtest/gtest.h>

#include "support/rasters.h"
#include "support/ways.h"

namespace lancer {
namespace {

// A ball over a floor that ends, so that some of what lights it comes from below the horizon.
SceneDescription stage_under(SkyType sky, GroundType ground)
{
    SceneDescription d;
    d.materials = {make_lambert("grey", {0.5f, 0.5f, 0.5f}),
                   make_glossy("rough", MaterialType::metal, {0.9f, 0.8f, 0.7f}, 0.5f)};
    d.spheres = {sphere_of({-0.5, 0.1, 0}, 0.6, "grey"), sphere_of({0.7, 0, 0.2}, 0.5, "rough")};
    d.camera = make_camera({0.2, 0.5, 4}, {0, 0, 0}, 24);
    d.background = BackgroundDescription{};
    d.background->sky = sky;
    d.background->ground = ground;
    return d;
}

// A fish-eye sky with a small sun.
RasterSource fish_eye()
{
    return picture_source(make_raster(64, 64, [](uint32_t x, uint32_t y) {
        const float sun = x == 40 && y == 20 ? 60 : 0;
        return Color{sun + 0.5f + 0.01f * static_cast<float>(x), sun + 0.6f, sun + 0.01f * static_cast<float>(y)};
    }));
}

TEST(Background, IsTheSameByLightSamplingByTheBsdfAndByBoth)
{
    SameByAllWays same(0.03);
    const Shot shot{.width = 16, .height = 16, .spp = 8};
    const Path path{.max_depth = 3};
    same.add("gradient", stage_under(SkyType::gradient, GroundType::none), shot, path, 8);
    same.add("dawn", stage_under(SkyType::dawn, GroundType::none), shot, path, 8);
    SceneDescription z_up = stage_under(SkyType::dusk, GroundType::checker);
    z_up.background->z_up = true;
    z_up.background->strength = 2;
    z_up.lights.push_back(sky_of({0.1f, 0.1f, 0.1f}));
    same.add("checker, z up", z_up, shot, path, 8);
    // With lights that glow: seen by the camera, and once by everything else.
    SceneDescription picture = stage_under(SkyType::picture, GroundType::color);
    picture.background->ground_color = {0.3f, 0.2f, 0.1f};
    picture.background->sky_picture.file = "sky";
    picture.background->sky_picture.projection = Projection::equidistant;
    Shot with_picture = shot;
    with_picture.images = fish_eye();
    same.add("fish-eye with a sun", picture, with_picture, path, 8, {1, 1, 4});
}

// Whoever renders which part in what order, and however large the scene is.
TEST(Background, IsTheSameToTheBit)
{
    SceneDescription d = stage_under(SkyType::dawn, GroundType::checker);
    d.background->glow = true;
    d.lights = {light_of(LightType::point, {1, 2, 3}, {-3, 1, -4}), directional_of({1, 1, 1}, {0, -1, 3})};
    RenderRequest request;
    request.settings.integrator = Path{};
    const Film film = render(d, request).film;
    request.threads = 3, request.tile = 5, request.settings.kernel.batch = 7, request.spp = {5, 11};
    EXPECT_TRUE(same_bits(film, render(d, request).film));
    // The disc of a point light is as bright as a number that is larger in a larger scene.
    d.lights.erase(d.lights.begin());
    const Film without = render(d, request).film;
    for (const int k : {-9, 8})
        EXPECT_TRUE(same_bits(without, render(scaled_by(d, std::ldexp(1.0, k)), request).film)) << k;
}

// A furnace has the same bits whether its walls are an environment or a background.
TEST(Background, OfOneColourIsAnEnvironmentToTheBit)
{
    SceneDescription d = stage_under(SkyType::color, GroundType::none), as_light = d;
    d.background->sky_color = {0.5f, 0.25f, 1};
    d.background->strength = 2;
    as_light.background.reset();
    as_light.lights = {sky_of({1, 0.5f, 2})};
    EXPECT_TRUE(same_bits(shoot(d, {.spp = 8}), shoot(as_light, {.spp = 8})));
}

// White under one colour cannot be told from it, though sky and ground are drawn by the table.
TEST(Background, OfTwoPartsOfOneColourIsAFurnace)
{
    SceneDescription d = stage_under(SkyType::color, GroundType::color);
    d.background->sky_color = d.background->ground_color = {0.5f, 1, 2};
    d.materials = {make_lambert("grey", {1, 1, 1}), make_lambert("rough", {1, 1, 1})};
    stats::Family family;
    for (const DirectLight how : ways) {
        const Film film = shoot(d, {.integrator = Path{.direct = how},
                                    .width = 16,
                                    .height = 16,
                                    .spp = 128,
                                    .sampler = SamplerKind::independent});
        for (const Pixel& p : film.pixels)
            family.add(stats::mean_p(tally(p), static_cast<double>(luminance(Color{0.5f, 1, 2})), 1e-5), "furnace");
    }
}

// The disc of a light is seen straight and in a mirror, and lights no surface.
TEST(Glow, IsSeenAndDoesNotLight)
{
    SceneDescription d;
    d.materials = {make_glossy("mirror", MaterialType::mirror, {1, 1, 1}, 0), make_lambert("grey", {0.5f, 0.5f, 0.5f})};
    d.lights = {directional_of({3, 3, 3}, {0, 0, 1})};  // from -z
    d.planes = {plane_of({0, 0, 50}, {0, 0, -1}, "mirror")};
    d.background = BackgroundDescription{};
    d.background->glow = true;
    for (const char* looked_at : {"straight", "in a mirror"}) {
        const bool straight = std::string(looked_at) == "straight";
        d.camera = make_camera({0, 0, 0}, {0, 0, straight ? -1.0 : 1.0}, 0.05);
        EXPECT_NEAR(tally(shoot(d, {.width = 4, .height = 4, .spp = 4})).mean, 3, 0.1) << looked_at;
    }
    d.planes[0].material = "grey";
    const double lit = 3 * 0.5 / pi_d;
    expect_all_equal(shoot(d, {.width = 4, .height = 4, .spp = 4}), Color{1, 1, 1} * static_cast<float>(lit), 1e-5f,
                     "the light itself, once");
}

}  // namespace
}  // namespace lancer
