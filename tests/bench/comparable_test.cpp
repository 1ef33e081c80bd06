#include "report/bench/comparable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace lancer {
namespace {

MachineBlock machine()
{
    MachineBlock m;
    m.cpu = "cpu", m.compiler = "g++", m.flags = "-O3", m.embree = "3.13.5", m.embree_isa = "avx2", m.tbb = "2021.8";
    m.num_cpus = 2, m.threads = 2, m.embree_asserts = true, m.load = 0.5;
    m.date = "monday", m.executable = "bench_a", m.lancer = "1";
    return m;
}

TEST(Comparable, TheSameMachineIs)
{
    MachineBlock other = machine();
    other.date = "friday", other.executable = "bench_b", other.lancer = "2", other.load = highest_load;
    EXPECT_TRUE(not_comparable(machine(), other).empty());
    EXPECT_TRUE(unfit(other).empty());
}

TEST(Comparable, EachDifferenceIsAReason)
{
    struct Change {
        const char* reason;
        std::function<void(MachineBlock&)> make;
    };
    const std::vector<Change> changes{
        {"CPU 'cpu' against 'x'", [](MachineBlock& m) { m.cpu = "x"; }},
        {"number of CPUs 2 against 3", [](MachineBlock& m) { m.num_cpus = 3; }},
        {"threads 2 against 1", [](MachineBlock& m) { m.threads = 1; }},
        {"compiler 'g++' against 'x'", [](MachineBlock& m) { m.compiler = "x"; }},
        {"flags '-O3' against '-O2'", [](MachineBlock& m) { m.flags = "-O2"; }},
        {"Embree '3.13.5' against '4.3'", [](MachineBlock& m) { m.embree = "4.3"; }},
        {"instruction set of Embree 'avx2' against 'avx512'", [](MachineBlock& m) { m.embree_isa = "avx512"; }},
        {"assertions in Embree on against off", [](MachineBlock& m) { m.embree_asserts = false; }},
        {"TBB '2021.8' against '2022'", [](MachineBlock& m) { m.tbb = "2022"; }},
        {"the second: load 2.60 is above 2.5", [](MachineBlock& m) { m.load = 2.6; }},
        {"the second: load n/a is above 2.5", [](MachineBlock& m) { m.load = NAN; }},
        {"the second: load not told", [](MachineBlock& m) { m.load.reset(); }},
        {"CPU not told by the second", [](MachineBlock& m) { m.cpu.clear(); }},
        {"threads not told by the second", [](MachineBlock& m) { m.threads.reset(); }},
    };
    for (const Change& change : changes) {
        MachineBlock other = machine();
        change.make(other);
        EXPECT_EQ(not_comparable(machine(), other), std::vector<std::string>{change.reason});
    }
}

TEST(Comparable, WhatNobodyTellsIsAReasonToo)
{
    MachineBlock a = machine();
    a.flags.clear();
    EXPECT_EQ(not_comparable(a, a), std::vector<std::string>{"flags not told by either"});
    EXPECT_EQ(not_comparable({}, {}).size(), 11u);
}

TEST(Comparable, FindingsHaveEachReasonOnce)
{
    Findings findings;
    EXPECT_TRUE(findings.lines().empty());
    findings.add("a", {"x", "y"});
    findings.add("b", {"y", "z"});
    findings.add("c", {});
    EXPECT_EQ(findings.lines(), (std::vector<std::string>{"a: x", "a, b: y", "b: z"}));
}

TEST(Comparable, RatiosAreAsWideAsTheirRanges)
{
    const Ratio r = ratio({12, 10, 15}, {4, 3, 5});
    EXPECT_DOUBLE_EQ(r.value, 3);
    EXPECT_DOUBLE_EQ(r.low, 2);
    EXPECT_DOUBLE_EQ(r.high, 5);
}

TEST(Comparable, RepeatsWithinFivePerCentOrWhereRangesOverlap)
{
    EXPECT_TRUE(repeats({1.00, 1.00, 1.00}, {1.05, 1.05, 1.05}));
    EXPECT_TRUE(repeats({1.05, 1.05, 1.05}, {1.00, 1.00, 1.00}));
    EXPECT_FALSE(repeats({1.00, 0.99, 1.01}, {1.06, 1.05, 1.07}));
    EXPECT_TRUE(repeats({1.00, 0.90, 1.05}, {1.20, 1.04, 1.30}));
    EXPECT_TRUE(repeats({1.20, 1.04, 1.30}, {1.00, 0.90, 1.05}));
    EXPECT_FALSE(repeats({NAN, NAN, NAN}, {1, 1, 1}));
    EXPECT_FALSE(repeats({1, 1, 1}, {NAN, NAN, NAN}));
}

}  // namespace
}  // namespace lancer
