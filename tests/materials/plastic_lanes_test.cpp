// Plastic at many places at once has the bits of plastic at each.
#include "materials/plastic_lanes.h"

#include <gtest/gtest.h>

#include "materials/samples.h"

namespace lancer {
namespace {

// Mostly above the surface, some of them grazing, some below and some in its plane.
Vec3 any_direction(Random& random)
{
    Vec3 w = random.unit_vector();
    const uint32_t kind = random.below(8);
    if (kind < 6) w.z = std::abs(w.z);
    if (kind == 6) w.z = 0;
    if (kind < 2) w.z *= kind == 0 ? 1e-3f : 1e-7f;
    return normalize(w);
}

void expect_color(const Vec3x8& found, uint32_t i, Color wanted)
{
    EXPECT_EQ(found.x[i], wanted.r);
    EXPECT_EQ(found.y[i], wanted.g);
    EXPECT_EQ(found.z[i], wanted.b);
}

// Eight places, some of them of plastic, each of any kind.
struct Places {
    std::vector<std::optional<PlasticBsdf>> bsdf;
    PlasticLanes lanes;
    Vec3x8 wo;

    explicit Places(Random& random)
    {
        const auto all = samples<Plastic>();
        const uint32_t part = random.below(9);
        lanes.clear();
        for (uint32_t i = 0; i < float_lanes; ++i) {
            bsdf.emplace_back();
            if (random.below(8) < part) bsdf[i] = all[random.below(static_cast<uint32_t>(all.size()))].material.at({});
        }
        // Whoever looks places up does so in no order.
        for (const bool odd : {true, false})
            for (uint32_t i = odd; i < float_lanes; i += 2)
                if (bsdf[i]) lanes.set(i, *bsdf[i]);
        for (uint32_t i = 0; i < float_lanes; ++i) set_lane(wo, i, any_direction(random));
        lanes.see(wo);
    }
    template <class F>
    void for_each(const F& f) const
    {
        uint32_t there = 0;
        for (uint32_t i = 0; i < float_lanes; ++i)
            if (bsdf[i]) there |= 1u << i;
        ASSERT_EQ(lanes.lanes(), there);
        for_bits(there, [&](uint32_t i) { f(i, *bsdf[i], lane(wo, i)); });
    }
};

TEST(PlasticLanes, EvaluateAsEachAlone)
{
    Random random(1);
    for (int k = 0; k < 20000; ++k) {
        const Places places(random);
        Vec3x8 wi;
        for (uint32_t i = 0; i < float_lanes; ++i) set_lane(wi, i, any_direction(random));
        const BsdfValueLanes f = places.lanes.eval(wi);
        places.for_each([&](uint32_t i, const PlasticBsdf& bsdf, Vec3 wo) {
            const BsdfValue wanted = bsdf.eval(wo, lane(wi, i));
            expect_color(f.f_cos, i, wanted.f_cos);
            EXPECT_EQ(f.pdf[i], wanted.pdf);
        });
        if (HasFailure()) return;
    }
}

TEST(PlasticLanes, SampleAsEachAlone)
{
    Random random(2);
    int found = 0, mirrored = 0, lost = 0;
    for (int k = 0; k < 20000; ++k) {
        const Places places(random);
        Float8 u;
        Vec2x8 v;
        for (uint32_t i = 0; i < float_lanes; ++i) u[i] = random.unit(), v.x[i] = random.unit(), v.y[i] = random.unit();
        const BsdfSampleLanes s = places.lanes.sample(u, v, square_to_cosine_hemisphere(v.x, v.y));
        places.for_each([&](uint32_t i, const PlasticBsdf& bsdf, Vec3 wo) {
            const auto wanted = bsdf.sample(wo, u[i], {v.x[i], v.y[i]});
            ASSERT_EQ((s.found >> i & 1) != 0, wanted.has_value());
            ++(!wanted ? lost : wanted->delta ? mirrored : found);
            if (!wanted) return;
            EXPECT_EQ((s.delta >> i & 1) != 0, wanted->delta);
            EXPECT_EQ(lane(s.wi, i), wanted->wi);
            expect_color(s.weight, i, wanted->weight);
            EXPECT_EQ(s.pdf[i], wanted->pdf);
            EXPECT_EQ(wanted->eta, 1);
        });
        if (HasFailure()) return;
    }
    EXPECT_GT(found, 1000);
    EXPECT_GT(mirrored, 1000);
    EXPECT_GT(lost, 1000);
}

}  // namespace
}  // namespace lancer
