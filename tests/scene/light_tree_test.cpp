#include "scene/lights/tree.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random.h"
#include "support/render.h"
#include "support/scenes/lamp_grid.h"
#include "support/shoot.h"
#include "support/statistics/chi_square.h"

namespace lancer {
namespace {

// Small lights all over a box, that face anywhere; powers 10^[-spread, spread].
std::vector<LightBounds> random_lights(uint32_t count, double spread, Random& random)
{
    std::vector<LightBounds> lights(count);
    for (LightBounds& l : lights) {
        const Vec3d p = random.point(-5, 5);
        l.box.grow(p);
        l.box.grow(p + random.point(0, 0.1));
        l.normals = {random.direction(), random.below(4) == 0 ? pi_d : 0};
        l.both_sides = random.below(5) == 0;
        l.power = std::pow(10.0, random.uniform(-spread, spread));
    }
    return lights;
}

// Drawn as often as it says, and it adds up to one.
TEST(LightTree, ChoosesWithTheProbabilityThatItSays)
{
    Random random(70);
    for (const uint32_t count : {1u, 2u, 9u, 70u, 300u}) {
        const LightTree tree(random_lights(count, 1, random));
        for (int round = 0; round < 5; ++round) {
            const Vec3 place = to_float(random.point(-8, 8)), normal = to_float(random.direction());
            std::vector<double> expected;
            double sum = 0;
            constexpr int n = 20000;
            for (uint32_t id = 0; id < count; ++id) {
                const double p = static_cast<double>(tree.probability(id, place, normal));
                sum += p;
                expected.push_back(p * n);
            }
            std::vector<uint64_t> observed(count);
            int none = 0;
            for (int i = 0; i < n; ++i) {
                const LightTree::Choice c = tree.choose(place, normal, (i + random.uniform()) / n);
                if (c.probability == 0) {
                    ++none;
                    continue;
                }
                ++observed[c.light];
                EXPECT_NEAR(c.probability / tree.probability(c.light, place, normal), 1, 1e-5);
            }
            if (sum == 0) {
                EXPECT_EQ(none, n);
                continue;
            }
            // Groups of which no member reaches the place are chosen in vain.
            EXPECT_NEAR(sum, 1 - none / double{n}, 2e-3) << count;
            for (uint32_t id = 0; id < count; ++id)
                EXPECT_NEAR(static_cast<double>(observed[id]), expected[id], 3 + 0.01 * expected[id]) << count;
        }
    }
}

// No light that a place sees may be out of reach: a point of it in front of the place, the place in front of it.
TEST(LightTree, ReachesEveryLightThatShinesThere)
{
    Random random(71);
    const std::vector<LightBounds> all_over = random_lights(200, 6, random);
    // Side by side, so that only the cone of their normals says that some shine at a place.
    std::vector<LightBounds> bulb = random_lights(200, 0, random);
    for (LightBounds& l : bulb) {
        l.box = {};
        l.box.grow(random.point(0, 1e-3));
        l.normals = {normalize(random.direction() + Vec3d{1.5, 0, 0}), 0};
        l.both_sides = false;
    }
    uint32_t lit = 0;
    for (int round = 0; round < 400; ++round) {
        const std::vector<LightBounds>& lights = round % 2 ? bulb : all_over;
        const LightTree tree(lights);
        const Vec3 place = to_float(random.point(-6, 6)), normal = to_float(random.direction());
        for (uint32_t id = 0; id < lights.size(); ++id) {
            const LightBounds& l = lights[id];
            const Vec3d e = l.box.upper - l.box.lower;
            const Vec3d p = l.box.lower + Vec3d{e.x * random.uniform(), e.y * random.uniform(), e.z * random.uniform()};
            const Vec3d w = normalize(p - to_double(place));
            const double towards = -dot(w, l.normals.axis);
            const bool shines = l.both_sides || l.normals.angle > 0 || towards > 1e-3;
            if (!shines || std::abs(dot(w, to_double(normal))) < 1e-3) continue;
            ++lit;
            EXPECT_GT(tree.probability(id, place, normal), 0) << id;
        }
    }
    EXPECT_GT(lit, 10000u);
}

// Beside seven that are 10^9 times as strong: its part of [0, 1) is small, not gone.
TEST(LightTree, ChoosesTheWeakestInItsPart)
{
    std::vector<LightBounds> lights(8);
    for (size_t i = 0; i < lights.size(); ++i) {
        lights[i].box.grow(Vec3d{std::cos(static_cast<double>(i)), 1, std::sin(static_cast<double>(i))});
        lights[i].normals.angle = pi_d;
        lights[i].power = 1e9;
    }
    for (size_t weak = 0; weak < lights.size(); ++weak) {
        std::vector<LightBounds> these = lights;
        these[weak].power = 1;
        const LightTree tree(these);
        // The lower end of its part, by halving: to the left others are chosen that stand before it.
        double found = 0;
        for (int i = 0; i < 4000000 && found == 0; ++i) {
            const double u = i * 2.5e-7;
            const LightTree::Choice at = tree.choose({}, {0, 1, 0}, u), next = tree.choose({}, {0, 1, 0}, u + 2.5e-7);
            if (at.light == next.light && u > 0 && u + 5e-7 < 1) continue;
            double low = u, high = u + 2.5e-7;
            for (int k = 0; k < 60 && found == 0; ++k) {
                const double middle = 0.5 * (low + high);
                const uint32_t light = tree.choose({}, {0, 1, 0}, middle).light;
                if (light == weak) found = 1;
                (light == at.light ? low : high) = middle;
            }
            if (tree.choose({}, {0, 1, 0}, u).light == weak) found = 1;
        }
        EXPECT_GT(found, 0) << weak;
    }
}

// However they lie: a row in which each is far beyond the one before, and all in one place.
TEST(LightTree, StandsAnyArrangement)
{
    std::vector<LightBounds> row(1000), heap(1000);
    for (size_t i = 0; i < row.size(); ++i) {
        row[i].box.grow(Vec3d{std::pow(1.1, static_cast<double>(i) - 700), 0, 0});
        heap[i].box.grow(Vec3d{1, 2, 3});
        row[i].power = heap[i].power = 1;
        row[i].normals.angle = heap[i].normals.angle = pi_d;
    }
    for (const auto& lights : {row, heap}) {
        const LightTree tree(lights);
        EXPECT_LT(tree.node_count(), 250u);  // those at the bottom are full
        for (const Vec3 place : {Vec3{0, 0, 0}, Vec3{1, 2, 3}, Vec3{0, 1e10f, 0}}) {
            const LightTree::Choice c = tree.choose(place, {0, 1, 0}, 0.3);
            EXPECT_LT(c.light, 1000u);
        }
    }
}

// Lamps all over a floor, most of them far from where each place is: by the tree and by power the same picture, and
// with less noise.
SceneDescription lamp_field(uint32_t side)
{
    SceneDescription d;
    d.meshes.push_back(make_mesh(make_quad({-2, -0.8, 2}, {2, -0.8, 2}, {2, -0.8, -2}, {-2, -0.8, -2},
                                           make_lambert("floor", {0.6f, 0.6f, 0.5f}))));
    d.meshes.push_back(make_mesh(
        make_lamp_grid(side, {-1.95, -0.5, -1.95}, 3.9 / side, 0.6 / side, make_emitter("lamps", {5, 4, 3}))));
    for (const Vec3d& at : {Vec3d{1, 0, 0}, Vec3d{-1, 0.3, 0.5}})
        d.lights.push_back(light_of(LightType::point, {0.3f, 0.3f, 0.3f}, at));
    d.lights.push_back(light_of(LightType::sphere, {2, 2, 3}, {0.2, 0.1, -0.5}, 0.1));
    d.lights.push_back(sky_of({0.1f, 0.1f, 0.2f}));
    d.camera = make_camera({0, 1, 4}, {0, -0.6, 0}, 40);
    return d;
}

TEST(LightTree, LightsTheSame)
{
    SceneDescription by_tree = lamp_field(12), by_power = by_tree;
    by_power.render.light_tree = false;
    ASSERT_TRUE(build_scene(by_tree).lights.tree);
    ASSERT_FALSE(build_scene(by_power).lights.tree);
    const Shot shot{.integrator = Path{.max_depth = 3}, .spp = 32};
    Shot other = shot;
    other.seed = 7;
    Shot nee = shot;
    nee.seed = 9, nee.integrator = Path{.max_depth = 3, .direct = {true, false}};
    expect_one_mean({{by_tree, shot}, {by_power, other}, {by_tree, nee}},
                    {.pictures = 16, .detectable = 0.02, .rounding = 1e-5}, "lamps");
}

TEST(LightTree, IsForManyLights)
{
    EXPECT_TRUE(build_scene(lamp_field(6)).lights.tree);
    EXPECT_FALSE(build_scene(lamp_field(5)).lights.tree);
}

}  // namespace
}  // namespace lancer
