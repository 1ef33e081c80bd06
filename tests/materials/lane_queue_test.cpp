// A material at many places at once has the bits of it at each.
#include "materials/lane_queue.h"

#include <gtest/gtest.h>

#include "materials/glass_queue.h"
#include "materials/metal_queue.h"
#include "materials/plastic_queue.h"
#include "materials/principled_queue.h"
#include "materials/samples.h"
#include "scene/wide_scene.h"

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

// Those of the samples of a material that are queued, seen from either side.
template <class M>
auto queued_points_of()
{
    static const auto materials = samples<M>();
    std::vector<decltype(std::declval<M>().at({}))> bsdfs;
    for (const auto& s : materials)
        for (const bool front : {true, false})
            if (const auto b = s.material.at({.front = front}); is_queued(b)) bsdfs.push_back(b);
    return bsdfs;
}

struct PlasticCase {
    static constexpr bool mirrors = true;
    using Queue = PlasticQueue;
    using Bsdf = PlasticBsdf;

    static std::vector<Bsdf> all() { return queued_points_of<Plastic>(); }
};
struct PrincipledCase {
    static constexpr bool mirrors = true;
    using Queue = PrincipledQueue;
    using Bsdf = PrincipledBsdf;

    static std::vector<Bsdf> all() { return queued_points_of<Principled>(); }
};

struct GlassCase {
    static constexpr bool mirrors = false;
    using Queue = GlassQueue;
    using Bsdf = GlassBsdf;

    static std::vector<Bsdf> all()
    {
        static std::vector<Glass> materials;
        for (const float ior : {0.7f, 1.3f, 1.9f})
            for (const float roughness : {0.02f, 0.3f, 1.0f})
                materials.push_back(make_glass({0.9f, 0.8f, ior < 1 ? 1.0f : 0.7f}, ior, roughness, false));
        materials.push_back(materials.back());
        materials.back().losses = {};
        std::vector<Bsdf> bsdfs;
        for (const Glass& m : materials)
            for (const bool front : {true, false}) bsdfs.push_back(m.at({.front = front}));
        return bsdfs;
    }
};

struct MetalCase {
    static constexpr bool mirrors = false;
    using Queue = MetalQueue;
    using Bsdf = MetalBsdf;

    static std::vector<Bsdf> all() { return queued_points_of<Metal>(); }
};

constexpr size_t eights = LaneQueue::most / float_lanes;

// As many eights of lanes as a list may have to do with, some of them of the material, each of any kind.
template <class Case>
struct Places {
    using Bsdf = typename Case::Bsdf;
    struct Eight {
        std::array<std::optional<Bsdf>, float_lanes> bsdf;
        LaneQueue::Eight of;
        Vec3x8 wo;
    };
    typename Case::Queue list;
    std::array<Eight, eights> eight;

    // Other places have been there before.
    void set(Random& random)
    {
        static const std::vector<Bsdf> all = Case::all();
        const uint32_t part = random.below(9);
        list.clear();
        for (Eight& e : eight) {
            e.of = list.begin_eight();
            for (auto& bsdf : e.bsdf) {
                bsdf.reset();
                if (random.below(8) < part) bsdf = all[random.below(static_cast<uint32_t>(all.size()))];
            }
            // Whoever looks places up does so in no order.
            for (const bool odd : {true, false})
                for (uint32_t i = odd; i < float_lanes; i += 2)
                    if (e.bsdf[i]) list.add(e.of, i, *e.bsdf[i]);
            for (uint32_t i = 0; i < float_lanes; ++i) set_lane(e.wo, i, any_direction(random));
            list.put_wo(e.of, e.wo);
        }
        list.see();
    }
    // f(number of the eight, eight, lane, bsdf, wo)
    template <class F>
    void for_each(const F& f) const
    {
        for (size_t k = 0; k < eights; ++k) {
            const Eight& e = eight[k];
            uint32_t there = 0;
            for (uint32_t i = 0; i < float_lanes; ++i)
                if (e.bsdf[i]) there |= 1u << i;
            ASSERT_EQ(e.of.lanes, there);
            for_each_lane(there, [&](uint32_t i) { f(k, e, i, *e.bsdf[i], lane(e.wo, i)); });
        }
    }
};

template <class Case>
struct LaneQueueTest : testing::Test {
};
using Cases = testing::Types<PlasticCase, PrincipledCase, GlassCase, MetalCase>;
TYPED_TEST_SUITE(LaneQueueTest, Cases);

TYPED_TEST(LaneQueueTest, EvaluatesAsEachAlone)
{
    Random random(1);
    Places<TypeParam> places;
    for (int round = 0; round < 2000; ++round) {
        places.set(random);
        std::array<Vec3x8, eights> wi;
        for (size_t k = 0; k < eights; ++k) {
            for (uint32_t i = 0; i < float_lanes; ++i) set_lane(wi[k], i, any_direction(random));
            places.list.put_wi(places.eight[k].of, wi[k]);
        }
        places.list.eval();
        places.for_each([&](size_t k, const auto& e, uint32_t i, const auto& bsdf, Vec3 wo) {
            if (bsdf.only_delta()) return;
            const BsdfValueLanes f = places.list.value(e.of);
            const BsdfValue wanted = bsdf.eval(wo, lane(wi[k], i));
            expect_color(f.f_cos, i, wanted.f_cos);
            EXPECT_EQ(f.pdf[i], wanted.pdf);
        });
        if (this->HasFailure()) return;
    }
}

TYPED_TEST(LaneQueueTest, SamplesAsEachAlone)
{
    Random random(2);
    Places<TypeParam> places;
    int found = 0, mirrored = 0, lost = 0;
    for (int round = 0; round < 2000; ++round) {
        places.set(random);
        std::array<Float8, eights> u;
        std::array<Vec2x8, eights> v;
        for (size_t k = 0; k < eights; ++k) {
            for (uint32_t i = 0; i < float_lanes; ++i)
                u[k][i] = random.unit(), v[k].x[i] = random.unit(), v[k].y[i] = random.unit();
            places.list.put_numbers(places.eight[k].of, u[k], v[k], square_to_cosine_hemisphere(v[k].x, v[k].y));
        }
        places.list.sample();
        places.for_each([&](size_t k, const auto& e, uint32_t i, const auto& bsdf, Vec3 wo) {
            const BsdfSampleLanes s = places.list.sampled(e.of);
            const auto wanted = bsdf.sample(wo, u[k][i], {v[k].x[i], v[k].y[i]});
            ASSERT_EQ((s.found >> i & 1) != 0, wanted.has_value());
            ++(!wanted ? lost : wanted->delta ? mirrored : found);
            if (!wanted) return;
            EXPECT_EQ((s.delta >> i & 1) != 0, wanted->delta);
            EXPECT_EQ(lane(s.wi, i), wanted->wi);
            expect_color(s.weight, i, wanted->weight);
            EXPECT_EQ(s.pdf[i], wanted->pdf);
            EXPECT_EQ(s.eta[i], wanted->eta);
        });
        if (this->HasFailure()) return;
    }
    EXPECT_GT(found, 1000);
    if (TypeParam::mirrors) {
        EXPECT_GT(mirrored, 1000);
    }
    EXPECT_GT(lost, 1000);
}

}  // namespace
}  // namespace lancer
