// Light taken apart: what is seen of emitters, direct light and indirect light are the whole; and the switches that
// simplify boundaries and shadows.
#include <gtest/gtest.h>

#include "materials/fresnel.h"
#include "support/shoot.h"

namespace lancer {
namespace {

using Part = bool RenderSettings::*;
constexpr std::array<Part, 3> parts{&RenderSettings::emitters, &RenderSettings::direct, &RenderSettings::indirect};

RenderSettings only(Part part)
{
    RenderSettings s;
    for (const Part p : parts) s.*p = p == part;
    return s;
}

Film shoot_with(const SceneDescription& d, const RenderSettings& settings)
{
    return shoot(d, {.integrator = make_integrator(settings)});
}

double luminance_of(const Film& film) { return tally(film).mean; }

// The samples are the same in each, so that the parts add up sample by sample; what remains is the rounding of sums.
TEST(LightParts, AddUpToTheWhole)
{
    std::array<double, 3> most{};
    for (const auto& [name, d] : all_test_scenes()) {
        if (build_scene(d).scatters) continue;  // see the next test
        for (const bool nee : {true, false})
            for (const bool mis : {true, false}) {
                const auto said = [&](RenderSettings s) {
                    s.nee = nee, s.mis = mis;
                    return s;
                };
                const Film whole = shoot_with(d, said({}));
                std::vector<Film> part;
                for (size_t i = 0; i < parts.size(); ++i) {
                    part.push_back(shoot_with(d, said(only(parts[i]))));
                    most[i] = std::max(most[i], luminance_of(part.back()) / luminance_of(whole));
                }
                for (size_t k = 0; k < whole.pixels.size(); ++k)
                    for (size_t c = 0; c < 3; ++c) {
                        double sum = 0;
                        for (const Film& f : part) sum += f.pixels[k].sum[c];
                        ASSERT_NEAR(sum, whole.pixels[k].sum[c], 1e-5 * sum + 1e-12) << name << " pixel " << k;
                    }
            }
    }
    for (const double share : most) EXPECT_GT(share, 0.1) << "a part that is hardly there says nothing";
}

// A path of which only the next end counts is not scattered any more, but attenuated: in media that scatter the means
// add up, not the samples.
TEST(LightParts, AddUpInTheMeanWhereMediaScatter)
{
    stats::Family family;
    for (const NamedScene& room : all_test_scenes()) {
        if (!build_scene(room.description).scatters) continue;
        stats::Tally whole, sum;
        for (uint64_t seed = 0; seed < 20; ++seed) {
            const auto luminance_by = [&](const RenderSettings& settings, uint64_t number) {
                Shot shot{.integrator = make_integrator(settings)};
                shot.seed = number;
                return luminance_of(shoot(room.description, shot));
            };
            whole.add(luminance_by({}, seed));
            double parts_of_it = 0;
            for (size_t i = 0; i < parts.size(); ++i)
                parts_of_it += luminance_by(only(parts[i]), 1000 + parts.size() * seed + i);
            sum.add(parts_of_it);
        }
        EXPECT_LT(whole.error() + sum.error(), 0.01 * whole.mean) << room.name << ": too noisy to say anything";
        family.add(stats::welch_p(whole, sum), room.name);
    }
}

// Mirrors and smooth glass are followed until light is spread, as the integrator of that name does it, to the bit.
TEST(LightParts, WithoutIndirectLightIsTheDirectIntegrator)
{
    for (const auto& [name, d] : all_test_scenes()) {
        const RenderSettings switches{.indirect = false, .learned_nee = false, .split = false, .roulette = false};
        EXPECT_TRUE(same_bits(shoot_with(d, switches), shoot_with(d, {.integrator = IntegratorKind::direct}))) << name;
    }
}

// A lamp before the camera, one that it sees in a mirror and one through a pane; nothing else.
SceneDescription lamps()
{
    SceneDescription d;
    MaterialDescription mirror = make_lambert("mirror", {1, 1, 1}), glass = make_lambert("glass", {1, 1, 1});
    mirror.type = MaterialType::mirror;
    glass.type = MaterialType::glass;
    d.materials = {mirror, glass, make_emitter("lamp", {3, 3, 3})};
    d.spheres = {sphere_of({-0.8, 0, 0}, 0.3, "lamp"), sphere_of({0.8, 0, 0}, 0.3, "lamp"),
                 sphere_of({0, 0.3, 4}, 0.5, "lamp"), sphere_of({0, 0, 0}, 0.3, "mirror")};
    d.meshes.push_back(make_mesh(make_cube(glass), {{0.8, 0, 0.7}, {}, {0.5, 0.5, 0.1}}));
    d.lights = {sky_of({0.1f, 0.1f, 0.1f})};
    d.camera = make_camera({0, 0, 3}, {0, 0, 0}, 50);
    return d;
}

TEST(LightParts, EmittersThatAreNotSeenLightTheScene)
{
    SceneDescription d = lamps();
    const auto luminance_by = [&](IntegratorKind kind) {
        return luminance_of(shoot_with(d, {.integrator = kind, .emitters = false}));
    };
    EXPECT_GT(luminance_of(shoot_with(d, {})), 0.1);
    for (const auto kind : {IntegratorKind::path, IntegratorKind::direct})
        EXPECT_EQ(luminance_by(kind), 0) << name_of(kind);
    d.planes.push_back(plane_of({0, -0.5, 0}, {0, 1, 0}));
    for (const auto kind : {IntegratorKind::path, IntegratorKind::direct})
        EXPECT_GT(luminance_by(kind), 0.05) << name_of(kind);
}

// Behind a pane a lamp lights the floor by way of the pane: that is no direct light.
TEST(LightParts, LightThroughGlassIsIndirect)
{
    SceneDescription d;
    MaterialDescription glass = make_lambert("glass", {1, 1, 1});
    glass.type = MaterialType::glass;
    d.materials = {make_emitter("lamp", {3, 3, 3})};
    d.spheres = {sphere_of({0, 2, 0}, 0.8, "lamp")};
    d.planes.push_back(plane_of({0, 0, 0}, {0, 1, 0}));
    d.camera = make_camera({0, 0.3, 0.8}, {0, 0, 0}, 30);
    const double open = luminance_of(shoot_with(d, only(&RenderSettings::direct)));
    EXPECT_GT(open, 0.1);
    EXPECT_EQ(luminance_of(shoot_with(d, only(&RenderSettings::indirect))), 0);
    d.meshes.push_back(make_mesh(make_cube(glass), {{0, 1, 0}, {}, {40, 0.1, 40}}));
    EXPECT_EQ(luminance_of(shoot_with(d, only(&RenderSettings::direct))), 0);
    EXPECT_GT(luminance_of(shoot_with(d, only(&RenderSettings::indirect))), 0.5 * open);
}

// A sphere of light over a floor, with a bar in between; the light itself is not in the picture.
SceneDescription bar_over_floor(double radius)
{
    SceneDescription d;
    d.planes.push_back(plane_of({0, 0, 0}, {0, 1, 0}));
    d.meshes.push_back(make_mesh(make_cube(make_lambert("bar", {})), {{0, 0.8, 0}, {}, {0.2, 0.05, 3}}));
    d.lights = {light_of(LightType::sphere, {20, 16, 12}, {0.3, 4, 0.1}, radius)};
    d.camera = make_camera({0, 3.5, 3}, {0, 0, 0}, 40);
    return d;
}

TEST(SoftShadows, OffIsAPointOfTheSamePower)
{
    SceneDescription sphere = bar_over_floor(0.4), point = sphere;
    sphere.render.soft_shadows = false;
    point.lights[0].type = LightType::point;
    point.lights[0].power *= static_cast<float>(pi_d * 0.4 * 0.4);
    for (const bool mis : {true, false}) {
        const RenderSettings switches{.mis = mis, .indirect = false, .emitters = false};
        const Film a = shoot_with(sphere, switches), b = shoot_with(point, switches);
        size_t dark = 0, lit = 0;
        for (size_t i = 0; i < a.pixels.size(); ++i) {
            ASSERT_NEAR(a.pixels[i].sum[0], b.pixels[i].sum[0], 2e-5 * b.pixels[i].sum[0]) << i;
            (b.pixels[i].sum[0] > 0 ? lit : dark) += 1;
        }
        EXPECT_GT(dark, 30u);
        EXPECT_GT(lit, 300u);
    }
    // And with the switch on it is something else: there is a penumbra.
    sphere.render.soft_shadows = true;
    const RenderSettings direct = only(&RenderSettings::direct);
    EXPECT_FALSE(same_bits(shoot_with(sphere, direct), shoot_with(point, direct)));
}

// Unshadowed light is the same either way, as a sphere shines like a point; indirect light too. By all ways of sampling
// that can find a point.
TEST(SoftShadows, OffLosesNoLight)
{
    SceneDescription soft = bar_over_floor(0.4);
    soft.meshes[0] = make_mesh(make_quad({-2, 0, -2}, {2, 0, -2}, {2, 2, -2}, {-2, 2, -2}));
    SceneDescription hard = soft;
    hard.render.soft_shadows = false;
    const auto found = [](const SceneDescription& d, bool mis, uint64_t seed) {
        return TilesOverSeeds(
            d,
            {.integrator = make_integrator({.max_depth = 3, .mis = mis, .emitters = false}), .spp = 16, .seed = seed});
    };
    expect_one_mean({found(soft, true, 11), found(hard, true, 12), found(hard, false, 13)},
                    {.pictures = 12, .names = {"soft", "hard", "hard without mis"}}, "shadows");
}

// Inside, where the sphere shines inwards, it shines from the centre.
TEST(SoftShadows, OffInsideTheSphere)
{
    SceneDescription d;
    MaterialDescription dome = make_emitter("dome", {2, 2, 2});
    dome.emission_both_sides = true;
    d.materials = {dome};
    d.spheres = {sphere_of({0, 0, 0}, 2, "dome")};
    d.planes.push_back(plane_of({0, -0.5, 0}, {0, 1, 0}));
    d.camera = make_camera({0, 0.5, 0.5}, {0, -0.5, 0}, 1e-3);
    d.render.soft_shadows = false;
    // Albedo 0.8; intensity 2 pi 2^2 at a distance of 0.5, straight above.
    const double expected = 0.8 / pi_d * 2 * pi_d * 4 / 0.25;
    const Film film = shoot_with(d, only(&RenderSettings::direct));
    EXPECT_NEAR(luminance_of(film) / expected, 1, 1e-4);
}

// Seen in a pane before a black room: only what the two sides reflect, R (1 + (1 - R)^2 / (1 - R^2)); and nothing of it
// if boundaries only refract. Through the pane, all light comes.
TEST(Fresnel, OffOnlyRefracts)
{
    MaterialDescription glass = make_lambert("glass", {1, 1, 1});
    glass.type = MaterialType::glass;
    SceneDescription d;
    d.materials = {make_emitter("lamp", {3, 3, 3})};
    d.meshes.push_back(make_mesh(make_cube(glass), {{0, 0, 0}, {}, {4, 4, 0.1}}));
    d.spheres = {sphere_of({0, 0, 9}, 4, "lamp")};
    d.camera = make_camera({0, 0, 2}, {0, 0, 0}, 5);
    const double r = static_cast<double>(fresnel_dielectric(1.0f, 1.5f).reflectance);
    EXPECT_NEAR(tally(shoot(d, {.spp = 256})).mean, 3 * r * (1 + (1 - r) * (1 - r) / (1 - r * r)), 0.01);
    d.render.fresnel = false;
    EXPECT_EQ(tally(shoot(d, {})).mean, 0);
    d.spheres[0].center.z = -9;
    expect_all_equal(shoot(d, {}), {3, 3, 3}, 1e-5f, "through the pane");
}

}  // namespace
}  // namespace lancer
