// Processes that are waited for: until they end, whatever becomes of their output, and no longer than they may take.
#include "app/study/child.h"

#include <gtest/gtest.h>
#include <signal.h>

#include "app/system_info.h"

namespace lancer {
namespace {

ChildResult shell(const std::string& command, double timeout_s)
{
    Signals signals;
    return run_child({.program = "/bin/sh",
                      .name = {},
                      .arguments = {"-c", command},
                      .environment = {{"WORD", "hello"}},
                      .timeout_s = timeout_s},
                     signals);
}

constexpr double long_enough = 300, forever = 3600;  // seconds

TEST(Child, SaysWhatItWroteAndHowItEnded)
{
    const ChildResult result = shell("echo $WORD; echo oh >&2; exit 7", long_enough);
    EXPECT_EQ(result.code, 7);
    EXPECT_EQ(result.out, "hello\n");
    EXPECT_EQ(result.err, "oh\n");
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(shell("kill -9 $$", long_enough).code, 128 + SIGKILL);
}

TEST(Child, IsReadToTheEndHoweverMuchItWrites)
{
    const ChildResult result = shell("head -c 3000000 /dev/zero; head -c 2000000 /dev/zero >&2", long_enough);
    EXPECT_EQ(result.out.size(), 3000000u);
    EXPECT_EQ(result.err.size(), 2000000u);
}

// Its end is what is waited for, with the same limits, not that of its output.
TEST(Child, MayCloseItsOutputAndGoOn)
{
    const ChildResult ended = shell("exec >&- 2>&-; sleep 0.2; exit 3", long_enough);
    EXPECT_EQ(ended.code, 3);
    EXPECT_FALSE(ended.timed_out);
    const double start = wall_seconds();
    const ChildResult killed = shell("exec >&- 2>&-; sleep " + std::to_string(forever), 0.2);
    EXPECT_TRUE(killed.timed_out);
    EXPECT_EQ(killed.code, 128 + SIGKILL);
    EXPECT_LT(wall_seconds() - start, forever / 2);
}

// What it started and left behind keeps its output open.
TEST(Child, MayEndBeforeWhatItStarted)
{
    const double start = wall_seconds();
    const ChildResult result = shell("sleep " + std::to_string(forever) + " & echo $!", forever);
    EXPECT_EQ(result.code, 0);
    EXPECT_LT(wall_seconds() - start, forever / 2);
    const int left = std::stoi(result.out);
    EXPECT_EQ(kill(left, SIGKILL), 0);
}

TEST(Child, IsKilledWhenItsTimeIsOver)
{
    const ChildResult result = shell("echo before; sleep " + std::to_string(forever), 0.2);
    EXPECT_TRUE(result.timed_out);
    EXPECT_EQ(result.out, "before\n");
}

}  // namespace
}  // namespace lancer
