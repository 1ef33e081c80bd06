// Absorption and overlapping bodies, where what is seen can be worked out on paper.
#include <gtest/gtest.h>

#include "materials/fresnel.h"
#include "support/refused.h"
#include "support/scenes/media_scenes.h"
#include "support/ways.h"

namespace lancer {
namespace {

constexpr double degree = std::numbers::pi / 180;

MaterialDescription lamp_of_both_sides()
{
    MaterialDescription lamp = make_emitter("lamp", {1, 1, 1});
    lamp.emission_both_sides = true;
    return lamp;
}
double reflectance(double angle_deg, double eta)
{
    const double cos = std::cos(angle_deg * degree);
    return fresnel_dielectric_double(cos, (1 - cos) * (1 + cos), eta).reflectance;
}
// At a point at the origin, from `distance` above or below the horizontal, so narrowly that all rays are one.
CameraDescription view_at(double angle_deg, double distance)
{
    const double a = angle_deg * degree;
    CameraDescription c = make_camera(Vec3d{std::sin(a), std::cos(a), 0} * distance, {0, 0, 0}, 1e-4);
    c.up = {0, 0, 1};
    return c;
}
// One pixel's worth of independent samples.
Shot narrow(uint32_t spp)
{
    return {
        .integrator = without_roulette({}), .width = 8, .height = 8, .spp = spp, .sampler = SamplerKind::independent};
}

// A slab of thickness 1/2 over a lamp, as planes or as a box; nothing above.
SceneDescription slab(const MaterialDescription& glass, bool box)
{
    SceneDescription d;
    d.materials = {glass, lamp_of_both_sides()};
    if (box) {
        d.meshes.push_back(make_mesh(make_cube(), {{0, -0.25, 0}, {0, 0, 0}, {90, 0.25, 80}}));
        d.meshes.back().material = glass.name;
    } else {
        d.planes = {plane_of({0, 0, 0}, {0, 1, 0}, glass.name), plane_of({0, -0.5, 0}, {0, -1, 0}, glass.name)};
    }
    d.planes.push_back(plane_of({0, -3, 0}, {0, 1, 0}, "lamp"));
    return d;
}

// Index 1 reflects nothing and bends nothing: the exponential of the way, per channel, in every sample. In any units.
TEST(Absorption, IsTheExponentialOfTheWay)
{
    const Color sigma{0.5f, 1, 3};
    for (const bool box : {false, true})
        for (const double scale : {1.0, 0.01, 300.0})
            for (const double angle : {0.0, 35.0, 70.0}) {
                SceneDescription d = slab(make_medium("glass", 1, sigma), box);
                d.camera = view_at(angle, 2);
                const double way = 0.5 / std::cos(angle * degree);
                const auto seen = [&](float s) { return static_cast<float>(std::exp(-static_cast<double>(s) * way)); };
                expect_all_equal(shoot(scaled_by(d, scale), narrow(1)), {seen(sigma.r), seen(sigma.g), seen(sigma.b)},
                                 2e-5f, std::to_string(scale) + " " + std::to_string(angle));
            }
}

// (1 - F)^2 a (1 + F^2 a^2 + F^4 a^4 + ...), with the part a left of one way through the slab.
TEST(Absorption, SlabTransmitsTheWholeSeries)
{
    stats::Family family;
    for (const bool box : {false, true})
        for (const double angle : {0.0, 40.0, 65.0, 80.0}) {
            SceneDescription d = slab(make_medium("glass", 1.5f, {0.8f, 0.8f, 0.8f}), box);
            d.camera = view_at(angle, 1);
            const double inside = std::sin(angle * degree) / 1.5, f = reflectance(angle, 1.5);
            const double a = std::exp(-0.8 * 0.5 / std::sqrt(1 - inside * inside));
            const stats::Tally t = tally(shoot(d, narrow(512)));
            const double expected = (1 - f) * (1 - f) * a / (1 - f * f * a * a);
            EXPECT_LT(t.error(), 0.008 * expected);
            family.add(stats::mean_p(t, expected, 2e-5), std::to_string(box) + " " + std::to_string(angle));
        }
}

// A lamp in a block: what ends inside has been absorbed on the way there. With the camera inside as well.
TEST(Absorption, CountsWhereAPathEndsInsideOrStarts)
{
    SceneDescription d;
    d.materials = {make_medium("glass", 1, {0.5f, 1, 2}), lamp_of_both_sides()};
    d.planes = {plane_of({0, 0, 0}, {0, 1, 0}, "glass"), plane_of({0, -1.5, 0}, {0, 1, 0}, "lamp")};
    for (const bool inside : {false, true}) {
        d.camera = make_camera({0, inside ? -0.5 : 1.0, 0}, {0, -1, 0}, 1e-4);
        d.camera->up = {0, 0, 1};
        if (inside) d.camera->inside = "glass";
        const float way = inside ? 1 : 1.5f;
        expect_all_equal(shoot(d, narrow(1)), {std::exp(-0.5f * way), std::exp(-way), std::exp(-2 * way)}, 2e-5f,
                         "inside " + std::to_string(inside));
    }
    // Not said: found out where the path leaves.
    d.planes[1] = plane_of({0, 1, 0}, {0, 1, 0}, "lamp");
    d.camera = make_camera({0, -0.5, 0}, {0, 1, 0}, 1e-4);
    d.camera->up = {0, 0, 1};
    expect_all_equal(shoot(d, narrow(1)), {std::exp(-0.25f), std::exp(-0.5f), std::exp(-1.0f)}, 2e-5f, "leaves");
}

// A sky of radiance 1 seen from below an absorbing half-space that has no end downwards.
TEST(Absorption, TakesAllOfWhatComesFromInfinitelyFar)
{
    SceneDescription d;
    d.materials = {make_medium("glass", 1, {0, 1, 2})};
    d.planes = {plane_of({0, 0, 0}, {0, 1, 0}, "glass")};
    d.lights = {sky_of({1, 1, 1})};
    d.camera = view_at(20, 1);
    expect_all_equal(shoot(d, narrow(1)), {1, 0, 0}, 1e-6f, "down into it");
}

// The light of an area, under absorbing water of index 1, on a matt floor: by light samples, by the BSDF, by both. And
// all of it in the scene that has everything.
TEST(Absorption, IsTheSameByAllWaysToFindLight)
{
    SceneDescription d;
    d.materials = {make_medium("water", 1, {0.3f, 0.8f, 1.5f}, 1), make_lambert("floor", {0.7f, 0.7f, 0.7f})};
    d.planes = {plane_of({0, 1, 0}, {0, 1, 0}, "water"), plane_of({0, -0.5, 0}, {0, 1, 0}, "floor")};
    // Of no priority over the water, so not there: but it stops shadow rays, and only the BSDF finds what is behind.
    d.materials.push_back(make_medium("gem", 2, {9, 9, 9}, 0));
    d.spheres = {sphere_of({-0.2, -0.1, 0.2}, 0.35, "gem")};
    d.lights = {light_of(LightType::sphere, {7, 7, 7}, {0.2, 0.5, 0}, 0.4), sky_of({0.5f, 0.5f, 0.5f})};
    d.camera = make_camera({0, 1.5, 2}, {0, -0.3, 0}, 50);
    SameByAllWays same(0.05);
    same.add("pool", d, {.width = 16, .height = 16, .spp = 16}, Path{}, 12, {1, 2, 4});
    same.add("media", media_scene(), {.width = 16, .height = 16, .spp = 32}, Path{}, 12, {1, 1, 4});
}

// Where both are, the one of the higher priority is: from either side of the boundary between glass and water, at any
// angle, it reflects and refracts by the ratio of the two indices and by nothing else. The rims of both bodies lie in
// the other one and are not seen.
TEST(Overlap, TouchingMediaReflectByTheirOwnIndices)
{
    stats::Family family;
    for (const bool from_glass : {true, false})
        for (const double angle : {0.0, 20.0, 45.0, 60.0, 62.0, 63.0, 75.0, 89.0}) {
            SceneDescription d;
            d.materials = {make_medium("water", 1.33f, {}, 1), make_medium("glass", 1.5f, {}, 2), lamp_of_both_sides()};
            // Water is below 1/2, glass above 0. The glass is seen from where it is alone.
            d.planes = {plane_of({0, 0.5, 0}, {0, 1, 0}, "water"), plane_of({0, 0, 0}, {0, -1, 0}, "glass"),
                        plane_of({0, from_glass ? -3.0 : 3.0, 0}, {0, 1, 0}, "lamp")};
            d.camera = view_at(angle, from_glass ? 2 : -2);
            if (from_glass && angle > 75) d.camera = view_at(angle, 60);
            d.camera->inside = from_glass ? "glass" : "water";
            const double eta = from_glass ? 1.33 / 1.5 : 1.5 / 1.33, r = reflectance(angle, eta);
            const Film film = shoot(d, narrow(512));
            const std::string what = std::to_string(from_glass) + " " + std::to_string(angle);
            if (r == 1)
                expect_all_equal(film, {0, 0, 0}, 0, "total reflection, " + what);
            else
                family.add(stats::mean_p(tally(film), (1 - r) / (eta * eta), 2e-5), what);
        }
}

void expect_same_picture(const SceneDescription& a, const SceneDescription& b, int may_differ, const char* what)
{
    const Shot shot{.integrator = without_roulette({}), .width = 48, .height = 48, .spp = 4};
    const Film x = shoot(a, shot), y = shoot(b, shot);
    int differing = 0;
    for (size_t i = 0; i < x.pixels.size(); ++i) {
        const Color d = x.pixels[i].mean() - y.pixels[i].mean();
        differing += max_component({std::abs(d.r), std::abs(d.g), std::abs(d.b)}) > 2e-4f;
    }
    EXPECT_LE(differing, may_differ) << what;
}

SceneDescription aquarium()
{
    SceneDescription d;
    d.materials = {make_medium("water", 1.33f, {0.5f, 0.2f, 0.1f}, 2), make_lambert("floor", {0.5f, 0.5f, 0.5f})};
    d.materials[1].base_color_map.emplace();
    d.materials[1].base_color_map->type = TextureType::checker;
    d.planes = {plane_of({0, -1.2, 0}, {0, 1, 0}, "floor")};
    d.spheres = {sphere_of({0, 0, 0}, 1, "water")};
    d.lights = {sky_of({0.5f, 0.8f, 1})};
    d.camera = make_camera({0, 1, 3}, {0, 0, 0}, 50);
    return d;
}

// The same random numbers meet the same surfaces; only rounding tells one from the other.
TEST(Overlap, WhatIsOfTheSameOrLowerPriorityIsNotThere)
{
    const SceneDescription bare = aquarium();
    SceneDescription same = bare, denser = bare, bright = bare;
    same.spheres.push_back(sphere_of({0.2, 0.3, 0.1}, 0.5, "water"));
    expect_same_picture(bare, same, 2, "water in water");
    denser.materials.push_back(make_medium("gem", 2.4f, {9, 9, 9}, 1));
    denser.materials.push_back(make_medium("twin", 1.7f, {}, 2));
    denser.spheres.push_back(sphere_of({0.2, 0.3, 0.1}, 0.5, "gem"));
    denser.spheres.push_back(sphere_of({-0.2, 0.3, -0.1}, 0.5, "twin"));
    denser.meshes.push_back(make_mesh(make_uv_sphere(6, 8), {{0, -0.2, 0.1}, {0, 0, 0}, {0.5, 0.5, 0.5}}));
    denser.meshes.back().material = "gem";
    expect_same_picture(bare, denser, 2, "what is lower or equal");
    // And the check that the eye of this test is open.
    denser.materials[2].priority = 3;
    const Film a = shoot(bare, {.spp = 4}), b = shoot(denser, {.spp = 4});
    EXPECT_FALSE(same_bits(a, b));
    EXPECT_LT(tally(b).mean, 0.97 * tally(a).mean);
}

// A body within another, said by priorities or by the ratio of the indices; a shell likewise.
TEST(Overlap, NestedBodiesAreTheSameByRatiosOfIndices)
{
    SceneDescription by_priority = aquarium();
    by_priority.materials.push_back(make_medium("inner", 1.6f, {2, 0, 1}, 3));
    by_priority.spheres.push_back(sphere_of({0.1, 0.2, 0.1}, 0.6, "inner"));
    SceneDescription by_ratio = by_priority;
    by_ratio.materials[0].priority.reset();
    by_ratio.materials.back() = make_medium("inner", 1.6f / 1.33f, {2, 0, 1});
    expect_same_picture(by_priority, by_ratio, 8, "gem in water");
    by_priority.materials.back() = make_medium("inner", 1, {}, 3);
    by_ratio.materials.back() = make_medium("inner", 1 / 1.33f, {});
    expect_same_picture(by_priority, by_ratio, 8, "bubble in water");
}

// Without a priority or absorption nothing is kept track of, and in the ways of the past neither.
// Shells within each other cannot be told from the sky, sample by sample; so do not those that find no place in the
// list of media, however many.
TEST(Overlap, AnyNumberOfNestedBodiesLosesAndGainsNothing)
{
    for (const int bodies : {1, 4, 5, 12, 20, 40}) {
        SceneDescription d;
        const Color sky{0.5f, 1, 2};
        d.lights.push_back(sky_of(sky));
        for (int i = 0; i < bodies; ++i) {
            const std::string name = "glass " + std::to_string(i);
            d.materials.push_back(make_medium(name, i % 2 == 0 ? 1.5f : 1.1f + 0.01f * static_cast<float>(i), {}));
            d.materials.back().priority = i;
            d.spheres.push_back(sphere_of({0, 0, 0}, 1 - 0.9 * i / bodies, name));
        }
        d.camera = make_camera({0.4, 0.5, 3}, {0, 0, 0}, 45);
        expect_all_equal(shoot(d, {.integrator = without_roulette({})}), sky, gamma(4096), std::to_string(bodies));
    }
}

TEST(Media, CostNothingWhereThereAreNone)
{
    EXPECT_TRUE(build_scene(spheres_scene()).media.empty());
    SceneDescription d = media_scene();
    EXPECT_EQ(build_scene(d).media.size(), 7u);
    d.render.legacy = true;
    EXPECT_TRUE(build_scene(d).media.empty());
}

TEST(Media, RefuseWhatCannotBe)
{
    SceneDescription d = aquarium();
    d.materials[0].opacity = 0.5f;
    expect_refused(d, "material 'water' has a 'priority' and an opacity");
    d = aquarium();
    d.materials[0].emission = {1, 1, 1};
    expect_refused(d, "material 'water' has a 'priority' and emission");
    d = aquarium();
    d.materials.push_back(make_lambert("both", {}));
    d.materials.back().type = MaterialType::mix;
    d.materials.back().first = "floor", d.materials.back().second = "water";
    d.spheres[0].material = "both";
    expect_refused(d, "cannot be a part of the mix 'both'");
    d = aquarium();
    d.camera->inside = "floor";
    expect_refused(d, "the camera cannot be inside of 'floor', which fills nothing");
    d.camera->inside = "watr";
    expect_refused(d, "unknown material 'watr'; did you mean 'water'?");
}

}  // namespace
}  // namespace lancer
