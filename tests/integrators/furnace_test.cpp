// Furnaces: places so uniform that the picture is known exactly, whatever the shape.
#include <gtest/gtest.h>

#include "support/ways.h"

namespace lancer {
namespace {

constexpr Color emitted{1, 0.5f, 0.25f};

std::string name_of(DirectLight how) { return way_names[!how.nee ? 2 : how.mis ? 0 : 1]; }

TEST(ClosedFurnace, RadianceIsTheGeometricSeries)
{
    stats::Family family;
    for (const float rho : {0.5f, 0.9f})
        for (const DirectLight how : ways) {
            const Film film = shoot(closed_furnace(rho, emitted), {.integrator = Path{.direct = how},
                                                                   .width = 24,
                                                                   .height = 16,
                                                                   .spp = rho > 0.8f ? 64u : 16u,
                                                                   .sampler = SamplerKind::independent});
            const stats::Tally t = tally(film);
            const double expected = static_cast<double>(luminance(emitted)) / (1 - static_cast<double>(rho));
            EXPECT_LE(t.error(), 0.002 * expected) << rho << name_of(how);
            RecordProperty(name_of(how) + std::to_string(rho),
                           std::to_string(t.mean / expected - 1) + " +- " + std::to_string(t.error() / expected));
            family.add(stats::mean_p(t, expected), std::to_string(rho) + ", " + name_of(how));
        }
}

// max_depth counts the vertices that scatter: d of them give E (1 - rho^(d + 1)) / (1 - rho). By the BSDF alone every
// path brings exactly that.
TEST(ClosedFurnace, TruncatedSeriesCountsScatteringVertices)
{
    for (const uint32_t depth : {1u, 2u, 3u, 8u, 64u}) {
        const float rho = 0.9f, series = (1 - std::pow(rho, static_cast<float>(depth + 1))) / (1 - rho);
        const Path path = without_roulette({.max_depth = depth, .direct = {false, false}});
        expect_all_equal(shoot(closed_furnace(rho, emitted), {.integrator = path, .width = 8, .height = 8}),
                         emitted * series, 1e-5f, "depth " + std::to_string(depth));
    }
}

TEST(ClosedFurnace, TruncatedSeriesBySamplingLights)
{
    stats::Family family;
    for (const uint32_t depth : {1u, 2u, 5u})
        for (const DirectLight how : {ways[0], ways[1]}) {
            const double rho = 0.9, series = (1 - std::pow(rho, depth + 1)) / (1 - rho);
            const Path path = without_roulette({.max_depth = depth, .direct = how});
            const Film film =
                shoot(closed_furnace(0.9f, emitted),
                      {.integrator = path, .width = 16, .height = 16, .spp = 256, .sampler = SamplerKind::independent});
            family.add(stats::mean_p(tally(film), static_cast<double>(luminance(emitted)) * series),
                       name_of(how) + " " + std::to_string(depth));
        }
}

constexpr Color sky{0.5f, 1, 2};

SceneDescription under_sky(const MaterialDescription& m, int shape)
{
    SceneDescription d;
    d.lights.push_back(sky_of(sky));
    if (shape == 0) {
        d.materials = {m};
        d.spheres.push_back(sphere_of({0, 0, 0}, 1, m.name));
    } else {
        d.meshes.push_back(make_mesh(shape == 1 ? make_cube(m) : make_uv_sphere(12, 24, 0.15, m),
                                     {{0, 0, 0}, {20, 30, 40}, {0.8, 0.8, 0.8}}));
    }
    d.camera = make_camera({0.4, 0.5, 3}, {0, 0, 0}, 45);
    return d;
}

// What loses nothing cannot be told from a uniform sky.
TEST(SkyFurnace, WhiteDiffuseThingsAreInvisible)
{
    stats::Family family;
    for (const int shape : {0, 1, 2})
        for (const DirectLight how : ways) {
            const Film film =
                shoot(under_sky(make_lambert("white", {1, 1, 1}), shape), {.integrator = Path{.direct = how},
                                                                           .width = 16,
                                                                           .height = 16,
                                                                           .spp = 128,
                                                                           .sampler = SamplerKind::independent});
            for (const Pixel& p : film.pixels)
                family.add(stats::mean_p(tally(p), static_cast<double>(luminance(sky)), 1e-5),
                           name_of(how) + " shape " + std::to_string(shape));
        }
}

// Neither can mirrors and glass, sample by sample: refraction out undoes refraction in.
TEST(SkyFurnace, MirrorAndGlassAreInvisibleInEverySample)
{
    const Path path = without_roulette({});
    for (const float ior : {1.0f, 1.5f, 0.7f})
        for (const int shape : {0, 1}) {
            MaterialDescription glass = make_lambert("glass", {1, 1, 1});
            glass.type = MaterialType::glass;
            glass.ior = ior;
            expect_all_equal(shoot(under_sky(glass, shape), {.integrator = path}), sky, gamma(256),
                             "glass " + std::to_string(ior));
        }
    MaterialDescription mirror = make_lambert("mirror", {1, 1, 1});
    mirror.type = MaterialType::mirror;
    for (const int shape : {0, 1, 2})
        expect_all_equal(shoot(under_sky(mirror, shape), {.integrator = path}), sky, gamma(8), "mirror");
    for (const int shape : {0, 1, 2})
        expect_all_equal(shoot(under_sky(mirror, shape), {.integrator = Direct{.roulette_depth = no_roulette}}), sky,
                         gamma(8), "mirror, direct");
}

// The mean of a ball under a sky, over that of the sky.
double brightness_of_ball(const MaterialDescription& m, DirectLight how, uint32_t spp = 128)
{
    SceneDescription d = under_sky(m, 0);
    d.camera->fov_deg = 28;  // nothing but the ball, to its edge
    const Film film = shoot(d, {.integrator = Path{.direct = how}, .width = 16, .height = 16, .spp = spp});
    return tally(film).mean / static_cast<double>(luminance(sky));
}

// What facets lose is made up for, as well as the tables say. Light sampling alone hardly finds a narrow lobe.
TEST(SkyFurnace, RoughThingsThatLoseNothingAreInvisible)
{
    for (const float roughness : {0.1f, 0.5f, 1.0f})
        for (const DirectLight how : ways) {
            if (how.nee && !how.mis && roughness < 0.5f) continue;
            const std::string what = name_of(how) + " " + std::to_string(roughness);
            const MaterialDescription metal = make_glossy("metal", MaterialType::metal, {1, 1, 1}, roughness);
            EXPECT_NEAR(brightness_of_ball(metal, how), 1, 0.01) << "metal, " << what;
            for (const float ior : {0.4f, 0.7f, 1.1f, 1.5f, 2.5f}) {
                MaterialDescription glass = make_glossy("glass", MaterialType::glass, {1, 1, 1}, roughness);
                glass.ior = ior;
                // Light is caught inside for long: 32000 paths are right to 1.5 %.
                EXPECT_NEAR(brightness_of_ball(glass, how, ior > 2 ? 1024 : 128), 1, 0.01)
                    << "glass of index " << ior << ", " << what;
            }
            for (const float ior : {0.5f, 0.7f, 1.5f}) {
                MaterialDescription plastic = make_glossy("plastic", MaterialType::plastic, {1, 1, 1}, roughness);
                plastic.ior = ior;
                EXPECT_NEAR(brightness_of_ball(plastic, how), 1, 0.005) << "plastic of index " << ior << ", " << what;
            }
        }
}

TEST(SkyFurnace, WhiteGauzeIsInvisible)
{
    stats::Family family;
    for (const int shape : {0, 1, 2})
        for (const DirectLight how : ways) {
            const Film film =
                shoot(under_sky(make_gauze("gauze", {1, 1, 1}, 0.5f), shape), {.integrator = Path{.direct = how},
                                                                               .width = 16,
                                                                               .height = 16,
                                                                               .spp = 64,
                                                                               .sampler = SamplerKind::independent});
            for (const Pixel& p : film.pixels)
                family.add(stats::mean_p(tally(p), static_cast<double>(luminance(sky)), 1e-5),
                           name_of(how) + " shape " + std::to_string(shape));
        }
}

}  // namespace
}  // namespace lancer
