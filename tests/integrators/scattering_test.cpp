// Media that scatter, where what is seen can be worked out on paper, and by all ways to find light.
#include <gtest/gtest.h>

#include "support/half_space.h"
#include "support/refused.h"
#include "support/scenes/media_scenes.h"
#include "support/ways.h"

namespace lancer {
namespace {

constexpr double per_degree = std::numbers::pi / 180;

CameraDescription narrow_view(Vec3d from, Vec3d at)
{
    CameraDescription c = make_camera(from, at, 1e-4);
    const Vec3d way = normalize(at - from);
    c.up = std::abs(way.y) > 0.9 ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
    return c;
}
// One pixel's worth of independent samples.
Shot narrow_shot(uint32_t spp, Path path = {})
{
    return {.integrator = path, .width = 8, .height = 8, .spp = spp, .sampler = SamplerKind::independent};
}

// Of what a lamp sends through a slab only that which goes straight on: exp(-sigma d) in each channel, by bodies of
// either kind, one within another, and by fog.
TEST(Scattering, LetsTheExponentialGoStraightOn)
{
    stats::Family family;
    Path straight;
    straight.parts.direct = straight.parts.indirect = false;
    for (const int kind : {0, 1, 2, 3})
        for (const double angle : {0.0, 50.0}) {
            SceneDescription d;
            const Color s{0.5f, 1.5f, 3}, a{0.1f, 0, 0.5f};
            MaterialDescription lamp = make_emitter("lamp", {1, 1, 1});
            lamp.emission_both_sides = true;
            d.materials = {make_scattering("slab", 1, s, a, 0.3f), lamp};
            if (kind == 0) {
                d.planes = {plane_of({0, 0, 0}, {0, 1, 0}, "slab"), plane_of({0, -0.5, 0}, {0, -1, 0}, "slab")};
            } else if (kind != 2) {
                d.meshes.push_back(make_mesh(make_cube(), {{0, -0.25, 0}, {0, 0, 0}, {90, 0.25, 80}}));
                d.meshes.back().material = "slab";
                // More of the same inside: flights go on behind its border as if they were new ones.
                if (kind == 3) d.meshes.push_back(make_mesh(make_cube(), {{0, -0.25, 0}, {0, 0, 0}, {80, 0.08, 70}}));
                d.meshes.back().material = "slab";
            } else {
                d.materials.erase(d.materials.begin());
                d.fog = fog_of(s, a, 0.3f);
                d.fog->low = Vec3d{-50, -0.5, -50}, d.fog->high = Vec3d{50, 0, 50};
            }
            d.planes.push_back(plane_of({0, -3, 0}, {0, 1, 0}, "lamp"));
            d.camera =
                narrow_view(Vec3d{std::sin(angle * per_degree), std::cos(angle * per_degree), 0} * 2.0, {0, 0, 0});
            const double way = 0.5 / std::cos(angle * per_degree);
            const auto left = [&](float scattered, float absorbed) {
                return std::exp(-(double{scattered} + double{absorbed}) * way);
            };
            family.add(stats::mean_p(tally(shoot(d, narrow_shot(512, straight))),
                                     luminance(left(s.r, a.r), left(s.g, a.g), left(s.b, a.b)), 2e-5),
                       std::to_string(kind) + ", " + std::to_string(angle));
        }
}

// int s exp(-k (t + r)) p(cos) I / r^2 dt along the ray, by Simpson's rule in the angle at which the lamp sees it.
double single_scattering(Vec3d from, Vec3d way, Vec3d lamp, double s, double k, double g, double to)
{
    const long double closest = dot(lamp - from, way);
    const long double distance = length(lamp - from - way * static_cast<double>(closest));
    const long double begin = std::atan(-closest / distance), end = std::atan((to - closest) / distance);
    const auto at = [&](long double angle) {
        const long double t = closest + distance * std::tan(angle), r = distance / std::cos(angle);
        const long double cosine = (closest - t) / r;
        const long double phase = (1 - g * g) / (4 * std::numbers::pi_v<long double> *
                                                 std::pow(1 + static_cast<long double>(g * g) - 2 * g * cosine, 1.5L));
        return s * std::exp(-k * (t + r)) * phase / distance;  // dt / r^2 = d angle / distance
    };
    constexpr int steps = 20000;
    const long double h = (end - begin) / steps;
    long double sum = at(begin) + at(end);
    for (int i = 1; i < steps; ++i) sum += at(begin + h * i) * (i % 2 ? 4 : 2);
    return static_cast<double>(sum * h / 3);
}

// A lamp in fog without end, near the ray and far from it, before the camera and behind it.
TEST(Scattering, OnceAroundALampIsTheIntegralAlongTheRay)
{
    stats::Family family;
    Path once;
    once.max_depth = 1;
    for (const float g : {0.0f, 0.7f, -0.5f})
        for (const Vec3d lamp : {Vec3d{0.01, 0, 0}, Vec3d{0.3, 0.1, 0}, Vec3d{2, 0, -1}, Vec3d{0.2, 0, 3}})
            for (const bool by_lamp : {true, false}) {
                SceneDescription d;
                d.fog = fog_of({0.4f, 0.4f, 0.4f}, {0.2f, 0.2f, 0.2f}, g);
                d.fog->low = Vec3d{-1000, -1000, -1000};
                d.materials = {make_lambert("black", {0, 0, 0})};
                d.spheres = {sphere_of({0, -3, 0}, 0.1, "black")};  // beside the ray: it gives the scene its size
                d.lights = {light_of(LightType::point, {2, 2, 2}, lamp)};
                const Vec3d from{0, 0, 2.5};
                d.camera = narrow_view(from, {0, 0, 0});
                once.direct.near_lights = by_lamp;
                const stats::Tally t = tally(shoot(d, narrow_shot(by_lamp ? 256 : 2048, once)));
                const double expected = 2 * single_scattering(from, {0, 0, -1}, lamp, 0.4, 0.6, double{g}, 60);
                const std::string what = std::to_string(g) + " " + std::to_string(lamp.x) + " " +
                                         std::to_string(lamp.z) + (by_lamp ? " by the lamp" : "");
                EXPECT_LT(t.error(), (by_lamp ? 0.05 : 0.2) * expected) << what;
                family.add(stats::mean_p(t, expected, 5e-5), what);
            }
}

// A half-space below a white sky, against Chandrasekhar: by one colour channel after the other and by all three at
// once, whose free paths differ. A rounding in 1 of 1e6 walks lets it out of the half-space.
TEST(Scattering, HalfSpaceReflectsAsChandrasekharSays)
{
    stats::Family family;
    const auto seen = [&](Color albedo, Color extinction, double angle) {
        SceneDescription d;
        d.materials = {make_scattering("half", 1, albedo * extinction, (Color{1, 1, 1} - albedo) * extinction)};
        d.planes = {plane_of({0, 0, 0}, {0, 1, 0}, "half")};
        d.lights = {sky_of({1, 1, 1})};
        d.camera = narrow_view(Vec3d{std::sin(angle * per_degree), std::cos(angle * per_degree), 0}, {0, 0, 0});
        const stats::Tally t = tally(shoot(d, narrow_shot(max_component(albedo) < 0.5f ? 2560 : 768)));
        const auto exact = [&](float a) { return HalfSpace(double{a}).reflects(std::cos(angle * per_degree)); };
        const double expected = luminance(exact(albedo.r), exact(albedo.g), exact(albedo.b));
        EXPECT_LT(4 * t.error(), 0.02 * expected);
        family.add(stats::mean_p(t, expected, 2e-4), std::to_string(albedo.r) + " at " + std::to_string(angle));
    };
    for (const double angle : {0.0, 60.0, 80.0})
        for (const float albedo : {0.3f, 0.8f, 0.98f}) seen({albedo, albedo, albedo}, {5, 5, 5}, angle);
    seen({0.9f, 0.5f, 0.2f}, {1, 3, 20}, 30);
    seen({0.95f, 0.95f, 0.95f}, {1, 5, 25}, 30);
}

// Light is neither made nor lost, in bodies of any surface: a white furnace, white media, and a half-space.
TEST(Scattering, WhiteMediaAreNotSeenInAWhiteFurnace)
{
    stats::Family family;
    for (const float ior : {1.0f, 1.4f})
        for (const float roughness : {0.0f, 0.5f})
            for (const float g : {0.0f, 0.8f}) {
                SceneDescription d;
                d.materials = {make_scattering("milk", ior, {3, 6, 12}, {}, g)};
                d.materials[0].roughness = roughness;
                d.spheres = {sphere_of({0, 0, 0}, 0.5, "milk")};
                d.lights = {sky_of({1, 1, 1})};
                d.camera = narrow_view({0, 0.2, 2}, {0.15, 0.1, 0});
                const stats::Tally t = tally(shoot(d, narrow_shot(256)));
                EXPECT_LT(4 * t.error(), 0.05);
                // Rough glass keeps its energy to 0.3 %, and a walk meets it often.
                family.add(stats::mean_p(t, 1, ior == 1 || roughness == 0 ? 1e-3 : 0.02),
                           std::to_string(ior) + " " + std::to_string(roughness) + " " + std::to_string(g));
            }
}

// Lights that rays meet, in fog and in bodies, by light samples, by the phase function, and by both.
TEST(Scattering, IsTheSameByAllWaysToFindLight)
{
    SameByAllWays same(0.05);
    same.add("fog", fog_scene(), {.width = 16, .height = 16, .spp = 32}, Path{}, 12, {1, 1, 4});
    same.add("bodies", scattering_scene(), {.width = 16, .height = 16, .spp = 32}, Path{}, 12, {1, 1, 4});
}

void expect_near_lights_agree(const SceneDescription& d, const std::string& name)
{
    std::vector<TilesOverSeeds> found;
    Path path;
    for (const bool by_lamp : {true, false}) {
        path.direct.near_lights = by_lamp;
        found.emplace_back(
            d, Shot{.integrator = path, .width = 16, .height = 16, .spp = by_lamp ? 32u : 128u, .seed = by_lamp});
    }
    expect_one_mean(std::move(found), {.pictures = 12, .detectable = 0.06, .names = {"by lamps", "by distance"}}, name);
}
TEST(Scattering, IsTheSameWithoutPlacesThatLampsChoose)
{
    expect_near_lights_agree(fog_between_points(), "points");
    SceneDescription lamps = fog_scene();
    lamps.lights = {light_of(LightType::sphere, {60, 50, 40}, {0.2, 0.45, 0.8}, 0.06),
                    light_of(LightType::sphere, {20, 30, 40}, {-0.4, 0.9, 0.5}, 0.1), sky_of({0.1f, 0.1f, 0.1f})};
    expect_near_lights_agree(lamps, "lamps");
    for (int i = 0; i < 70; ++i)
        lamps.lights.push_back(light_of(LightType::point, {0.02f, 0.02f, 0.02f}, {0.04 * i - 1.4, 0.3, 0.7}));
    ASSERT_TRUE(build_scene(lamps).lights.tree);
    expect_near_lights_agree(lamps, "many lamps");
}

// A box of gas in the fog, whose border is nothing, is the same as fog of another density there; a sphere within a
// sphere of the same is not seen.
TEST(Scattering, BordersThatBendNothingAreNoVertices)
{
    SceneDescription whole = fog_scene();
    whole.fog.reset();
    whole.spheres.clear();
    whole.materials.push_back(make_scattering("smoke", 1, {0.5f, 0.4f, 0.3f}, {0.1f, 0.2f, 0.2f}, 0.2f));
    whole.spheres = {sphere_of({0, 0.3, 0.2}, 0.7, "smoke")};
    SceneDescription nested = whole, fog = whole;
    nested.spheres.push_back(sphere_of({0.1, 0.3, 0.2}, 0.3, "smoke"));
    fog.spheres.clear();
    fog.meshes = {make_mesh(make_cube(), {{0, 0.3, 0.2}, {0, 0, 0}, {0.5, 0.5, 0.5}})};
    fog.meshes.back().material = "smoke";
    SceneDescription box = fog;
    box.meshes.clear();
    box.fog = fog_of({0.5f, 0.4f, 0.3f}, {0.1f, 0.2f, 0.2f}, 0.2f);
    box.fog->low = Vec3d{-0.5, -0.2, -0.3}, box.fog->high = Vec3d{0.5, 0.8, 0.7};
    Path path;
    path.max_depth = 3;
    const auto one_mean = [&](const SceneDescription& a, const SceneDescription& b, const char* name) {
        const Shot shot{.integrator = path, .width = 16, .height = 16, .spp = 32};
        std::vector<TilesOverSeeds> found;
        found.emplace_back(a, shot);
        found.emplace_back(b, shot);
        expect_one_mean(std::move(found), {.pictures = 12, .detectable = 0.02}, name);
    };
    one_mean(whole, nested, "a ball within a ball");
    one_mean(fog, box, "a box of fog and a body");
}

TEST(Scattering, CostsNothingWhereThereIsNone)
{
    EXPECT_FALSE(build_scene(media_scene()).scatters);
    EXPECT_TRUE(build_scene(fog_scene()).scatters);
    SceneDescription d = fog_scene();
    d.render.integrator = IntegratorKind::whitted;
    const Scene classic = build_scene(d);
    EXPECT_FALSE(classic.scatters);
    EXPECT_TRUE(classic.ignores_scattering);
    EXPECT_FALSE(is_black(classic.media[classic.fog.medium].absorption));
    d.render.legacy = true;
    EXPECT_TRUE(build_scene(d).media.empty());
    EXPECT_EQ(sizeof(PathState), 136u) << "each path of a batch has one: what few scenes need goes elsewhere";
}

TEST(Scattering, RefusesWhatCannotBe)
{
    SceneDescription d = scattering_scene();
    d.materials[0].opacity = 0.5f;
    expect_refused(d, "material 'cloud' has 'absorption' and an opacity");
    d = scattering_scene();
    d.materials[2].thin = true;
    expect_refused(d, "material 'wax' is thin and has a 'subsurface_color'");
    d = scattering_scene();
    d.materials[2].scattering = {1, 1, 1};
    expect_refused(d, "material 'wax' has a 'subsurface_color', which says what is inside");
}

// A lamp in a body of milk is found by light samples; without one there, none are sent.
TEST(Scattering, KnowsBodiesWithoutALightInside)
{
    SceneDescription d = scattering_scene();
    const auto dark = [](const SceneDescription& of) {
        const Scene s = build_scene(of);
        return s.media[s.traits[s.sphere_material[1]].medium].is_dark;
    };
    EXPECT_TRUE(dark(d));
    d.lights.push_back(light_of(LightType::point, {1, 1, 1}, {0.1, 0, 0}));
    EXPECT_FALSE(dark(d));
    d.lights.back() = light_of(LightType::sphere, {1, 1, 1}, {0.1, 0, 0}, 0.1);
    EXPECT_FALSE(dark(d));
}

}  // namespace
}  // namespace lancer
