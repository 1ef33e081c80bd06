// Pictures of the sky: which pixel a direction is shown by, in every projection.
#include "scene/environment/projected_picture.h"

#include <gtest/gtest.h>

#include "scene/environment/background.h"
#include "support/random.h"
#include "support/rasters.h"
#include "support/scenes/scenes.h"

namespace lancer {
namespace {

constexpr std::array fish_eyes{Projection::lachaud, Projection::equidistant, Projection::orthographic,
                               Projection::equisolid};

BackgroundPicture projected(Projection p, double fov_deg = 180, double margin = 0)
{
    BackgroundPicture how;
    how.projection = p, how.fov_deg = fov_deg, how.margin = margin;
    return how;
}
ProjectedPicture plain_picture(const BackgroundPicture& how, uint32_t width, uint32_t height)
{
    return {how, make_raster(width, height, [](uint32_t, uint32_t) { return Color{}; })};
}
Vec3d direction(double from_zenith_deg, double azimuth_deg)
{
    const double a = from_zenith_deg * pi_d / 180, b = azimuth_deg * pi_d / 180;
    return {std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)};
}

// Distance from the middle, in parts of the radius: the definitions, in degrees.
double expected_radius(Projection p, double deg)
{
    const double a = deg * pi_d / 180;
    switch (p) {
        case Projection::lachaud:
            return 1 - std::cos(a);
        case Projection::equidistant:
            return deg / 90;
        case Projection::orthographic:
            return std::sin(a);
        default:
            return std::sqrt(2.0) * std::sin(a / 2);
    }
}

TEST(ProjectedPicture, FishEyesPutKnownAnglesOnKnownPixels)
{
    for (const Projection p : fish_eyes) {
        const ProjectedPicture whole = plain_picture(projected(p), 400, 300),
                               cropped = plain_picture(projected(p, 180, 15), 400, 300);
        for (const double deg : {0.0, 10.0, 30.0, 45.0, 60.0, 80.0, 90.0})
            for (const double azimuth : {0.0, 90.0, 200.0, 300.0}) {
                const double r = expected_radius(p, deg), b = azimuth * pi_d / 180;
                const auto at = whole.place_of(direction(deg, azimuth)), in = cropped.place_of(direction(deg, azimuth));
                EXPECT_NEAR(at.x, 200 + 150 * r * std::cos(b), 1e-5) << deg << " " << azimuth;
                EXPECT_NEAR(at.y, 150 + 150 * r * std::sin(b), 1e-5) << deg << " " << azimuth;
                // The course leaves 15 pixels: (min(width, height) - 30) / 2.
                EXPECT_NEAR(in.x, 200 + 135 * r * std::cos(b), 1e-5) << deg << " " << azimuth;
                EXPECT_NEAR(in.y, 150 + 135 * r * std::sin(b), 1e-5) << deg << " " << azimuth;
            }
        // Below the rim there is nothing: the rim goes on.
        const auto rim = whole.place_of(direction(90, 30)), below = whole.place_of(direction(150, 30));
        EXPECT_NEAR(rim.x, below.x, 1e-5);
        EXPECT_NEAR(rim.y, below.y, 1e-5);
    }
}

TEST(ProjectedPicture, FieldsOfViewReachTheRim)
{
    for (const Projection p : {Projection::equidistant, Projection::orthographic, Projection::equisolid})
        for (const double fov : {60.0, 180.0, 220.0, 360.0}) {
            if (p == Projection::orthographic && fov > 180) continue;
            const ProjectedPicture picture = plain_picture(projected(p, fov), 100, 100);
            EXPECT_NEAR(picture.place_of(direction(fov / 2, 0)).x, 100, 1e-4) << fov;
            EXPECT_LT(picture.place_of(direction(fov / 2 - 1, 0)).x, 100 - 1e-3) << fov;
        }
    EXPECT_NEAR(plain_picture(projected(Projection::equidistant, 220), 100, 100).place_of(direction(55, 0)).x, 75,
                1e-9);
}

TEST(ProjectedPicture, LatitudeAndLongitudeAreThoseOfEnvironments)
{
    // As an environment light shows the same picture, whose y axis is up.
    const ProjectedPicture p = plain_picture(projected(Projection::latlong), 64, 32);
    const auto expect_at = [&](Vec3d d, double x, double y) {
        const auto at = p.place_of(d);
        EXPECT_NEAR(at.x, x, 1e-9);
        EXPECT_NEAR(at.y, y, 1e-9);
    };
    expect_at({0, -1, 0}, 32, 16);
    expect_at({1, 0, 0}, 16, 16);
    expect_at({-1, 0, 0}, 48, 16);
    EXPECT_NEAR(p.place_of({0, 0, 1}).y, 0, 1e-9);
    EXPECT_NEAR(p.place_of({0, 0, -1}).y, 32, 1e-9);
    expect_at(direction(45, -90), 32, 8);

    const Raster r = make_raster(16, 8, [](uint32_t x, uint32_t y) {
        return Color{static_cast<float>(x), static_cast<float>(y), static_cast<float>(x * y % 7)};
    });
    SceneDescription a, b;
    a.spheres = b.spheres = {sphere_of({0, 0, 0}, 1)};
    a.lights = {sky_map_of({1, 1, 1}, {0, 37, 0})};
    b.background = BackgroundDescription{};
    b.background->sky = SkyType::picture;
    b.background->sky_picture.file = "sky";
    b.background->sky_picture.rotate_deg = 37;
    const Scene light = build_scene(a, picture_source(r)), sky = build_scene(b, picture_source(r));
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 d = random.unit_vector();
        const Color x = light.radiance_from(d), y = sky.radiance_from(d);
        ASSERT_NEAR(x.r, y.r, 1e-4);
        ASSERT_NEAR(x.g, y.g, 1e-4);
        ASSERT_NEAR(x.b, y.b, 1e-4);
    }
}

// The way back: degrees by the distance from the middle.
double angle_at(Projection p, double radius)
{
    const double to_deg = 180 / pi_d;
    switch (p) {
        case Projection::lachaud:
            return to_deg * std::acos(1 - radius);
        case Projection::equidistant:
            return 90 * radius;
        case Projection::orthographic:
            return to_deg * std::asin(radius);
        default:
            return to_deg * 2 * std::asin(radius / std::sqrt(2.0));
    }
}

// A picture whose colours are the directions that its pixels stand for: what is read back is the direction asked for.
TEST(ProjectedPicture, ColoursThatAreDirectionsComeBack)
{
    constexpr uint32_t size = 512;
    for (const Projection p : fish_eyes) {
        const Raster r = make_raster(size, size, [&](uint32_t column, uint32_t row) {
            const double x = (column + 0.5) / size * 2 - 1, y = (row + 0.5) / size * 2 - 1;
            const double distance = std::min(1.0, std::hypot(x, y)), azimuth = std::atan2(y, x) * 180 / pi_d;
            const Vec3 d = to_float((direction(angle_at(p, distance), azimuth) + Vec3d{1, 1, 1}) / 2.0);
            return Color{d.x, d.y, d.z};
        });
        const ProjectedPicture picture(projected(p), r);
        Random random(2);
        double worst = 0;
        for (int i = 0; i < 20000; ++i) {
            Vec3d d = random.direction();
            d.z = std::abs(d.z);
            // Pixels at the rim are read together with what lies beyond; in the middle of the
            // course's projection, as at the rim of the orthographic one, a pixel spans several degrees.
            if (d.z < 0.2 || d.z > 0.98) continue;
            const Color c = picture.eval(d);
            worst = std::max(worst, length(Vec3d{2 * static_cast<double>(c.r) - 1, 2 * static_cast<double>(c.g) - 1,
                                                 2 * static_cast<double>(c.b) - 1} -
                                           d));
        }
        EXPECT_LT(worst, 1e-3) << static_cast<int>(p);
    }
}

TEST(ProjectedPicture, TurnsCounterClockwiseAndScales)
{
    BackgroundPicture how = projected(Projection::equidistant);
    how.rotate_deg = 30;
    how.scale = {2, 3, 4};
    const ProjectedPicture turned(how, make_raster(9, 9, [](uint32_t, uint32_t) { return Color{1, 1, -1}; }));
    const ProjectedPicture still = plain_picture(projected(Projection::equidistant), 9, 9);
    EXPECT_NEAR(turned.place_of(direction(40, 80)).x, still.place_of(direction(40, 50)).x, 1e-9);
    EXPECT_NEAR(turned.place_of(direction(40, 80)).y, still.place_of(direction(40, 50)).y, 1e-9);
    EXPECT_EQ(turned.eval({0, 0, 1}), (Color{2, 3, 0}));
    EXPECT_EQ(turned.bad_texels(), 81u);
}

Background with_sky(Projection p, bool legacy, double margin = 0)
{
    BackgroundDescription b;
    b.sky = SkyType::picture;
    b.sky_picture = projected(p, 180, margin);
    b.ground = GroundType::checker;
    b.z_up = true;
    const Raster r = make_raster(64, 64, [](uint32_t, uint32_t) { return Color{0.8f, 0.2f, 0.4f}; });
    return {b, &r, nullptr, legacy};
}

TEST(ProjectedPicture, TheCoursesSkyEndsInGreyWhereItIsAskedToBeTheCourses)
{
    const Background now = with_sky(Projection::lachaud, false), then = with_sky(Projection::lachaud, true, 15);
    for (const double z : {0.0, 0.01, 0.025, 0.049, 0.05, 0.3, 1.0}) {
        const Vec3 d = to_float(Vec3d{std::sqrt(1 - z * z), 0, z});
        const double t = std::max(0.0, (0.05 - z) / 0.05);
        EXPECT_NEAR(then.eval(d).r, 0.8 * (1 - t) + 0.5 * t, 1e-5) << z;
        EXPECT_NEAR(then.eval(d).g, 0.2 * (1 - t) + 0.5 * t, 1e-5) << z;
        EXPECT_NEAR(now.eval(d).r, 0.8, 1e-6) << z;
    }
    // The ground passes into what the sky is at the horizon.
    EXPECT_NEAR(now.fade().g, 0.2, 1e-5);
    EXPECT_NEAR(then.fade().g, 0.5, 1e-5);
    EXPECT_NEAR(with_sky(Projection::equisolid, true).fade().g, 0.2, 1e-5) << "only that projection";
}

// A picture of the ground through a fish-eye that looks down has +x on the right and +y above.
TEST(ProjectedPicture, TheGroundIsSeenFromAbove)
{
    const auto quarter = [](uint32_t x, uint32_t y) { return Color{x < 32 ? 0.0f : 1.0f, y < 32 ? 0.0f : 1.0f, 0.5f}; };
    const Raster r = make_raster(64, 64, quarter);
    for (const Projection p : {Projection::equidistant, Projection::planar}) {
        BackgroundDescription b;
        b.sky_color = {9, 9, 9};
        b.ground = GroundType::picture;
        b.ground_picture = projected(p);
        b.fade = Color{};
        b.z_up = true;
        const Background back(b, nullptr, &r, false);
        EXPECT_EQ(back.eval({0, 0, 1}), (Color{9, 9, 9}));
        // A planar copy has its lower left corner below the eye; its side is two heights.
        for (const double x : {0.5, 1.5})
            for (const double y : {0.5, 1.5}) {
                const double px = p == Projection::planar ? x : x - 1, py = p == Projection::planar ? y : y - 1;
                const Vec3 d = to_float(normalize(Vec3d{px, py, -1}));
                const double t = p == Projection::planar ? std::hypot(px, py) / 2 / 30 : 0;
                const Color c = back.eval(d);
                EXPECT_NEAR(c.r, (x > 1 ? 1 : 0) * (1 - t), 1e-3) << x << " " << y;
                EXPECT_NEAR(c.g, (y > 1 ? 0 : 1) * (1 - t), 1e-3) << x << " " << y;
            }
    }
}

TEST(ProjectedPicture, WhatCannotBeReadIsAnError)
{
    SceneDescription d;
    d.spheres.push_back(sphere_of({0, 0, 0}, 1));
    d.background = BackgroundDescription{};
    d.background->sky = SkyType::picture;
    d.background->sky_picture.file = "sky.png";
    d.background->sky_picture.where = {"s.toml", 4, 1};
    Diagnostics diagnostics;
    try {
        Scene::build(d, d.render, diagnostics, {});
        FAIL();
    } catch (const Error& e) {
        EXPECT_STREQ(e.what(), "s.toml:4:1: error: background not read: nothing reads pictures here");
    }
}

}  // namespace
}  // namespace lancer
