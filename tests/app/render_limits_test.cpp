// Where passes end.
#include "app/render/limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace lancer {
namespace {

// The ends of all passes of a render whose passes take next to no time.
std::vector<uint32_t> ends(const RenderLimits::Given& given)
{
    RenderLimits limits(given);
    std::vector<uint32_t> all;
    for (uint32_t done = 0; done < given.spp; all.push_back(done)) {
        const uint32_t end = limits.next_end(done);
        EXPECT_GT(end, done);
        EXPECT_LE(end, given.spp);
        if (end <= done) break;
        limits.begin_pass();
        limits.end_pass();
        done = end;
    }
    return all;
}

using Ends = std::vector<uint32_t>;

TEST(RenderLimits, SamplesDoubleFromEightOn)
{
    EXPECT_EQ(ends({.spp = 60, .time = {}, .error = {}}), (Ends{8, 16, 32, 60}));
    EXPECT_EQ(ends({.spp = 6, .time = {}, .error = {}}), (Ends{3, 6}));
    EXPECT_EQ(ends({.spp = 1, .time = {}, .error = {}}), (Ends{1}));
    EXPECT_EQ(ends({.spp = 12, .time = {}, .error = {}, .looks_early = true}), (Ends{1, 2, 4, 8, 12}));
}

// One that is stopped early leaves no tile without a sample.
TEST(RenderLimits, ALongRenderBeginsWithASampleOfEachPixel)
{
    EXPECT_EQ(ends({.spp = 64, .time = {}, .error = {}}), (Ends{1, 2, 4, 8, 16, 32, 64}));
    EXPECT_EQ(ends({.spp = 100, .time = {}, .error = {}}), (Ends{1, 2, 4, 8, 16, 32, 64, 100}));
}

TEST(RenderLimits, WithAStopRuleAPassIsATenthOfTheSamples)
{
    const Ends all = ends({.spp = 30, .time = 86400.0, .error = {}});
    EXPECT_EQ(all, (Ends{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 22, 24, 26, 28, 30}));
    EXPECT_EQ(all, ends({.spp = 30, .time = {}, .error = 0.01}));
}

TEST(RenderLimits, PassesAreNeverLongerThanWhatATileMayTake)
{
    EXPECT_EQ(ends({.spp = 1200, .time = {}, .error = {}}),
              (Ends{1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 768, 1024, 1200}));
}

TEST(RenderLimits, PassesEndWhereHalvesAreCompared)
{
    for (const auto& given : {RenderLimits::Given{.spp = 2000, .time = {}, .error = {}, .looks_early = true},
                              RenderLimits::Given{.spp = 2000, .time = 86400.0, .error = 0.1},
                              RenderLimits::Given{.spp = 2000, .time = {}, .error = 0.1}}) {
        const Ends all = ends(given);
        for (uint32_t mark = 1; mark < given.spp; mark *= 2) EXPECT_TRUE(std::ranges::find(all, mark) != all.end());
    }
}

}  // namespace
}  // namespace lancer
