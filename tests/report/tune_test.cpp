// What `lancer tune` measures: ratios that are known by construction, not seconds.
#include "report/tune.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "render/config.h"
#include "support/render.h"

namespace lancer {
namespace {

struct Tuned {
    TuneResult result;
    uint32_t rounds_heard = 0;

    explicit Tuned(const SceneDescription& d, RenderSettings settings = {}, uint32_t pictures = UINT32_MAX)
    {
        settings.size = {24, 18}, settings.spp = 16;
        const Renderer renderer(build_scene(d), configure(settings, 256));
        uint32_t asked = 0;
        with_threads(1, [&] {
            result = tune(renderer, *d.camera,
                          {.settings = settings,
                           .seconds = 0,
                           .round_done = [&](uint32_t rounds) { rounds_heard = rounds; },
                           .is_stopped = [&] { return ++asked > pictures; }});
        });
    }
    const TuneRow* row(std::string_view name) const
    {
        const auto found = std::find_if(result.rows.begin(), result.rows.end(),
                                        [&](const TuneRow& r) { return r.option->name == name; });
        return found == result.rows.end() ? nullptr : &*found;
    }
};

// Paths alone find a small lamp seldom, whatever the random numbers; both values have the same mean in the long run.
TEST(Tune, MeasuresTheErrorOfASwitch)
{
    const Tuned t(cornell_scene());
    EXPECT_EQ(t.result.rounds, 6u);
    EXPECT_EQ(t.rounds_heard, 6u);
    EXPECT_EQ(t.result.pixels, 24u * 18u);
    const TuneRow* nee = t.row("nee");
    ASSERT_TRUE(nee);
    EXPECT_FALSE(nee->value);
    EXPECT_GT(nee->error.interval.low, 3);
    EXPECT_GT(nee->mean.interval.high, 0.9);
    for (const TuneRow& r : t.result.rows) {
        EXPECT_TRUE(r.option->bias.effect.empty()) << r.option->name;
        EXPECT_LE(r.both.interval.low, r.both.median);
        EXPECT_GE(r.both.interval.high, r.both.median);
        EXPECT_GT(r.time.interval.low, 0);
    }
}

// The value that is given is the one that others are compared with.
TEST(Tune, ComparesWithTheSettings)
{
    RenderSettings settings;
    settings.nee = false;
    const TuneRow* nee = Tuned(cornell_scene(), settings).row("nee");
    ASSERT_TRUE(nee);
    EXPECT_TRUE(nee->value);
    EXPECT_LT(nee->error.interval.high, 1.0 / 3);
}

// Bounces never meet a point of light.
TEST(Tune, ShowsThatAValueMissesLight)
{
    const TuneRow* nee = Tuned(lights_scene()).row("nee");
    ASSERT_TRUE(nee);
    EXPECT_LT(nee->mean.interval.high, 0.95);
}

TEST(Tune, LeavesOutWhatChangesNothing)
{
    EXPECT_TRUE(Tuned(closed_furnace(0)).result.rows.empty());
    EXPECT_FALSE(Tuned(cornell_scene()).row("always_nee"));
}

// An interrupted round does not count.
TEST(Tune, StopsBetweenPictures)
{
    EXPECT_EQ(Tuned(cornell_scene(), {}, 0).result.rounds, 0u);
    const Tuned some(cornell_scene(), {}, 40);
    EXPECT_GT(some.result.rounds, 0u);
    EXPECT_LT(some.result.rounds, 6u);
    EXPECT_EQ(some.rounds_heard, some.result.rounds);
}

}  // namespace
}  // namespace lancer
