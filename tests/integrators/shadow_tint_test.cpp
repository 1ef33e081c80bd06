// What shadow rays keep on their way through what refracts.
#include <gtest/gtest.h>

#include "materials/fresnel.h"
#include "support/scenes/classic.h"

namespace lancer {
namespace {

// A white floor seen in one point, and a light far above it: the picture of the bare floor is what shadows are
// measured by.
SceneDescription lit_floor(bool finite = false)
{
    SceneDescription d;
    d.materials = {make_lambert("floor", {1, 1, 1})};
    d.planes.push_back(plane_of({0, 0, 0}, {0, 1, 0}, "floor"));
    if (finite)
        d.lights.push_back(light_of(LightType::point, {9, 9, 9}, {0, 9, 0}));
    else
        d.lights.push_back(directional_of({1, 1, 1}, {0, -1, 0}));
    d.camera = make_camera({9, 0.3, 0}, {0, 0, 0}, 1e-4);
    return d;
}
const Shot one_point{.width = 2, .height = 2, .spp = 4};

// Of the light that reaches the bare floor, the part that is left.
Color shadow_of(const SceneDescription& d, bool legacy, bool finite = false)
{
    const auto seen = [&](const SceneDescription& s) {
        const Film film = shoot_classic(s, Whitted{}, legacy, one_point);
        const Film random = shoot_classic(s, RandomDecision{}, legacy, one_point);
        for (size_t i = 0; i < film.pixels.size(); ++i)
            EXPECT_EQ(film.pixels[i].sum, random.pixels[i].sum) << "diffuse light by both integrators";
        return film.pixels[0].mean();
    };
    const Color lit = seen(lit_floor(finite)), shadow = seen(d);
    EXPECT_GT(lit.r, 0.01f);
    return {shadow.r / lit.r, shadow.g / lit.g, shadow.b / lit.b};
}
void expect_color(Color c, Color expected, float relative, const std::string& what)
{
    EXPECT_NEAR(c.r, expected.r, relative * expected.r) << what;
    EXPECT_NEAR(c.g, expected.g, relative * expected.g) << what;
    EXPECT_NEAR(c.b, expected.b, relative * expected.b) << what;
}
void add_ball(SceneDescription& d, const std::string& material, double height)
{
    if (d.spheres.empty()) d.materials.push_back(make_interface(material, course_material(material)));
    d.spheres.push_back(sphere_of({0, height, 0}, 0.5, material));
}

// Two interfaces, four, and opaque ones.
TEST(CourseShadow, IsTintedByEachInterface)
{
    const auto ball = [](const std::string& material) {
        SceneDescription d = lit_floor();
        add_ball(d, material, 2);
        return shadow_of(d, true);
    };
    expect_color(ball("glass"), {0.866761f, 0.866761f, 0.9604f}, 2e-5f, "glass");
    expect_color(ball("emerald"), {0.003868f, 0.253265f, 0.004225f}, 2e-4f, "emerald");
    expect_color(ball("bronze"), {0, 0, 0}, 0, "bronze");
    expect_color(ball("white_plastic"), {0, 0, 0}, 0, "white plastic");
    SceneDescription d = lit_floor();
    add_bubble(d, "glass", {0, 3, 0}, 2);
    expect_color(shadow_of(d, true), {0.751275f, 0.751275f, 0.922368f}, 2e-5f, "bubble");
}

// Five balls of emerald: behind the ninth interface there is so little left that nothing more is asked, be it a wall.
TEST(CourseShadow, EndsWhereHardlyAnyLightIsLeft)
{
    SceneDescription d = lit_floor();
    for (int i = 0; i < 5; ++i) add_ball(d, "emerald", 1 + 1.1 * i);
    add_ball(d, "emerald", 8);
    const float each = 0.77424f * 0.65f;
    EXPECT_NEAR(shadow_of(d, true).g, std::pow(each, 9.0f), 1e-6f);
    SceneDescription walled = lit_floor();
    for (int i = 0; i < 4; ++i) add_ball(walled, "emerald", 1 + 1.1 * i);
    walled.planes.push_back(plane_of({0, 7, 0}, {0, 1, 0}, "floor"));
    EXPECT_EQ(shadow_of(walled, true).g, 0) << "eight interfaces leave enough to see the wall";
    add_ball(walled, "emerald", 5.5);
    EXPECT_NEAR(shadow_of(walled, true).g, std::pow(each, 9.0f), 1e-6f);
}

// By default what a boundary refracts at that angle, and its tint.
TEST(TintedShadow, ThroughPanesIsWhatTheBoundaryRefracts)
{
    for (const double angle_deg : {0.0, 30.0, 60.0, 80.0})
        for (const float ior : {1.0f, 1.3f, 1.5f, 1 / 1.5f}) {
            const double a = angle_deg * pi_d / 180;
            SceneDescription lit = lit_floor(), d = lit_floor();
            MaterialDescription glass = make_lambert("pane", {0.9f, 0.8f, 1});
            glass.type = MaterialType::glass;
            glass.ior = ior;
            d.materials.push_back(glass);
            for (const double y : {1.0, 2.0}) d.planes.push_back(plane_of({0, y, 0}, {0, y > 1 ? 1. : -1., 0}, "pane"));
            for (SceneDescription* s : {&lit, &d}) s->lights[0].direction = {std::sin(a), -std::cos(a), 0};
            const auto seen = [](const SceneDescription& s) {
                return shoot_classic(s, Whitted{}, false, one_point).pixels[0].mean();
            };
            const double thinner = std::max(ior, 1 / ior);
            const double through =
                1 - fresnel_dielectric_double(std::cos(a), std::sin(a) * std::sin(a), thinner).reflectance;
            const auto both = static_cast<float>(through * through);
            const Color bare = seen(lit);
            d.camera = make_camera({9, 0.3, 0}, {0, 0, 0}, 1e-4);
            const Color shadow = seen(d);
            expect_color({shadow.r / bare.r, shadow.g / bare.g, shadow.b / bare.b}, {0.81f * both, 0.64f * both, both},
                         3e-5f, std::to_string(angle_deg));
        }
}

// Also far from the middle of a ball, where a straight ray would be reflected totally inside.
TEST(TintedShadow, OfAGlassBallIsBrightToItsEdge)
{
    SceneDescription d = lit_floor();
    add_ball(d, "glass", 2);
    for (const double x : {0.0, 0.2, 0.4, 0.48}) {
        d.spheres[0].center.x = x;
        const Color c = shadow_of(d, false);
        EXPECT_GT(c.g, 0.5f) << x;
        EXPECT_LT(c.g, 1) << x;
    }
}

TEST(TintedShadow, OfWhatLiesBehindALampIsThereForTheCourseAlone)
{
    SceneDescription d = lit_floor(true);
    add_ball(d, "bronze", 12);
    expect_color(shadow_of(d, false, true), {1, 1, 1}, 1e-6f, "by default");
    expect_color(shadow_of(d, true, true), {0, 0, 0}, 0, "the course");
}

// A film of index 1 changes nothing, however close to a lamp and however many of them: a ray that went on too far
// would meet the lamp itself.
TEST(TintedShadow, EndsAtTheLampHoweverManySurfacesItPassed)
{
    SceneDescription bare = lights_scene();
    bare.meshes[1].data = make_uv_sphere(10, 20, 0.08, make_lambert("bumpy", {0.3f, 0.5f, 0.7f}));
    bare.camera = make_camera({0, -0.2, 2.5}, {0, -0.6, 0}, 30);  // sees no lamp
    SceneDescription veiled = bare;
    MaterialDescription film = make_lambert("film", {1, 1, 1});
    film.type = MaterialType::glass;
    film.ior = 1;
    veiled.materials.push_back(film);
    for (const double gap : {1e-5, 1e-4, 0.01}) {
        veiled.spheres.push_back(sphere_of({1.5, 2, 1}, 0.2 + gap, "film"));
        veiled.meshes.push_back(make_mesh(
            make_quad({1.2 - gap, 0, -0.3}, {1.2 - gap, 0, 0.3}, {1.2 - gap, 0.6, 0.3}, {1.2 - gap, 0.6, -0.3}, film)));
    }
    const Shot shot{.width = 32, .height = 24, .spp = 16};
    const Film a = shoot_classic(bare, Whitted{}, false, shot), b = shoot_classic(veiled, Whitted{}, false, shot);
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        const float x = a.pixels[i].mean().g;
        ASSERT_NEAR(b.pixels[i].mean().g, x, 1e-4f * x);
    }
    EXPECT_GT(tally(a).mean, 0.05);
}

// A half-open sheet stops half of the rays, also in this kind of shadow.
TEST(TintedShadow, OfGauzeIsItsPart)
{
    SceneDescription d = lit_floor();
    d.materials.push_back(make_gauze("gauze", {}, 0.3f));
    for (const double y : {1.0, 2.0}) d.planes.push_back(plane_of({0, y, 0}, {0, 1, 0}, "gauze"));
    const stats::Tally bare = tally(shoot_classic(lit_floor(), Whitted{}, false, one_point));
    const stats::Tally veiled = tally(shoot_classic(
        d, Whitted{}, false, {.width = 4, .height = 4, .spp = 1024, .sampler = SamplerKind::independent}));
    EXPECT_GT(stats::mean_p(veiled, bare.mean * 0.7 * 0.7), claim_level);
}

}  // namespace
}  // namespace lancer
