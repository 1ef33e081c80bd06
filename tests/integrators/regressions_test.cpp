// Mistakes that a ray tracer of this kind is known to make, each seen in pictures. tests/mutations/NAME.patch brings
// one of them back into the source, and the test of that name must then be red.
#include <gtest/gtest.h>

#include "support/scenes/classic.h"

namespace lancer {
namespace {

const Shot small{.width = 24, .height = 24, .spp = 4};

// A thin bubble of glass before a checked wall far behind it. Leaving glass by the index of entering it makes the
// bubble a dark, solid ball with the wall upside down.
TEST(Regression, IndexOnLeaving)
{
    SceneDescription bare;
    MaterialDescription wall = make_emitter("wall", {1, 1, 1});
    wall.emission_map.emplace();
    wall.emission_map->type = TextureType::checker;
    wall.emission_map->use.scale = {0.5f, 0.5f};
    bare.materials = {wall};
    bare.planes.push_back(plane_of({0, 0, -12}, {0, 0, 1}, "wall"));
    constexpr double half = 1.8;  // that the picture shows, where the middle of the bubble is
    bare.camera = make_camera({0, 0, 12}, {0, 0, 0}, 2 * std::atan(half / 12) * 180 / pi_d);
    SceneDescription bubble = bare;
    add_bubble(bubble, "glass", {0, 0, 0}, 2);
    for (const bool legacy : {false, true}) {
        const Shot shot{.width = 24, .height = 24, .spp = 16};
        const Film without = shoot_classic(bare, Whitted{}, legacy, shot);
        const Film with = shoot_classic(bubble, Whitted{}, legacy, shot);
        // The correlation of both pictures, but for the rim, where even a thin shell bends rays.
        stats::Tally x, y, xx, yy, xy;
        for (uint32_t j = 0; j < 24; ++j)
            for (uint32_t i = 0; i < 24; ++i) {
                if (std::hypot(i - 11.5, j - 11.5) / 12 * half > 0.9 * 2) continue;
                const double p = tally(without.at(i, j)).mean, q = tally(with.at(i, j)).mean;
                x.add(p), y.add(q), xx.add(p * p), yy.add(q * q), xy.add(p * q);
            }
        const double covariance = xy.mean - x.mean * y.mean;
        const double deviations = std::sqrt((xx.mean - x.mean * x.mean) * (yy.mean - y.mean * y.mean));
        EXPECT_GT(covariance / deviations, 0.95) << "the wall is where it is without the bubble" << legacy;
        EXPECT_GT(y.mean, 0.6 * x.mean) << legacy;
    }
}

// Two lights and something between them and the floor. However shadows are combined, no place gets more light than
// without them, and the shadow of one light is what the other gives alone.
TEST(Regression, ShadowIsNeverLighter)
{
    SceneDescription open;
    open.materials = {make_lambert("floor", {0.7f, 0.6f, 0.5f})};
    open.planes.push_back(plane_of({0, 0, 0}, {0, 1, 0}, "floor"));
    open.lights = {directional_of({1, 0.9f, 0.8f}, {0.2, -1, 0.3}),
                   light_of(LightType::point, {40, 40, 40}, {3, 6, 2})};
    open.camera = make_camera({0, 4, 12}, {0, 0, 0}, 14);
    const double above = 3;  // the view
    for (const bool legacy : {false, true}) {
        const Film lit = shoot_classic(open, Whitted{}, legacy, small);
        for (const CourseMaterial& m : course_materials()) {
            SceneDescription d = open;
            d.materials.push_back(make_interface(m.name, m.phong));
            d.spheres.push_back(sphere_of({0, above, 0}, 0.8, m.name));
            const Film shaded = shoot_classic(d, Whitted{}, legacy, small);
            double darker = 0;
            for (size_t i = 0; i < lit.pixels.size(); ++i)
                for (size_t c = 0; c < 3; ++c) {
                    ASSERT_LE(shaded.pixels[i].sum[c], lit.pixels[i].sum[c] * (1 + 1e-6)) << m.name;
                    darker += lit.pixels[i].sum[c] - shaded.pixels[i].sum[c];
                }
            EXPECT_GT(darker, 0) << m.name << " casts a shadow";
        }
        // A wall of bronze over the point of light alone: what remains is the other light's.
        SceneDescription d = open, alone = open;
        d.materials.push_back(make_interface("bronze", course_material("bronze")));
        d.spheres.push_back(sphere_of({3, 5, 2}, 0.9, "bronze"));
        alone.lights.pop_back();
        const Film shaded = shoot_classic(d, Whitted{}, legacy, small);
        const Film other = shoot_classic(alone, Whitted{}, legacy, small);
        for (size_t i = 0; i < other.pixels.size(); ++i)
            for (size_t c = 0; c < 3; ++c)
                ASSERT_NEAR(shaded.pixels[i].sum[c], other.pixels[i].sum[c], 1e-6 * other.pixels[i].sum[c]) << legacy;
    }
}

// The part of light that an interface refracts counts in its shadow, beside its colour.
TEST(Regression, CoefficientsCountInShadows)
{
    SceneDescription bare;
    bare.materials = {make_lambert("floor", {1, 1, 1})};
    bare.planes.push_back(plane_of({0, 0, 0}, {0, 1, 0}, "floor"));
    bare.lights.push_back(directional_of({1, 1, 1}, {0, -1, 0}));
    bare.camera = make_camera({9, 0.3, 0}, {0, 0, 0}, 1e-4);
    const auto shadow = [&](const char* material) {
        SceneDescription d = bare;
        d.materials.push_back(make_interface(material, course_material(material)));
        d.spheres.push_back(sphere_of({0, 2, 0}, 0.5, material));
        const Color lit = shoot_classic(bare, Whitted{}, true, {.width = 1, .height = 1}).pixels[0].mean();
        const Color dark = shoot_classic(d, Whitted{}, true, {.width = 1, .height = 1}).pixels[0].mean();
        return dark.g / lit.g;
    };
    EXPECT_NEAR(shadow("glass"), 0.8668f, 1e-4f);
    EXPECT_NEAR(shadow("emerald"), 0.2533f, 1e-4f);
}

// Illumination counts by the part that a surface diffuses, or a bubble is white.
TEST(Regression, BubbleIsNotWhite)
{
    SceneDescription d;
    add_bubble(d, "glass", {0, 0, 0}, 2);
    d.lights = {directional_of({1, 1, 1}, {0, -1, -1}), light_of(LightType::point, {1, 1, 1}, {-4, 2, 8})};
    d.camera = make_camera({0, 0, 12}, {0, 0, 0}, 15);
    for (const bool legacy : {false, true}) {
        const double mean = tally(shoot_classic(d, Whitted{}, legacy, small)).mean;
        EXPECT_GT(mean, 1e-4) << legacy;
        EXPECT_LT(mean, 0.1) << legacy;
    }
}

// A lit ball without anything that could shade it. Rays that start on their own surface see it as their own shade:
// specks.
TEST(Regression, LitBallsHaveNoSpecks)
{
    SceneDescription d;
    d.materials = {make_lambert("white", {1, 1, 1})};
    d.spheres = {sphere_of({0.3, -0.2, 0.1}, 1, "white")};
    d.lights = {light_of(LightType::directional, {1, 1, 1})};
    d.lights[0].direction = {0, 0, -1};
    d.camera = make_camera({0.3, -0.2, 40}, {0.3, -0.2, 0}, 2.5);
    for (const bool legacy : {false, true}) {
        const Film film = shoot_classic(d, Whitted{}, legacy, {.width = 48, .height = 48, .spp = 4});
        const double full = legacy ? 1 : 1 / pi_d;
        for (uint32_t j = 0; j < 48; ++j)
            for (uint32_t i = 0; i < 48; ++i) {
                const double r = std::hypot(i - 23.5, j - 23.5) / 24 * 40 * std::tan(1.25 * pi_d / 180);
                if (r > 0.9) continue;
                ASSERT_NEAR(tally(film.at(i, j)).mean, full * std::sqrt(1 - r * r), 0.04 * full) << i << " " << j;
            }
    }
}

}  // namespace
}  // namespace lancer
