// Rooms whose walls are spheres far larger than the rooms, and what glass does to the light of a lamp.
#include <gtest/gtest.h>

#include "support/ways.h"

namespace lancer {
namespace {

// Six spheres of radius 940 around a room of 120, and a ball of radius 10 in it. All of them shine with E and reflect
// 0.8: wherever one looks there is E / (1 - 0.8).
SceneDescription white_room()
{
    SceneDescription d;
    MaterialDescription white = make_lambert("white", {0.8f, 0.8f, 0.8f});
    white.emission = {0.2f, 0.1f, 0.3f};
    d.materials = {white};
    for (const Vec3d axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}})
        for (const double side : {-1000.0, 1000.0}) d.spheres.push_back(sphere_of(axis * side, 940, "white"));
    d.spheres.push_back(sphere_of({0, 0, 15}, 10, "white"));
    d.camera = make_camera({0, 0, 55}, {0, 0, 0}, 60);
    return d;
}

TEST(WhiteRoom, OfGiantSpheresHasTheRadianceOfTheSeries)
{
    const double expected = static_cast<double>(luminance(white_room().materials[0].emission)) / 0.2;
    stats::Family family;
    for (size_t i = 0; i < ways.size(); ++i) {
        const Film film = shoot(white_room(), {.integrator = Path{.direct = ways[i]},
                                               .width = 24,
                                               .height = 24,
                                               .spp = i == 1 ? 256u : 128u,
                                               .sampler = SamplerKind::independent});
        const stats::Tally t = tally(film);
        EXPECT_LT(t.error(), 0.005 * expected) << way_names[i];
        std::printf("%s: %.3g %% off, one sigma is %.2g %%\n", way_names[i], 100 * (t.mean / expected - 1),
                    100 * t.error() / expected);
        family.add(stats::mean_p(t, expected, 1e-5), way_names[i]);
    }
}

// By the BSDF alone, in every sample: no ray finds a gap between the walls, and none is lost.
TEST(WhiteRoom, LosesNoRay)
{
    for (const uint32_t depth : {1u, 6u, 40u}) {
        const float series = (1 - std::pow(0.8f, static_cast<float>(depth + 1))) / 0.2f;
        const Path path = without_roulette({.max_depth = depth, .direct = {false, false}});
        expect_all_equal(shoot(white_room(), {.integrator = path}), white_room().materials[0].emission * series, 2e-5f,
                         "depth " + std::to_string(depth));
    }
}

// scenes/seed-b/caustic.toml, at its region of the caustic.
SceneDescription caustic()
{
    SceneDescription d;
    MaterialDescription glass = make_lambert("glass", {1, 1, 1});
    glass.type = MaterialType::glass;
    d.materials = {glass, make_lambert("floor", {0.8f, 0.8f, 0.8f})};
    d.spheres = {sphere_of({0, 0, 0}, 8, "glass"), sphere_of({0, -1000, 0}, 990, "floor")};
    d.lights = {light_of(LightType::sphere, {40, 40, 40}, {-20, 40, 10}, 6)};
    d.camera = make_camera({0, 15, 55}, {0, -3, 0}, 40);
    return d;
}
constexpr Tile caustic_region{70, 58, 78, 63};

stats::Tally look_at_caustic(const AnyIntegrator& integrator, uint32_t spp, uint64_t seed)
{
    SceneDescription scene = caustic();
    scene.render.legacy = std::holds_alternative<LegacyPath>(integrator);
    RenderRequest r;
    r.width = 128, r.height = 96, r.crop = caustic_region, r.spp = {spp}, r.threads = 2;
    r.settings.integrator = integrator;
    r.settings.kernel.sampler = SamplerKind::independent;
    r.settings.kernel.seed = salted(seed);
    const Rendered out = render(scene, r);
    EXPECT_EQ(out.counters.dropped, 0u);
    return tally(out.film);
}

TEST(Caustic, OfAGlassBallIsFoundByTheDefaultPath)
{
    const stats::Tally both = look_at_caustic(Path{.direct = ways[0]}, 2048, 1);
    const stats::Tally bsdf = look_at_caustic(Path{.direct = ways[2]}, 2048, 2);
    EXPECT_LT(both.error(), 0.02 * both.mean);
    EXPECT_GE(stats::welch_p(both, bsdf), claim_level) << both.mean << " against " << bsdf.mean;
    EXPECT_EQ(look_at_caustic(Path{.max_depth = 1}, 16, 3).mean, 0) << "of direct light there is only shadow";
    const stats::Tally legacy = look_at_caustic(LegacyPath{}, 2048, 4);
    EXPECT_GE(both.mean - 4 * both.error(), 3 * (legacy.mean + 4 * legacy.error())) << "light sampling alone loses it";
    std::printf("caustic: %.4g by nee and mis, %.4g by the bsdf, sigma %.2g\n", both.mean, bsdf.mean, both.error());
}

}  // namespace
}  // namespace lancer
