// What is packed side by side is what was put in: numbers, rays and where these start, of the lanes that were wanted.
#include "render/wide/states.h"

#include <gtest/gtest.h>

#include "support/random.h"

namespace lancer {
namespace {

constexpr size_t most = 40;  // rays

struct Sent {
    Ray ray;
    Vec3 radiance;
    uint32_t slot;
};

Vec3x8 vectors(Random& random)
{
    Vec3x8 v{};
    for (size_t i = 0; i < float_lanes; ++i) set_lane(v, i, to_float(random.point(-1, 1)));
    return v;
}

TEST(PackedStates, HoldTheLanesThatWereWanted)
{
    Random random(41);
    PackedStates<ShadowLanes> packed;
    packed.reserve(most);
    for (int repetition = 0; repetition < 200; ++repetition) {
        packed.clear();
        std::vector<Sent> sent;
        while (sent.size() + float_lanes <= most) {
            const uint32_t wanted = repetition == 0 ? 255 : repetition == 1 ? 0x81 : random.below(255) + 1;
            const Vec3x8 org = vectors(random), dir = vectors(random);
            Float8 t_max{};
            std::array<uint32_t, float_lanes> start;
            ShadowLanes lanes{vectors(random), {}};
            for (size_t i = 0; i < float_lanes; ++i) {
                t_max[i] = random.unit(), start[i] = random.below(1000), lanes.slot[i] = random.below(1000);
                if ((wanted >> i & 1) == 0) continue;
                const Ray ray{.org = lane(org, i), .dir = lane(dir, i), .t_max = t_max[i], .leaf_hint = start[i]};
                sent.push_back({ray, lane(lanes.radiance, i), lanes.slot[i]});
            }
            packed.push(wanted, org, dir, t_max, lanes);
            packed.set_leaf_hints(wanted, from_array(start));
        }
        ASSERT_EQ(packed.size(), sent.size());
        ASSERT_EQ(packed.rays().size(), sent.size());
        for (size_t i = 0; i < sent.size(); ++i) {
            ShadowLanes loaded;
            packed.load(i, loaded);
            EXPECT_EQ(lane(loaded.radiance, 0), sent[i].radiance);
            EXPECT_EQ(loaded.slot[0], sent[i].slot);
            const Ray &ray = packed.rays()[i], &wanted = sent[i].ray;
            EXPECT_EQ(ray.org, wanted.org);
            EXPECT_EQ(ray.dir, wanted.dir);
            EXPECT_EQ(ray.t_min, Ray{}.t_min);
            EXPECT_EQ(ray.t_max, wanted.t_max);
            EXPECT_EQ(ray.leaf_hint, wanted.leaf_hint) << i;
        }
    }
}

}  // namespace
}  // namespace lancer
