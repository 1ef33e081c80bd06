// Which medium a ray is in, against lists without a limit and rules without a trick.
#include "materials/medium.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "support/random.h"

namespace lancer {
namespace {

const std::vector<Medium> media{{.ior = 1.33f, .priority = 1},
                                {.ior = 1.5f, .priority = 2},
                                {.ior = 2, .priority = 2},
                                {.ior = 1, .priority = 7},
                                {.ior = 1.6f},
                                {.ior = 0.5f}};

// The rule in words: the latest of those without a priority hides what was entered before it; of the others the
// highest priority, the earliest among equals.
MediumStack::Current expected(const std::vector<uint16_t>& entered)
{
    size_t first = 0;
    float around = 1;
    MediumStack::Current best;
    for (size_t i = 0; i < entered.size(); ++i)
        if (!media[entered[i]].priority) first = i;
    if (first > 0) around = expected({entered.begin(), entered.begin() + static_cast<std::ptrdiff_t>(first)}).ior;
    for (size_t i = first; i < entered.size(); ++i) {
        const Medium& m = media[entered[i]];
        if (!m.priority) {
            best = {entered[i], around * m.ior};
            continue;
        }
        const bool beats_best =
            best.id == no_medium || !media[best.id].priority || *m.priority > *media[best.id].priority;
        if (beats_best) best = {entered[i], m.ior};
    }
    return best;
}

TEST(MediumStack, IsWhatWasEnteredAndNotLeft)
{
    Random random(5);
    MediumStack stack;
    std::vector<uint16_t> entered;
    const size_t capacity = MediumStack::capacity(media);
    std::vector<int> depths(capacity + 1);
    for (int i = 0; i < 200000; ++i) {
        const bool full = entered.size() == capacity;
        if (entered.empty() || (!full && random.unit() < 0.55f)) {
            entered.push_back(static_cast<uint16_t>(random.below(static_cast<uint32_t>(media.size()))));
            ASSERT_TRUE(stack.enter(media, entered.back()));
        } else {
            // Bodies may be left in any order; of two that are alike the one entered last.
            const uint16_t id = entered[random.below(static_cast<uint32_t>(entered.size()))];
            for (size_t k = entered.size(); k-- > 0;)
                if (entered[k] == id) {
                    entered.erase(entered.begin() + static_cast<std::ptrdiff_t>(k));
                    break;
                }
            ASSERT_TRUE(stack.leave(media, id));
        }
        ++depths[entered.size()];
        const MediumStack::Current is = stack.current(media), should = expected(entered);
        ASSERT_EQ(is.id, should.id) << i;
        ASSERT_EQ(is.ior, should.ior) << i;
    }
    for (const int n : depths) EXPECT_GT(n, 100);
}

TEST(MediumStack, TellsSevenBodiesApartInAllButHugeScenes)
{
    const auto places = [](size_t count) { return MediumStack::capacity(std::vector<Medium>(count)); };
    EXPECT_EQ(places(1), 60u);
    EXPECT_EQ(places(15), 15u);
    EXPECT_EQ(places(255), 7u);
    EXPECT_EQ(places(65535), 3u);
    // The largest id in every place.
    const std::vector<Medium> most(65535, Medium{.priority = 1});
    MediumStack stack;
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(stack.enter(most, 65534));
    EXPECT_EQ(stack.current(most).id, 65534);
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(stack.leave(most, 65534));
    EXPECT_EQ(stack, MediumStack());
}

TEST(MediumStack, PassesByWhatFindsNoPlace)
{
    const std::vector<Medium> all{{.ior = 1.1f, .priority = 1}, {.ior = 1.2f, .priority = 9}, {.ior = 1.3f}};
    MediumStack full;
    for (size_t i = 0; i < MediumStack::capacity(all); ++i) ASSERT_TRUE(full.enter(all, 0));
    for (const uint16_t id : {uint16_t{1}, uint16_t{2}}) {
        const Boundary in = cross(all, full, id, true), out = cross(all, in.beyond, id, false);
        EXPECT_TRUE(in.absent && out.absent);
        EXPECT_EQ(in.beyond.current(all).id, 0);
        EXPECT_EQ(out.beyond, full);
    }
}

TEST(MediumStack, WhatIsLeftWithoutHavingBeenEnteredWasThereFromTheStart)
{
    const std::vector<Medium> all{{.ior = 1.1f, .priority = 9}, {.ior = 1.2f, .priority = 1}};
    MediumStack stack;
    stack.enter(all, 1);
    const Boundary out = cross(all, stack, 0, false);
    EXPECT_EQ(out.here.current(all).id, 0);
    EXPECT_EQ(out.beyond.current(all).id, 1);
    EXPECT_FALSE(out.absent);
}

// The squared ratio of indices is what light gains at a surface: they must multiply to the index at hand, whatever is
// entered and left, more than finds a place included. All bodies left, it is 1 again.
TEST(MediumStack, RatiosOfIndicesMultiplyToTheIndexThatIsThere)
{
    Random random(8);
    for (const size_t count : {size_t{3}, size_t{40}, size_t{3000}}) {
        std::vector<Medium> all(count);
        for (Medium& m : all) m = {.ior = 1 + random.unit(), .priority = static_cast<int32_t>(random.below(5))};
        const size_t most = MediumStack::capacity(all) + 25;  // more than are counted
        size_t deepest = 0;
        for (int path = 0; path < 50; ++path) {
            MediumStack stack;
            std::vector<uint16_t> bodies;
            double index = 1;
            for (int i = 0; i < 400 || !bodies.empty(); ++i) {
                const bool enters = i < 200 && bodies.size() < most && (bodies.empty() || random.unit() < 0.7f);
                if (!enters && bodies.empty()) continue;
                const size_t at = enters ? bodies.size() : random.below(static_cast<uint32_t>(bodies.size()));
                if (enters) bodies.push_back(static_cast<uint16_t>(random.below(static_cast<uint32_t>(count))));
                const Boundary c = cross(all, stack, bodies[at], enters);
                if (!enters) bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(at));
                if (!c.absent) index *= static_cast<double>(c.eta);
                stack = c.beyond;
                deepest = std::max(deepest, bodies.size());
                const auto there = static_cast<double>(stack.current(all).ior);
                ASSERT_NEAR(index, there, 1e-4 * there) << count << ' ' << path << ' ' << i;
            }
            ASSERT_EQ(stack.current(all).id, no_medium);
        }
        EXPECT_GT(deepest, MediumStack::capacity(all) + 15) << count;
    }
}

// Over all pairs, from either side.
TEST(Boundary, HasTheIndicesOfTheMediaThatTouch)
{
    const MediumStack empty;
    for (uint16_t a = 0; a < 4; ++a)
        for (uint16_t b = 0; b < 4; ++b) {
            if (a == b) continue;
            const std::string what = std::to_string(a) + " " + std::to_string(b);
            const MediumStack in_a = cross(media, empty, a, true).beyond;
            const Boundary in = cross(media, in_a, b, true), out = cross(media, in.beyond, b, false);
            const bool hides = *media[a].priority >= *media[b].priority;
            EXPECT_EQ(in.absent, hides) << what;
            EXPECT_EQ(out.absent, hides) << what;
            EXPECT_EQ(in.eta, hides ? 1 : media[b].ior / media[a].ior) << what;
            EXPECT_EQ(out.eta, hides ? 1 : media[a].ior / media[b].ior) << what;
            EXPECT_EQ(out.beyond, in_a) << what;
            // Out of a first: from what hides the other into it, or out of nothing.
            const Boundary first = cross(media, in.beyond, a, false);
            EXPECT_EQ(first.absent, !hides) << what;
            EXPECT_EQ(first.eta, hides ? media[b].ior / media[a].ior : 1) << what;
        }
}

TEST(Boundary, WithoutAPriorityIsAlwaysThereAsItsMaterialSays)
{
    for (uint16_t a = 0; a < media.size(); ++a) {
        MediumStack in;
        in.enter(media, a);
        for (const uint16_t b : {uint16_t{4}, uint16_t{5}}) {
            const Boundary c = cross(media, in, b, true);
            EXPECT_FALSE(c.absent);
            EXPECT_EQ(c.eta, 0);
            EXPECT_EQ(c.beyond.current(media).id, b);
            EXPECT_EQ(cross(media, c.beyond, b, false).beyond, in);
        }
        EXPECT_EQ(cross(media, in, no_medium, true).here, in) << "no body: nothing changes";
        EXPECT_EQ(cross(media, in, no_medium, true).beyond, in);
    }
}

TEST(Medium, AbsorbsByTheExponentialAndNothingByNothing)
{
    const Medium m{.absorption = {0, 1, 2}};
    for (const float t : {0.0f, 0.5f, 3.0f}) {
        const Color c = transmittance(m, t);
        EXPECT_EQ(c.r, 1);
        EXPECT_FLOAT_EQ(c.g, std::exp(-t));
        EXPECT_FLOAT_EQ(c.b, std::exp(-2 * t));
    }
    EXPECT_EQ(transmittance(m, std::numeric_limits<float>::infinity()), (Color{1, 0, 0}));
}

}  // namespace
}  // namespace lancer
