// Backgrounds: the named skies and the checker to the letter, lights seen as discs, the table that draws them.
#include "scene/environment/background.h"

#include <gtest/gtest.h>

#include "scene/environment/environment.h"
#include "support/random.h"
#include "support/rasters.h"
#include "support/scenes/scenes.h"
#include "support/statistics/significance.h"

namespace lancer {
namespace {

BackgroundDescription background_of(SkyType sky, GroundType ground = GroundType::none)
{
    BackgroundDescription b;
    b.sky = sky, b.ground = ground;
    b.z_up = true;
    return b;
}
Color eval(const BackgroundDescription& b, Vec3 d, float spread = 0, bool legacy = false)
{
    return Background(b, nullptr, nullptr, legacy).eval(d, spread);
}
// A direction of this height above the horizon, as a sine.
Vec3 at_height(double z, double azimuth = 0.7)
{
    const double r = std::sqrt(1 - z * z);
    return to_float(Vec3d{r * std::cos(azimuth), r * std::sin(azimuth), z});
}
void expect_near(Color c, std::array<double, 3> expected, double error, const std::string& what)
{
    EXPECT_NEAR(c.r, expected[0], error) << what;
    EXPECT_NEAR(c.g, expected[1], error) << what;
    EXPECT_NEAR(c.b, expected[2], error) << what;
}

// The formulas of the course, in its own way of writing them.
std::array<double, 3> lerp(std::array<double, 3> a, std::array<double, 3> b, double t)
{
    return {a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t};
}
std::array<double, 3> gradient(double z)
{
    if (z <= 0.5) return {1 - 2 * z, 1 - 2 * z, 1};
    return {0, 0, 2 - 2 * z};
}
std::array<double, 3> dusk(double z)
{
    if (z <= 0.5) return gradient(z);
    return {0, 0, 1.5 - z};
}
std::array<double, 3> dawn(double z)
{
    if (z >= 0.6) return {0, 0, 0.1};
    if (z >= 0.4) return lerp({0.1, 0.1, 0.2}, {0, 0, 0.1}, (z - 0.4) / 0.2);
    if (z >= 0.2) return lerp({0.5, 0.1, 0.1}, {0.1, 0.1, 0.2}, (z - 0.2) / 0.2);
    return lerp({1, 1, 0.3}, {0.5, 0.1, 0.1}, z / 0.2);
}
std::array<double, 3> checker(Vec3d d, std::array<double, 3> far)
{
    double x = -0.5 * d.x / d.z, y = -0.5 * d.y / d.z;
    const double t = std::min(std::sqrt(x * x + y * y), 30.0) / 30.0;
    x -= std::floor(x), y -= std::floor(y);
    const double grey = (x >= 0.5) == (y >= 0.5) ? 0.2 : 0.4;
    return lerp({grey, grey, grey}, far, t);
}

TEST(Background, NamedSkiesAreTheFormulas)
{
    for (int i = 0; i <= 1000; ++i) {
        const Vec3 d = at_height(i / 1000.0);
        const auto z = static_cast<double>(d.z);
        const std::string what = "height " + std::to_string(z);
        expect_near(eval(background_of(SkyType::gradient), d), gradient(z), 1e-6, what);
        expect_near(eval(background_of(SkyType::dusk), d), dusk(z), 1e-6, what);
        expect_near(eval(background_of(SkyType::dawn), d), dawn(z), 1e-6, what);
    }
    expect_near(eval(background_of(SkyType::gradient), {0, 0, 1}), {0, 0, 0}, 0, "zenith");
    expect_near(eval(background_of(SkyType::dusk), {0, 0, 1}), {0, 0, 0.5}, 1e-7, "zenith of dusk");
    expect_near(eval(background_of(SkyType::noon), {1, 0, 0}), {0.75, 0.85, 1}, 1e-7, "noon at the horizon");
    expect_near(eval(background_of(SkyType::night), {0, 0, 1}), {0.002, 0.003, 0.015}, 1e-7, "night at the zenith");
}

TEST(Background, TheCheckerIsTheFormula)
{
    Random random(1);
    int greys[2] = {};
    for (const auto sky : {SkyType::gradient, SkyType::dawn})
        for (const bool legacy : {false, true})
            for (int i = 0; i < 20000; ++i) {
                Vec3 d = random.unit_vector();
                d.z = -std::abs(d.z);
                const std::array<double, 3> far =
                    sky == SkyType::dawn ? std::array{1.0, 1.0, 0.3} : std::array{1.0, 1.0, 1.0};
                // Where legacy is, the ray's width counts for nothing.
                const Color c = eval(background_of(sky, GroundType::checker), d, legacy ? 0.1f : 0, legacy);
                const std::array<double, 3> expected = checker(to_double(d), far);
                expect_near(c, expected, 1e-6, std::to_string(i));
                if (d.z < -0.9f) ++greys[expected[2] > 0.35];
            }
    EXPECT_GT(greys[0], 1000);
    EXPECT_GT(greys[1], 1000);
}

TEST(Background, TheHorizonIsContinuous)
{
    for (const auto sky : {SkyType::gradient, SkyType::night, SkyType::dawn, SkyType::dusk, SkyType::noon})
        for (int i = 0; i < 20; ++i) {
            const auto b = background_of(sky, GroundType::checker);
            const Color above = eval(b, at_height(1e-5, i)), below = eval(b, at_height(-1e-5, i));
            expect_near(above, {below.r, below.g, below.b}, 1e-4, "sky " + std::to_string(static_cast<int>(sky)));
            // Without a ground the sky goes on.
            EXPECT_EQ(eval(background_of(sky), at_height(-0.6, i)), eval(background_of(sky), at_height(0, i)));
        }
}

// What the table relies on where it looks at one direction for a whole row.
TEST(Background, WhatIsTheSameAllAroundSaysSo)
{
    const Raster picture = make_raster(8, 8, [](uint32_t x, uint32_t y) { return Color{float(x), float(y), 1}; });
    const auto is_same = [](const Background& b, double z) {
        const Color first = b.eval(at_height(z, 0));
        for (int i = 1; i < 60; ++i)
            if (!(b.eval(at_height(z, i)) == first)) return false;
        return true;
    };
    for (const auto sky : {SkyType::color, SkyType::gradient, SkyType::night, SkyType::dawn, SkyType::dusk,
                           SkyType::noon, SkyType::picture})
        for (const auto ground : {GroundType::none, GroundType::color, GroundType::checker, GroundType::picture})
            for (const bool legacy : {false, true}) {
                auto what = background_of(sky, ground);
                what.sky_color = {1, 2, 3};
                const Background b(what, sky == SkyType::picture ? &picture : nullptr,
                                   ground == GroundType::picture ? &picture : nullptr, legacy);
                for (const double z : {-0.9, -0.3, 0.01, 0.5, 0.9})
                    EXPECT_EQ(b.is_same_around(z), is_same(b, z))
                        << int(sky) << ", ground " << int(ground) << ", height " << z;
            }
}

TEST(Background, UpStrengthAndFade)
{
    auto b = background_of(SkyType::dawn, GroundType::checker);
    auto y_up = b;
    y_up.z_up = false;
    Random random(2);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 d = random.unit_vector();
        // A quarter turn about x takes one into the other: nothing is mirrored.
        EXPECT_EQ(eval(b, d), eval(y_up, {d.x, d.z, -d.y}));
    }
    b.strength = 3;
    expect_near(eval(b, at_height(0.2)), {1.5, 0.3, 0.3}, 1e-5, "strength");
    b.fade = Color{0, 1, 2};
    expect_near(eval(b, at_height(-1e-4)), {0, 3, 6}, 1e-6, "fade");
    b.ground = GroundType::color;
    b.ground_color = {1, 2, 3};
    expect_near(eval(b, {0, 0, -1}), {3, 6, 9}, 0, "one colour");
}

// The box is a mean over places: the formula averaged over the same rectangle.
TEST(Background, TheCheckerIsFilteredByItsMean)
{
    const auto b = background_of(SkyType::gradient, GroundType::checker);
    constexpr float spread = 0.02f;
    Random random(3);
    int mixed = 0;
    for (int i = 0; i < 600; ++i) {
        const Vec3 dir = at_height(-random.uniform(0.03, 1), random.uniform(0, 6.3));
        const Vec3d d = to_double(dir);
        const double x = -0.5 * d.x / d.z, y = -0.5 * d.y / d.z, slant2 = 0.25 + x * x + y * y, r = std::hypot(x, y);
        const double along = 2 * slant2 * static_cast<double>(spread),
                     across = std::sqrt(slant2) * static_cast<double>(spread);
        const double wx = std::hypot(along * x / r, across * y / r), wy = std::hypot(along * y / r, across * x / r);
        constexpr int n = 400;
        double sx = 0, sy = 0;
        for (int k = 0; k < n; ++k) {
            const auto half = [](double v) { return v - std::floor(v) < 0.5 ? 1 : -1; };
            sx += half(x + wx * ((k + 0.5) / n - 0.5)), sy += half(y + wy * ((k + 0.5) / n - 0.5));
        }
        const double grey = 0.3 - 0.1 * (sx / n) * (sy / n), t = std::min(r, 30.0) / 30;
        const Color c = eval(b, dir, spread);
        EXPECT_NEAR(c.r, grey * (1 - t) + t, 0.001) << i;
        mixed += std::abs(sx) < n || std::abs(sy) < n;
    }
    EXPECT_GT(mixed, 100);
    // So wide that every colour counts: the mean of both greys, up to a fiftieth of their difference.
    for (int i = 0; i < 100; ++i) {
        const Vec3 dir = at_height(-0.02, i);
        const double t = std::hypot(dir.x, dir.y) / -dir.z * 0.5 / 30;
        EXPECT_NEAR(eval(b, dir, spread).r, 0.3 * (1 - t) + t, 0.004) << i;
    }
}

TEST(Background, AConstantStaysAConstantEnvironment)
{
    SceneDescription d;
    d.spheres.push_back(sphere_of({0, 0, 0}, 1));
    d.background = background_of(SkyType::color);
    d.background->sky_color = {1, 2, 3};
    d.background->strength = 2;
    d.lights = {sky_of({1, 1, 1})};
    const Scene s = build_scene(d);
    EXPECT_EQ(s.background, nullptr);
    EXPECT_EQ(s.environment_table, nullptr);
    EXPECT_EQ(s.radiance_from({0, 1, 0}), (Color{3, 5, 7}));
    EXPECT_EQ(s.lights.lights.size(), 1u);
}

TEST(Background, AddsUpWithEnvironments)
{
    SceneDescription d;
    d.spheres.push_back(sphere_of({0, 0, 0}, 1));
    d.background = background_of(SkyType::dusk, GroundType::checker);
    d.lights = {sky_of({1, 1, 1}), sky_map_of({2, 2, 2})};
    d.render.mis_compensation = false;
    const RasterSource picture = picture_source(make_raster(4, 2, [](uint32_t, uint32_t) { return Color{1, 1, 2}; }));
    const Scene s = build_scene(d, picture);
    expect_near(s.radiance_from({0, 0, 1}), {3, 3, 5.5}, 1e-6, "dusk, a map and a constant");
    EXPECT_EQ(s.lights.lights.size(), 1u) << "one light for all that is infinitely far away";
    // 4 pi of the constant and the map, and what the sky and the ground send, to the floor of the table.
    const double constant = 4 * pi_d * luminance(3, 3, 5), power = s.environment_table->power();
    EXPECT_GT(power, constant);
    EXPECT_LT(power, constant * 1.35);
}

// Of every kind that is not constant.
std::vector<Scene> shining()
{
    std::vector<Scene> all;
    for (const auto sky : {SkyType::gradient, SkyType::night, SkyType::dawn, SkyType::dusk, SkyType::noon}) {
        SceneDescription d;
        d.spheres.push_back(sphere_of({0, 0, 0}, 1));
        d.background = background_of(sky, sky == SkyType::dusk ? GroundType::none : GroundType::checker);
        d.background->z_up = sky != SkyType::noon;
        d.render.mis_compensation = false;
        all.push_back(build_scene(d));
    }
    return all;
}

TEST(Background, LightSamplesHaveTheRadianceAndTheDensityOfTheirDirection)
{
    for (const Scene& s : shining()) {
        Random random(4);
        const Surface from{.p = {},
                           .p_error = {},
                           .n = {0, 1, 0},
                           .ns = {0, 1, 0},
                           .origin = {},
                           .side = {0, 1, 0},
                           .front = true,
                           .material = 0,
                           .light = Scene::none,
                           .t = 1};
        for (int i = 0; i < 2000; ++i) {
            const auto l = sample_light(s, from, 0, random.unit2(), true);
            ASSERT_TRUE(l);
            ASSERT_EQ(l->radiance, s.radiance_from(l->wi));
            ASSERT_EQ(l->pdf, pdf_environment(s, from.ns, l->wi));
            const Vec3 w = random.unit_vector();
            ASSERT_TRUE(is_black(s.radiance_from(w)) || pdf_environment(s, from.ns, w) > 0);
        }
        // The table is what the radiance is: weights of light samples are nearly the same.
        stats::Tally weight;
        for (int i = 0; i < 20000; ++i) {
            const EnvironmentSample e = s.environment_table->sample(random.unit2());
            weight.add(static_cast<double>(luminance(s.radiance_from(e.wi)) / e.pdf));
        }
        EXPECT_LT(std::sqrt(weight.variance()), 0.12 * weight.mean);
        EXPECT_NEAR(weight.mean / s.environment_table->power(), 1, 0.02);
    }
}

// A line of light between the places that the table looks at.
TEST(Background, WhatTheTableMissesCanStillBeDrawn)
{
    SceneDescription d;
    d.spheres.push_back(sphere_of({0, 0, 0}, 1));
    d.background = background_of(SkyType::picture);
    d.background->sky_picture.file = "sky";
    d.render.mis_compensation = false;
    constexpr uint32_t columns = 16384;
    const Raster r = make_raster(columns, 2, [](uint32_t x, uint32_t) {
        const float c = x < columns / 8 || x % 1000 == 0 ? 1.0f : 0.0f;
        return Color{c, c, c};
    });
    const Scene s = build_scene(d, picture_source(r));
    Random random(6);
    int lit = 0;
    for (int i = 0; i < 20000; ++i) {
        const auto column = static_cast<double>(columns / 8 + random.below(columns * 7 / 8)), z = random.uniform(-1, 1);
        const double nearest = std::round(column / 1000) * 1000 + 0.5, longitude = (0.5 - nearest / columns) * 2 * pi_d;
        const double across = std::sqrt(1 - z * z);
        const Vec3 w = to_float(Vec3d{std::sin(longitude) * across, -std::cos(longitude) * across, z});
        if (is_black(s.radiance_from(w))) continue;
        ++lit;
        ASSERT_GT(pdf_environment(s, {0, 0, 1}, w), 0);
    }
    EXPECT_GT(lit, 10000);
}

// In degrees from the light, seen from the origin of the ray.
TEST(Glow, DiscsOfFourDegreesAroundLights)
{
    SceneDescription d;
    d.spheres.push_back(sphere_of({0, 0, 0}, 1000));  // scaled far down
    d.background = BackgroundDescription{};
    d.background->glow = true;
    d.lights = {light_of(LightType::point, {1, 2, 3}, {7000, 5000, 1000}), directional_of({4, 4, 0}, {0, 0, 2})};
    const Scene s = build_scene(d);
    const auto seen = [&](Vec3 org, Vec3d axis, double deg) {
        const Vec3d n = normalize(axis), side = normalize(cross(n, Vec3d{0.3, 1, -0.2}));
        const double a = deg * pi_d / 180;
        const Vec3 dir = to_float(n * std::cos(a) + side * std::sin(a));
        return s.radiance_seen({.org = org, .dir = dir}, {});
    };
    const auto profile = [](double deg) { return deg < 4 ? (1 - deg / 4) * (1 - deg / 4) : 0; };
    for (const double deg : {0.0, 0.01, 0.5, 1.0, 2.0, 3.0, 3.9, 3.999, 4.001, 5.0, 8.0, 20.0, 90.0, 180.0}) {
        const double p = profile(deg);
        expect_near(seen({}, {0, 0, -1}, deg), {4 * p, 4 * p, 0}, 1e-4, "directional " + std::to_string(deg));
        for (const Vec3d eye : {Vec3d{0, 0, 0}, Vec3d{500, -3000, 2000}}) {
            const Vec3 org = to_float(s.normalisation.to_scene(eye));
            expect_near(seen(org, Vec3d{7000, 5000, 1000} - eye, deg), {p, 2 * p, 3 * p}, 1e-4,
                        "point " + std::to_string(deg));
        }
    }
    EXPECT_EQ(s.radiance_from({0, 0, -1}), Color{}) << "no light that a surface could find";
}

}  // namespace
}  // namespace lancer
