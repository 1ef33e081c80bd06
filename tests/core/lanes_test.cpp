// What is computed of eight at once has the bits of each alone.
#include <gtest/gtest.h>

#include <bit>

#include "core/distribution.h"
#include "core/lanes/pack.h"
#include "core/lanes/sampler.h"
#include "core/ray.h"
#include "support/random.h"

namespace lancer {
namespace {

uint32_t bits_of(float x) { return std::bit_cast<uint32_t>(x); }

TEST(Lanes, MasksAreTheirBits)
{
    const UInt8 yes{1, 2, 3, 4, 5, 6, 7, 8}, no{};
    for (uint32_t set = 0; set < 256; ++set) {
        EXPECT_EQ(movemask(lanes_of(set)), set);
        const UInt8 chosen = select(lanes_of(set), yes, no);
        for (uint32_t i = 0; i < float_lanes; ++i) EXPECT_EQ(chosen[i], set >> i & 1 ? i + 1 : 0) << set;
    }
}

TEST(Lanes, SamplersGiveTheSameNumbers)
{
    Random random(1);
    for (const SamplerKind kind : {SamplerKind::sobol, SamplerKind::independent})
        for (int round = 0; round < 200; ++round) {
            std::array<uint64_t, float_lanes> keys;
            KeyLanes key{};
            UInt8 sample{};
            const uint64_t seed = random.bits();
            for (uint32_t i = 0; i < float_lanes; ++i) {
                keys[i] = Sampler::key_of(seed, i, 0);
                key.low[i] = static_cast<uint32_t>(keys[i]), key.high[i] = static_cast<uint32_t>(keys[i] >> 32);
                sample[i] = static_cast<uint32_t>(random.bits() >> (round % 32 + 32));
            }
            const AddressLanes address(kind, key, static_cast<uint32_t>(round), Dim::bsdf);
            const Vec2x8 two = address.get2(sample);
            const Float8 one = address.get1(sample), first = address.get2_x(sample);
            const Vec3x8 three = address.get3(sample);
            for (uint32_t i = 0; i < float_lanes; ++i) {
                const Sampler alone(kind, seed, i, sample[i], 0);
                const Vec2 u = alone.get2(static_cast<uint32_t>(round), Dim::bsdf);
                EXPECT_EQ(bits_of(two.x[i]), bits_of(u.x));
                EXPECT_EQ(bits_of(two.y[i]), bits_of(u.y));
                EXPECT_EQ(bits_of(first[i]), bits_of(u.x));
                EXPECT_EQ(bits_of(three.x[i]), bits_of(u.x));
                EXPECT_EQ(bits_of(three.y[i]), bits_of(u.y));
                EXPECT_EQ(bits_of(three.z[i]), bits_of(one[i]));
                EXPECT_EQ(bits_of(one[i]), bits_of(alone.get1(static_cast<uint32_t>(round), Dim::bsdf)));
            }
        }
}

TEST(Lanes, StepsToTheNextFloatAreTheSame)
{
    const std::array<float, 8> ends{0.0f, -0.0f, 0x1p-149f, -0x1p-149f, 1.0f, -1.0f, 1e38f, 0x1p-126f};
    for (const float x : ends)
        for (const float by : ends)
            EXPECT_EQ(bits_of(next_towards(broadcast(x), broadcast(by))[3]), bits_of(next_towards(x, by)))
                << x << " by " << by;
}

TEST(Lanes, OriginsOffASurfaceAreTheSame)
{
    Random random(2);
    for (int round = 0; round < 2000; ++round) {
        const Vec3 p = to_float(random.point(-3, 3)), n = to_float(random.direction()),
                   w = to_float(random.direction());
        const Vec3 error = abs(p) * gamma(7);
        const auto all = [](Vec3 v) { return Vec3x8{broadcast(v.x), broadcast(v.y), broadcast(v.z)}; };
        const Vec3 alone = offset_origin(p, error, n, w);
        const Vec3 of = lane(offset_origin(all(p), all(error), all(n), all(w)), 5);
        EXPECT_TRUE(of == alone) << of.x << " " << alone.x;
    }
}

TEST(Lanes, PackedAreTheWantedOnesInOrder)
{
    const UInt8 x{0, 1, 2, 3, 4, 5, 6, 7};
    for (uint32_t wanted = 0; wanted < 256; ++wanted) {
        std::array<uint32_t, float_lanes> packed;
        Packing(wanted).store(packed.data(), x);
        size_t next = 0;
        for (uint32_t i = 0; i < float_lanes; ++i) {
            if ((wanted >> i & 1) == 0) continue;
            EXPECT_EQ(packed[next++], i) << wanted;
        }
    }
}

TEST(Lanes, StretchedChoicesAreTheSame)
{
    Random random(3);
    for (const std::vector<double>& weights :
         {std::vector<double>{1}, {1, 1}, {3, 1, 0, 2}, {0, 0, 5, 0.1, 0}, std::vector<double>(32, 0.7)}) {
        const Discrete d(weights);
        ASSERT_TRUE(d.can_remap());
        for (int round = 0; round < 500; ++round) {
            Float8 u{};
            for (uint32_t i = 0; i < float_lanes; ++i)
                u[i] = round == 0 ? (i % 2 ? 0 : 1 - 0x1p-24f) : static_cast<float>(random.unit());
            u = min(u, broadcast(1 - 0x1p-24f));
            const Discrete::RemappedLanes of = d.sample_remapped(u);
            for (uint32_t i = 0; i < float_lanes; ++i) {
                const Discrete::Remapped alone = d.sample_remapped(u[i]);
                EXPECT_EQ(of.index[i], alone.index);
                EXPECT_EQ(bits_of(of.u[i]), bits_of(alone.u));
                EXPECT_GT(weights[alone.index], 0);
            }
        }
    }
}

}  // namespace
}  // namespace lancer
