// The time of lancer bench, by a clock that the test moves: no test waits for a measurement.
#include "app/bench/schedule.h"

#include <gtest/gtest.h>

#include "app/bench/rounds.h"
#include "core/parallel.h"
#include "io/temp_folder.h"

namespace lancer {
namespace {

struct Clock {
    double now = 100;

    BenchPart part(double weight, double seconds, double expected = 0)
    {
        return {"part", weight, [this, seconds] { now += seconds; }, expected};
    }
    void run(std::vector<BenchPart>& parts, double end)
    {
        run_parts(
            parts, end, [this] { return now; }, [] { return false; });
    }
};

TEST(BenchSchedule, KeepsTheTimeAndDividesItByWeight)
{
    Clock clock;
    std::vector<BenchPart> parts{clock.part(3, 0.1), clock.part(1, 0.3)};
    clock.run(parts, 220);
    EXPECT_LE(clock.now, 220);
    EXPECT_GE(clock.now, 220 - 0.3);
    // Three quarters of 120 s in steps of 0.1 s, a quarter in steps of 0.3 s.
    EXPECT_NEAR(double(parts[0].steps), 900, 5);
    EXPECT_NEAR(double(parts[1].steps), 100, 2);
}

TEST(BenchSchedule, EachPartHasAStepBeforeAnyHasTwo)
{
    Clock clock;
    std::vector<size_t> order;
    std::vector<BenchPart> parts;
    for (size_t i = 0; i < 3; ++i)
        parts.push_back({"part", i == 2 ? 0.01 : 1, [&, i] { order.push_back(i), clock.now += 1; }});
    clock.run(parts, 105);
    ASSERT_GE(order.size(), 3u);
    EXPECT_EQ(order[0], 0u);
    EXPECT_EQ(order[1], 1u);
    EXPECT_EQ(order[2], 2u);
}

TEST(BenchSchedule, WhatWouldEndTooLateIsNotBegun)
{
    Clock clock;
    std::vector<BenchPart> parts{clock.part(1, 1), clock.part(1, 30, 30)};
    clock.run(parts, 110);
    EXPECT_EQ(parts[0].steps, 10u);
    EXPECT_EQ(parts[1].steps, 0u);
    EXPECT_EQ(clock.now, 110);
    // After its time nothing is, not even once.
    std::vector<BenchPart> late{clock.part(1, 1)};
    clock.run(late, 110);
    EXPECT_EQ(late[0].steps, 0u);
}

TEST(BenchSchedule, StopsWhereItIsAskedTo)
{
    Clock clock;
    std::vector<BenchPart> parts{clock.part(1, 1)};
    run_parts(
        parts, 1e9, [&] { return clock.now; }, [&] { return parts[0].steps == 3; });
    EXPECT_EQ(parts[0].steps, 3u);
}

TEST(BenchRounds, BeginWithEachMethodInTurn)
{
    std::vector<size_t> first;
    for (size_t round = 0; round < 6; ++round) {
        std::vector<size_t> order;
        in_turns(3, round, [&](size_t i) { order.push_back(i); });
        ASSERT_EQ(order.size(), 3u);
        EXPECT_EQ(order[0] + order[1] + order[2], 3u);
        first.push_back(order[0]);
    }
    EXPECT_EQ(first, (std::vector<size_t>{0, 1, 2, 0, 1, 2}));
}

TEST(BenchRounds, EveryPieceOfWorkIsDoneOnce)
{
    for (const unsigned threads : {1u, 3u}) {
        std::vector<int> done(100);
        const Taken taken = time_pieces(done.size(), threads, [&](size_t i) { ++done[i]; });
        EXPECT_EQ(done, std::vector<int>(100, 1));
        EXPECT_GE(taken.wall, 0);
        EXPECT_GE(taken.cpu, 0);
    }
}

TEST(BenchRays, AreDealtSoThatNeighboursAreFarFromEachOther)
{
    RaySet set{"primary", false, Coherence::coherent, {}};
    for (size_t i = 0; i < 8 * 256 + 10; ++i) set.rays.emplace_back().org.x = static_cast<float>(i);
    const uint64_t before = hash_of(set);
    std::vector<Ray> sorted = set.rays;
    deal(set);
    EXPECT_NE(hash_of(set), before);
    ASSERT_EQ(set.rays.size(), sorted.size());
    // Of any two whole batches that follow each other one is of the first half and one of the second, or nearly.
    for (size_t b = 0; b + 2 <= 8; ++b)
        EXPECT_GT(std::abs(set.rays[b * 256].org.x - set.rays[b * 256 + 256].org.x), 256.0f) << b;
    std::sort(set.rays.begin(), set.rays.end(), [](const Ray& a, const Ray& b) { return a.org.x < b.org.x; });
    for (size_t i = 0; i < sorted.size(); ++i) ASSERT_EQ(set.rays[i].org.x, sorted[i].org.x);
}

// Of one tile all might meet the same thing.
TEST(BenchRays, OfFewAreFromAllOverThePicture)
{
    const TempFolder folder;
    std::string obj;
    for (const char* line : {"v 0 0 0", "v 1 0 0", "v 0 1 0", "v 0 0 1", "f 1 3 2", "f 1 2 4", "f 1 4 3", "f 2 3 4"})
        obj += std::string(line) + "\n";
    write_bytes(folder.file("corner.obj"), obj);
    PictureOptions options;
    options.scene.file = folder.file("corner.obj");
    options.scene.ground = false;
    with_threads(2, [&] {
        const BenchScene scene(options);
        const std::array<std::string_view, 1> kinds{"primary"};
        const std::vector<RaySet> sets = scene.rays(4096, kinds);
        ASSERT_EQ(sets.size(), 1u);
        ASSERT_EQ(sets[0].rays.size(), 4096u);
        // A tile is 16 of 1280 pixels wide.
        float farthest = 0;
        for (const Ray& ray : sets[0].rays) farthest = std::max(farthest, length(ray.dir - sets[0].rays[0].dir));
        EXPECT_GT(farthest, 0.1f);
    });
}

TEST(BenchRays, HashTellsRaysApartAndLeavesHintsOut)
{
    RaySet set{"primary", false, Coherence::coherent, std::vector<Ray>(3)};
    const uint64_t hash = hash_of(set);
    set.rays[1].leaf_hint = 7;
    EXPECT_EQ(hash_of(set), hash);
    set.rays[1].t_max = 7;
    EXPECT_NE(hash_of(set), hash);
}

}  // namespace
}  // namespace lancer
