// Which medium a ray is in, against lists without a limit and rules without a trick.
#include "materials/medium.h"

#include <gtest/gtest.h>

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
    int depths[MediumStack::capacity + 1] = {};
    for (int i = 0; i < 20000; ++i) {
        const bool full = entered.size() == MediumStack::capacity;
        if (entered.empty() || (!full && random.unit() < 0.55f)) {
            entered.push_back(static_cast<uint16_t>(random.below(static_cast<uint32_t>(media.size()))));
            stack.enter(entered.back());
        } else {
            // Bodies may be left in any order; of two that are alike the one entered last.
            const uint16_t id = entered[random.below(static_cast<uint32_t>(entered.size()))];
            for (size_t k = entered.size(); k-- > 0;)
                if (entered[k] == id) {
                    entered.erase(entered.begin() + static_cast<std::ptrdiff_t>(k));
                    break;
                }
            ASSERT_TRUE(stack.leave(id));
        }
        ++depths[entered.size()];
        const MediumStack::Current is = stack.current(media), should = expected(entered);
        ASSERT_EQ(is.id, should.id) << i;
        ASSERT_EQ(is.ior, should.ior) << i;
    }
    for (const int n : depths) EXPECT_GT(n, 100);
}

TEST(MediumStack, ForgetsTheOldestUntilItIsLeft)
{
    const std::vector<Medium> all{{.ior = 1.1f, .priority = 9}, {.ior = 1.2f, .priority = 1}};
    MediumStack stack;
    stack.enter(0);
    for (size_t i = 1; i < MediumStack::capacity; ++i) stack.enter(1);
    EXPECT_EQ(stack.current(all).id, 0);
    stack.enter(1);
    EXPECT_EQ(stack.current(all).id, 1) << "one too many";
    EXPECT_TRUE(stack.leave(1));
    const Boundary out = cross(all, stack, 0, false);
    EXPECT_EQ(out.here.current(all).id, 0) << "what is left without having been entered was there from the start";
    EXPECT_EQ(out.beyond.current(all).id, 1);
    EXPECT_FALSE(out.absent);
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
        in.enter(a);
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
