// What a ledger holds, and that its readers find every entry explained.
#include "render/bias_ledger.h"

#include <gtest/gtest.h>

#include "integrators/integrator.h"

namespace lancer {
namespace {

TEST(BiasLedger, IsNoneWhereTheMeanIsThatOfTheScene)
{
    EXPECT_EQ(bias_ledger({}, {}), "none");
    EXPECT_EQ(bias_ledger({.mis = false, .split = false, .stop = true, .stop_error = 0.5, .replicates = 8}, {}),
              "none");
}

TEST(BiasLedger, ListsIntegratorThenOptionsThenEvents)
{
    EXPECT_EQ(
        bias_ledger({.max_depth = 3, .direct = false, .multiscatter = false}, {.stopped_by = "time", .dropped = 2}),
        "max_depth=3, no_direct, no_multiscatter, stopped_by_time, dropped=2");
    if (knows_legacy()) {
        EXPECT_EQ(
            bias_ledger({.integrator = IntegratorKind::whitted, .max_depth = 7, .stop = true, .legacy = true}, {}),
            "no_diffuse_bounces, straight_shadows, max_depth=7, stop, legacy, clamp");
    }
}

TEST(BiasLedger, EveryEntryIsExplained)
{
    const std::vector<LedgerEntry> all = all_ledger_entries();
    for (const LedgerEntry& e : all) {
        EXPECT_FALSE(e.when.empty()) << e.entry;
        EXPECT_FALSE(e.effect.empty()) << e.entry;
    }
    const auto is_explained = [&](const std::string& entry) {
        return std::any_of(all.begin(), all.end(), [&](const LedgerEntry& e) { return e.entry == entry; });
    };
    for (const char* entry : {"max_depth=N", "no_direct", "no_emitters", "stop", "legacy", "clamp", "dropped=N"})
        EXPECT_TRUE(is_explained(entry)) << entry;
    for (size_t i = 0; i < enum_names<IntegratorKind>.size(); ++i)
        for (const IntegratorBias& bias : biases_of(static_cast<IntegratorKind>(i)))
            EXPECT_TRUE(is_explained(std::string(bias.entry))) << bias.entry;
}

}  // namespace
}  // namespace lancer
