// Pictures whose pixels can be worked out on paper.
#include <gtest/gtest.h>

#include "materials/fresnel.h"
#include "support/random.h"
#include "support/scenes/lit_places.h"
#include "support/shoot.h"

namespace lancer {
namespace {

// A floor of albedo 1/2, of either kind, looked at so narrowly that the picture is one point of it.
SceneDescription floor_at(Vec3d point, bool mesh)
{
    SceneDescription d;
    d.materials = {make_lambert("floor", {0.5f, 0.5f, 0.5f})};
    if (mesh) {
        d.meshes.push_back(make_mesh(make_quad({-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4})));
        d.meshes[0].material = "floor";
    } else {
        d.planes.push_back(plane_of({0, 0, 0}, {0, 1, 0}, "floor"));
    }
    d.camera = make_camera(point + Vec3d{-3, 0.4, 2}, point, 1e-4);
    return d;
}

TEST(PointLight, LightsAPlaneByTheCosineOverTheSquare)
{
    const double pi_d = std::numbers::pi;
    for (const bool mesh : {false, true})
        for (const double height : {0.05, 1.0, 3.0})
            for (const Vec3d at : {Vec3d{0, 0, 0}, Vec3d{0.5, 0, -0.7}, Vec3d{2, 0, 1}}) {
                SceneDescription d = floor_at(at, mesh);
                d.lights.push_back(light_of(LightType::point, {3, 3, 3}, {0.1, height, 0.2}));
                const Vec3d to = Vec3d{0.1, height, 0.2} - at;
                const double expected = 0.5 / pi_d * 3 * height / std::pow(dot(to, to), 1.5);
                const Film film = shoot(d, {.width = 4, .height = 4});
                // The picture is 6e-6 wide: what that changes beside the light's height, and a dozen roundings.
                const double bound = 1e-6 + 1e-5 / height;
                EXPECT_NEAR(tally(film).mean / expected, 1, bound) << mesh << height << at.x;
            }
}

TEST(PointLight, InOrBelowThePlaneGivesNothing)
{
    for (const bool mesh : {false, true})
        for (const double height : {0.0, -1e-6, -0.5}) {
            SceneDescription d = floor_at({0.3, 0, 0.2}, mesh);
            d.lights.push_back(light_of(LightType::point, {3, 3, 3}, {0.1, height, 0.1}));
            EXPECT_EQ(tally(shoot(d, {.width = 4, .height = 4})).mean, 0) << mesh << height;
        }
}

// E = pi L (r / d)^2 cos(theta) as long as the whole sphere is above the horizon.
TEST(SphereLight, LightsAPlaneByItsSolidAngle)
{
    stats::Family family;
    for (const bool mesh : {false, true})
        for (const double radius : {0.5, 0.1, 1e-3})
            for (const Vec3d at : {Vec3d{0, 0, 0}, Vec3d{0.5, 0, -0.7}, Vec3d{2, 0, 1}})
                for (const bool nee : {true, false}) {
                    if (!nee && radius < 0.5) continue;  // the BSDF alone hardly finds it
                    SceneDescription d = floor_at(at, mesh);
                    d.lights.push_back(light_of(LightType::sphere, {3, 3, 3}, {0.1, 1, 0.2}, radius));
                    const Vec3d to = Vec3d{0.1, 1, 0.2} - at;
                    const double expected = 0.5 * 3 * radius * radius / std::pow(dot(to, to), 1.5);
                    const Film film = shoot(d, {.integrator = Path{.max_depth = 1, .direct = {nee, nee}},
                                                .width = 4,
                                                .height = 4,
                                                .spp = 4096,
                                                .sampler = SamplerKind::independent});
                    const stats::Tally t = tally(film);
                    EXPECT_LE(t.error(), 0.05 * expected) << "too noisy to tell";
                    family.add(stats::mean_p(t, expected, 2e-5), "radius " + std::to_string(radius));
                }
}

TEST(Hidden, LightsGiveExactlyNothing)
{
    for (const SceneDescription& d : hidden_lights())
        for (const AccelKind accel : {AccelKind::embree, AccelKind::list}) {
            const Film film = shoot(d, {.spp = 64, .accel = accel});
            for (const Pixel& p : film.pixels) ASSERT_EQ(p.sum[0] + p.sum[1] + p.sum[2], 0);
        }
}

// Two mirrors facing each other: 250 reflections from the camera to the sky.
TEST(Mirrors, FacingEachOtherMultiply)
{
    const Color tint{1, 0.999f, 0.9f};
    SceneDescription d;
    MaterialDescription mirror = make_lambert("mirror", tint);
    mirror.type = MaterialType::mirror;
    d.meshes.push_back(make_mesh(make_quad({-1, -5, -5}, {-1, 5, -5}, {-1, 5, 5}, {-1, -5, 5}, mirror)));
    d.meshes.push_back(make_mesh(make_quad({1, -5, 5}, {1, 5, 5}, {1, 5, -5}, {1, -5, -5}, mirror)));
    d.lights.push_back(sky_of({2, 2, 2}));
    d.camera = make_camera({0, 0, 0}, {1, 0.01, 0}, 1e-4);  // heights 0.01, 0.03, ... 4.99: 250 of them
    constexpr int n = 250;
    const auto seen = [&](float t) { return 2 * std::pow(t, static_cast<float>(n)); };
    const Shot shot{.integrator = without_roulette({}), .width = 2, .height = 2};
    expect_all_equal(shoot(d, shot), {seen(tint.r), seen(tint.g), seen(tint.b)}, gamma(2 * n), "250 mirrors");
    Shot deep = shot;
    deep.integrator = without_roulette({.max_depth = n});
    EXPECT_TRUE(same_bits(shoot(d, deep), shoot(d, shot))) << "the sky is seen after the last of 250";
    deep.integrator = without_roulette({.max_depth = n - 1});
    expect_all_equal(shoot(d, deep), {0, 0, 0}, 0, "one vertex too few");
    deep.integrator = Direct{.roulette_depth = no_roulette};
    expect_all_equal(shoot(d, deep), {seen(tint.r), seen(tint.g), seen(tint.b)}, gamma(2 * n), "by direct light");
}

// From within glass: nothing of the lamp outside beyond the critical angle; before it (1 - R) eta^2 of its radiance.
TEST(GlassBoundary, RefractsRadianceAndReflectsTotally)
{
    SceneDescription d;
    MaterialDescription glass = make_lambert("glass", {1, 1, 1});
    glass.type = MaterialType::glass;
    MaterialDescription lamp = make_emitter("lamp", {1, 1, 1});
    lamp.emission_both_sides = true;
    d.materials = {glass, lamp};
    d.planes = {plane_of({0, 0, 0}, {0, 1, 0}, "glass"), plane_of({0, 5, 0}, {0, 1, 0}, "lamp")};
    stats::Family family;
    for (const double angle_deg : {0.0, 20.0, 41.0, 42.0, 60.0, 85.0}) {
        const double angle = angle_deg * std::numbers::pi / 180;
        d.camera = make_camera({0, -1, 0}, {std::sin(angle), -1 + std::cos(angle), 0}, 1e-4);
        d.camera->up = {0, 0, 1};
        const Film film = shoot(d, {.integrator = without_roulette({}),
                                    .width = 8,
                                    .height = 8,
                                    .spp = 256,
                                    .sampler = SamplerKind::independent});
        if (angle_deg > 41.8) {
            expect_all_equal(film, {0, 0, 0}, 0, "total reflection at " + std::to_string(angle_deg));
            continue;
        }
        const float r = fresnel_dielectric(static_cast<float>(std::cos(angle)), 1 / 1.5f).reflectance;
        family.add(stats::mean_p(tally(film), static_cast<double>((1 - r) * 1.5f * 1.5f)), std::to_string(angle_deg));
    }
}

// A lamp seen in the surface of glass, from outside and from within, at all angles: the part that the exact equations
// say, and all of it beyond the critical angle.
TEST(GlassBoundary, ReflectsByTheFresnelEquationsFromEitherSide)
{
    SceneDescription d;
    MaterialDescription glass = make_lambert("glass", {1, 1, 1});
    glass.type = MaterialType::glass;
    MaterialDescription lamp = make_emitter("lamp", {1, 1, 1});
    lamp.emission_both_sides = true;
    d.materials = {glass, lamp};
    stats::Family family;
    for (const double side : {1.0, -1.0})
        for (const double angle_deg : {0.0, 15.0, 30.0, 40.0, 41.5, 42.0, 56.3, 70.0, 80.0, 85.0, 89.0, 89.9}) {
            const double angle = angle_deg * std::numbers::pi / 180, cos = std::cos(angle);
            d.planes = {plane_of({0, 0, 0}, {0, 1, 0}, "glass"), plane_of({0, 3 * side, 0}, {0, 1, 0}, "lamp")};
            d.camera = make_camera({std::sin(angle), side * cos, 0}, {0, 0, 0}, 1e-4);
            d.camera->up = {0, 0, 1};
            const Film film = shoot(d, {.integrator = without_roulette({}),
                                        .width = 8,
                                        .height = 8,
                                        .spp = 1024,
                                        .sampler = SamplerKind::independent});
            const double r =
                fresnel_dielectric_double(cos, (1 - cos) * (1 + cos), side > 0 ? 1.5 : 1 / 1.5).reflectance;
            const std::string what = (side > 0 ? "outside " : "inside ") + std::to_string(angle_deg);
            if (r == 1)
                expect_all_equal(film, {1, 1, 1}, 0, "total reflection, " + what);
            else
                family.add(stats::mean_p(tally(film), r, 2e-5), what);
        }
}

// A pane of index 1 before the camera changes nothing: exactly where there is no noise.
TEST(GlassPane, OfIndexOneIsNotSeen)
{
    SceneDescription bare;
    for (int i = 0; i < 9; ++i) {
        const auto x = static_cast<float>(i % 3), y = static_cast<float>(i / 3);
        bare.lights.push_back(light_of(LightType::sphere, {1 + x, 1 + y, 2}, {i % 3 - 1.0, i / 3 - 1.0, 0}, 0.4));
    }
    bare.lights.push_back(sky_of({0.1f, 0.2f, 0.3f}));
    bare.camera = make_camera({0.1, 0.2, 5}, {0, 0, 0}, 40);
    SceneDescription pane = bare;
    MaterialDescription nothing = make_lambert("nothing", {1, 1, 1});
    nothing.type = MaterialType::glass;
    nothing.ior = 1;
    pane.meshes.push_back(make_mesh(make_cube(nothing), {{0, 0, 2}, {0, 0, 0}, {4, 4, 0.1}}));
    const Shot shot{.integrator = without_roulette({}), .spp = 4};
    const Film a = shoot(bare, shot), b = shoot(pane, shot);
    int differing = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        const Color x = a.pixels[i].mean(), y = b.pixels[i].mean();
        differing += std::abs(x.r - y.r) > 1e-6f || std::abs(x.g - y.g) > 1e-6f || std::abs(x.b - y.b) > 1e-6f;
    }
    // A sample on the very rim of a sphere may fall on its other side by a rounding.
    EXPECT_LE(differing, 1);
}

}  // namespace
}  // namespace lancer
