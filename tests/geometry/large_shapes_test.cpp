// Shapes that are tried before the tree is searched: chosen where that pays, and with the bits of the list.
#include "geometry/large_shapes.h"

#include <gtest/gtest.h>

#include "geometry/accelerators.h"

namespace lancer {
namespace {

class WideLaws : public testing::TestWithParam<AccelMaker> {};
INSTANTIATE_TEST_SUITE_P(Every, WideLaws, testing::ValuesIn(accel_makers), accel_name);

// Six giant walls around [-1, 1]^3, the last of them given twice, and balls between them.
Geometry room(uint32_t balls, uint64_t seed)
{
    Random random(seed);
    Geometry g;
    for (uint32_t i = 0; i < balls / 2; ++i) g.spheres.push_back({random.point(-1, 1), random.uniform(0.01, 0.1)});
    for (const double side : {-1.0, 1.0}) {
        g.spheres.push_back({{side * 20, 0, 0}, 19});
        g.spheres.push_back({{0, side * 20, 0}, 19});
        g.spheres.push_back({{0, 0, side * 20}, 19});
    }
    g.spheres.push_back(g.spheres.back());
    for (uint32_t i = balls / 2; i < balls; ++i) g.spheres.push_back({random.point(-1, 1), random.uniform(0.01, 0.1)});
    return g;
}

TEST(LargeShapes, AreTheWallsOfARoomOfManyAndAllOfFew)
{
    EXPECT_EQ(choose_large_shapes(room(100, 1)).spheres, (std::vector<uint32_t>{50, 51, 52, 53, 54, 55, 56}));
    EXPECT_EQ(choose_large_shapes(room(2, 1)).spheres.size(), 9u);
    Geometry g = room(2, 1);
    g.meshes.push_back(to_mesh(*make_cube()));
    EXPECT_EQ(choose_large_shapes(g).spheres, (std::vector<uint32_t>{1, 2, 3, 4, 5, 6, 7}));
    g.planes.resize(2);
    EXPECT_EQ(choose_large_shapes(g).planes.size(), 2u);
}

// Of spheres of much the same size a tree is the better home.
TEST(LargeShapes, AreNotTheLargestOfManyAlike)
{
    Random random(2);
    Geometry g;
    for (int i = 0; i < 1000; ++i) g.spheres.push_back({random.point(-1, 1), random.uniform(0.01, 0.5)});
    EXPECT_TRUE(choose_large_shapes(g).spheres.empty());
}

TEST(LargeShapes, AreNotThoseWithHoles)
{
    Geometry g = room(2, 1);
    g.planes.resize(1);
    g.alpha_test.passes_through = [](const void*, const Ray&, const Hit&) { return false; };
    g.alpha_test.spheres = true;
    EXPECT_TRUE(choose_large_shapes(g).spheres.empty());
    EXPECT_EQ(choose_large_shapes(g).planes.size(), 1u);
}

struct FourRays {
    float org_x[4], org_y[4], org_z[4], tnear[4], dir_x[4], dir_y[4], dir_z[4], tfar[4];
};

// A sphere, a plane and four rays: spheres from specks to worlds, rays from inside, from outside, from the surface,
// past and along it.
struct Round {
    Geometry g;
    std::array<Ray, 4> rays;
    FourRays four;
};
Round make_round(Random& random)
{
    Round round;
    const double radius = std::pow(10.0, random.uniform(-4, 5)), far = std::pow(10.0, random.uniform(-2, 5));
    round.g.spheres.push_back({random.point(-1, 1) * far, radius});
    round.g.planes.push_back({random.direction(), random.uniform(-2, 2)});
    FourRays& four = round.four;
    for (size_t i = 0; i < 4; ++i) {
        const Sphere& s = round.g.spheres[0];
        const std::array<double, 4> distances{0.5, 1, 1 + 1e-6, 3};
        const Vec3d out = random.direction(), at = s.center + out * (radius * distances[random.below(4)]);
        const double beside = radius * random.uniform(0, 1.05);
        const Vec3d aim = s.center + random.direction() * beside;
        Ray& r = round.rays[i];
        r.org = to_float(at), r.dir = to_float(normalize(random.below(4) ? aim - at : cross(out, random.direction())));
        four.org_x[i] = r.org.x, four.org_y[i] = r.org.y, four.org_z[i] = r.org.z, four.tnear[i] = r.t_min;
        four.dir_x[i] = r.dir.x, four.dir_y[i] = r.dir.y, four.dir_z[i] = r.dir.z, four.tfar[i] = r.t_max;
    }
    return round;
}

TEST(LargeShapes, FourAtOnceAreTheSameBitsAsOneByOne)
{
    Random random(3);
    int met = 0, left = 0;
    for (int round = 0; round < 20000; ++round) {
        const auto [g, rays, four] = make_round(random);
        const RayLanes wide(four, 0);
        const StopLanes sphere = stop(SphereLanes(g.spheres[0]), wide), plane = stop(g.planes[0], wide);
        for (size_t i = 0; i < 4; ++i) {
            const Hit s = first_opaque_hit<Kind::sphere>(g, 0, rays[i]),
                      p = first_opaque_hit<Kind::plane>(g, 0, rays[i]);
            ASSERT_EQ(static_cast<bool>(s), sphere.ok[i] != 0) << round;
            ASSERT_EQ(static_cast<bool>(p), plane.ok[i] != 0) << round;
            if (p) {
                ASSERT_EQ(static_cast<double>(p.t), plane.t[i]) << round;
            }
            if (!s) continue;
            ASSERT_EQ(static_cast<double>(s.t), sphere.t[i]) << round;
            ASSERT_EQ(s.exit, sphere.exit[i] != 0) << round;
            ++met;
            left += s.exit;
        }
    }
    EXPECT_GT(met, 30000);
    EXPECT_GT(left, 10000);
}

// What may be left out is not met, up to ends that are just before, at and beyond the place; and much is left out.
TEST(LargeShapes, WhatIsSurelyMissedIsNotMet)
{
    Random random(4);
    int met = 0, missed = 0, ends_before = 0;
    for (int round = 0; round < 20000; ++round) {
        const auto [g, rays, four] = make_round(random);
        const RayLanes wide(four, 0);
        const StopLanes sphere = stop(SphereLanes(g.spheres[0]), wide);
        for (const double part : {0.5, 1 - 0x1p-19, 1 - 0x1p-23, 1.0, 1 + 0x1p-23, 2.0}) {
            const Double4 end = select(sphere.ok, sphere.t * part, broadcast(part));
            const Mask4 misses = surely_misses(g.spheres[0], wide, end);
            for (size_t i = 0; i < 4; ++i) {
                const bool is_met = sphere.ok[i] && sphere.t[i] <= end[i];
                ASSERT_FALSE(misses[i] && is_met) << round << " " << i << " " << part;
                met += is_met;
                missed += misses[i] && !sphere.ok[i];
                ends_before += misses[i] && sphere.ok[i];
            }
        }
    }
    EXPECT_GT(met, 50000);
    EXPECT_GT(missed, 50000);
    EXPECT_GT(ends_before, 10000);
}

// With few balls all are wide, with many only the walls; between two in one place the first wins, wherever each is.
TEST_P(WideLaws, RoomsAreTheListsBitForBit)
{
    for (const uint32_t balls : {4u, 40u}) {
        Geometry g = room(balls, 4);
        for (const bool mesh : {false, true}) {
            if (mesh)
                g.meshes.push_back(to_mesh(*make_cube(), make_transform({0.3, 0, 0}, {20, 30, 40}, {0.4, 0.4, 0.4})));
            const auto accel = GetParam()(g), list = make_accelerator(AccelKind::list, g, "");
            Random random(5);
            for (int i = 0; i < 8000; ++i) {
                const Vec3 org = to_float(random.point(-1, 1));
                Ray ray{.org = org, .dir = to_float(random.direction())};
                if (random.below(2)) ray.t_max = static_cast<float>(random.uniform(0, 2));
                const Hit a = accel->closest(ray), b = list->closest(ray);
                ASSERT_TRUE(same_bits(a, b) || explainable(g, ray, a, b)) << balls << " " << i;
                ASSERT_TRUE(a.kind != Kind::sphere || (same_bits(a, b) && a.exit == b.exit)) << balls << " " << i;
                ASSERT_EQ(accel->any(ray), static_cast<bool>(a)) << balls << " " << i;
            }
        }
    }
}

}  // namespace
}  // namespace lancer
