// Instances and spheres that move while the shutter is open.
#include "geometry/motion.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "geometry/accelerators.h"

namespace lancer {
namespace {

// random_geometry() in which some of the instances and spheres go, turn and grow; in three steps.
Geometry moving_geometry(uint64_t seed)
{
    Geometry g = random_geometry(seed);
    Random random(seed + 1000);
    g.motion.instances.resize(g.instances.size());
    g.motion.spheres.resize(g.spheres.size());
    for (size_t i = 0; i < g.instances.size(); i += 2) {
        const Vec3d turn = random.point(-40, 40), way = random.point(-1, 1);
        for (const double x : {0.0, 1.0, 2.0})
            g.motion.instances[i].push_back(
                compose(make_transform(way * x, turn * x, {1 + 0.2 * x, 1, 1}), g.instances[i].to_world));
    }
    for (size_t i = 0; i < g.spheres.size(); i += 3) {
        const Sphere s = g.spheres[i];
        const Vec3d way = random.point(-1, 1);
        for (const double x : {0.0, 1.0, 2.0})
            g.motion.spheres[i].push_back({s.center + way * x, s.radius * (1 + 0.5 * x)});
    }
    return g;
}

// As a photograph of an instant has it.
Geometry frozen(const Geometry& g, float time)
{
    Geometry still = g;
    still.motion = {};
    for (uint32_t i = 0; i < g.instances.size(); ++i) still.instances[i] = *g.instance_at(i, time);
    for (uint32_t i = 0; i < g.spheres.size(); ++i) still.spheres[i] = *g.sphere_at(i, time);
    return still;
}

TEST(MotionSteps, GoStraightFromPlaceToPlace)
{
    const Steps<Sphere> steps{{{0, 0, 0}, 1}, {{4, 0, 0}, 1}, {{4, 8, 0}, 3}};
    EXPECT_EQ(place_at(steps, 0), steps[0]);
    EXPECT_EQ(place_at(steps, 0.25f), (Sphere{{2, 0, 0}, 1}));
    EXPECT_EQ(place_at(steps, 0.5f), steps[1]);
    EXPECT_EQ(place_at(steps, 0.75f), (Sphere{{4, 4, 0}, 2}));
    EXPECT_EQ(place_at(steps, 1), steps[2]);
}

class Moving : public testing::TestWithParam<AccelMaker> {};
INSTANTIATE_TEST_SUITE_P(Every, Moving, testing::ValuesIn([] {
                             std::vector<AccelMaker> makers = accel_makers;
                             std::erase_if(makers, [](const AccelMaker& m) { return m.kind == AccelKind::embree; });
                             return makers;
                         }()),
                         accel_name);

// At each time hits are those of the list, in what stands where things are then.
TEST_P(Moving, ThingsAreMetWhereTheyAreThen)
{
    for (uint64_t seed = 1; seed <= 3; ++seed) {
        const Geometry g = moving_geometry(seed);
        const auto accel = GetParam()(g);
        Random random(50 + seed);
        for (const float time : {0.0f, 0.2f, 0.5f, 0.93f}) {
            const Geometry then = frozen(g, time);
            const auto list = make_accelerator(AccelKind::list, then, "");
            std::vector<Ray> rays(3000);
            for (Ray& r : rays) r = random_ray(random, then), r.time = time;
            std::vector<Hit> hits(rays.size());
            std::vector<uint8_t> occluded(rays.size());
            accel->closest(rays, hits, Coherence::incoherent);
            accel->any(rays, occluded);
            size_t other = 0;
            for (size_t i = 0; i < rays.size(); ++i) {
                const Hit alone = accel->closest(rays[i]), expected = list->closest(rays[i]);
                EXPECT_EQ(occluded[i] != 0, static_cast<bool>(hits[i]));
                EXPECT_TRUE(same_bits(alone, hits[i]));
                if (same_primitive(alone, expected))
                    EXPECT_TRUE(same_bits(alone, expected)) << "ray " << i << " at " << time;
                else
                    EXPECT_TRUE(explainable(then, rays[i], alone, expected)) << "ray " << i << " at " << time, ++other;
            }
            EXPECT_LT(other, rays.size() / 16);
        }
    }
}

TEST(MotionOfThings, IsRefusedByEmbree)
{
    const Geometry g = moving_geometry(1);
    EXPECT_THROW(make_accelerator(AccelKind::embree, g, "avx2"), Error);
    EXPECT_NE(fastest_accelerator(g), AccelKind::embree);
}

}  // namespace
}  // namespace lancer
