#include "geometry/hit_lanes.h"

#include <gtest/gtest.h>

#include <array>

#include "support/random.h"

namespace lancer {
namespace {

TEST(HitLanes, AreThoseOfEachHit)
{
    Random random(33);
    const auto number = [&] { return static_cast<uint32_t>(random.unit() * 0x1p32); };
    for (int round = 0; round < 100; ++round) {
        std::array<Hit, float_lanes> hits;
        for (Hit& h : hits) {
            const auto part = [&] { return static_cast<float>(random.unit()); };
            h = {part(),
                 number(),
                 number(),
                 number(),
                 {part(), part()},
                 static_cast<Kind>(number() % 4),
                 number() % 2 == 0,
                 number()};
        }
        const HitLanes lanes(hits.data());
        for (uint32_t i = 0; i < float_lanes; ++i) {
            const Hit& h = hits[i];
            EXPECT_EQ(lanes.t[i], h.t);
            EXPECT_EQ(lanes.u[i], h.uv.x);
            EXPECT_EQ(lanes.v[i], h.uv.y);
            EXPECT_EQ(lanes.geometry[i], h.geometry);
            EXPECT_EQ(lanes.primitive[i], h.primitive);
            EXPECT_EQ(lanes.leaf_hint[i], h.leaf_hint);
            EXPECT_EQ(lanes.exist[i], h ? -1 : 0);
        }
    }
}

}  // namespace
}  // namespace lancer
