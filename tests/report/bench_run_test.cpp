// lancer bench: intervals against closed forms, figures of rounds, files and back, and one run against another.
#include "report/bench/run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "report/bench/against.h"
#include "report/bench/bench_page.h"
#include "report/bench/interval.h"
#include "report/bench/tables.h"
#include "report/metrics/statistics.h"
#include "report/page/html.h"
#include "report/page/text_table.h"
#include "support/random.h"
#include "support/xml_check.h"

namespace lancer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

TEST(BenchIntervals, SpeedRatiosAreTakenRoundByRound)
{
    EXPECT_THAT(speed_ratios({2, 6, 1}, {1, 2, 4}), ElementsAre(2, 3, 0.25));
}

TEST(BenchIntervals, BlocksAreNeighboursOfEqualNumber)
{
    std::vector<double> ascending(30);
    for (size_t i = 0; i < ascending.size(); ++i) ascending[i] = double(i);
    const std::vector<double> medians = block_medians(ascending);
    ASSERT_THAT(medians, SizeIs(most_blocks));
    for (size_t b = 0; b < medians.size(); ++b) EXPECT_EQ(medians[b], 2 * double(b) + 0.5);
    EXPECT_THAT(block_medians(std::vector<double>{3, 1, 2}), ElementsAre(3, 1, 2));
}

TEST(BenchIntervals, EqualValuesHaveAPointAndFewValuesHaveNoInterval)
{
    const Ranged same = estimate(std::vector<double>(40, 2.5));
    EXPECT_EQ(same.value, 2.5);
    EXPECT_EQ(same.low, 2.5);
    EXPECT_EQ(same.high, 2.5);
    const Ranged few = estimate(std::vector<double>{1, 2, 3, 4, 5});
    EXPECT_EQ(few.value, 3);
    EXPECT_TRUE(std::isnan(few.low) && std::isnan(few.high));
    EXPECT_FALSE(std::isnan(estimate(std::vector<double>{1, 2, 3, 4, 5, 6}).low));
}

TEST(BenchIntervals, ScaleWithTheValuesAndIgnoreADisturbance)
{
    Random random(3);
    std::vector<double> values, scaled;
    for (int i = 0; i < 150; ++i) values.push_back(random.uniform(1, 2));
    for (const double v : values) scaled.push_back(4 * v);
    const Ranged a = estimate(values), b = estimate(scaled);
    EXPECT_EQ(b.value, 4 * a.value);
    EXPECT_EQ(b.low, 4 * a.low);
    EXPECT_EQ(b.high, 4 * a.high);
    // A tenth of the time the machine was twenty times as slow: the next larger block median takes its place at most.
    std::vector<double> medians = block_medians(values);
    std::sort(medians.begin(), medians.end());
    for (size_t i = 70; i < 85; ++i) values[i] *= 20;
    EXPECT_LE(estimate(values).value, medians[9]);
}

// What disturbs lasts: values that hang together. Of 200 such series the interval holds the truth in about 93 %; six
// standard deviations are 0.1. Resampling single values would hold it in half of them.
TEST(BenchIntervals, HoldTheTruthWhereNeighboursAreAlike)
{
    Random random(5);
    int blocks = 0, singly = 0;
    for (int k = 0; k < 200; ++k) {
        std::vector<double> values;
        double disturbance = 0;
        for (int i = 0; i < 300; ++i) {
            disturbance = 0.8 * disturbance + random.uniform(-0.5, 0.5);
            values.push_back(10 + disturbance);
        }
        const Ranged r = estimate(values);
        blocks += r.low <= 10 && 10 <= r.high;
        singly += median_interval(values).contains(10);
    }
    EXPECT_GE(blocks / 200.0, 0.83);
    EXPECT_LE(singly / 200.0, 0.75);
}

// Two methods, the second twice as fast in each round, whatever the machine did meanwhile.
BenchGroup group_of_two(const std::string& family, const std::string& rays = "", const std::string& way = "")
{
    BenchGroup group{family, rays, way, 1, true, std::vector<BenchTimes>(2)};
    for (int round = 0; round < 30; ++round) {
        const double slow = 100 + 10 * (round % 5);
        group.times[0].wall_ns.push_back(2 * slow), group.times[0].cpu_ns.push_back(slow);
        group.times[1].wall_ns.push_back(9 * slow), group.times[1].cpu_ns.push_back(0.5 * slow);
    }
    return group;
}

BenchRun small_run()
{
    BenchRun run;
    run.machine.cpu = "a CPU", run.machine.compiler = "gcc", run.machine.flags = "-O3", run.machine.embree = "3.13.5";
    run.machine.embree_isa = "avx2", run.machine.tbb = "TBB", run.machine.num_cpus = 2, run.machine.threads = 2;
    run.machine.embree_asserts = false, run.machine.load = 0.5, run.machine.load_at_end = 1.5;
    run.machine.build_id = "abc", run.machine.lancer = "0.1.0";
    run.file = "meshes/ball.obj", run.mesh = "ball", run.mesh_hash = "0123", run.triangles = 760;
    run.mesh_bytes = 20000, run.baseline = "embree-robust", run.methods = {"embree-robust", "bvh8"};
    run.rays = {{"primary", "aa"}, {"ao", "bb"}};
    run.seconds = 2.5, run.picture_error = 0.02;
    for (const char* way : {"single", "batch"})
        for (const char* kind : {"primary", "ao"})
            for (BenchFigure& f : figures_of(group_of_two("rays", kind, way), run.methods, run.baseline)) {
                f.counters = {{"wrong_per_million", 0}, {"missed_per_million", f.accel == "bvh8" ? 0 : 15}};
                run.figures.push_back(std::move(f));
            }
    for (const char* family : {"build", "picture"})
        for (BenchFigure& f : figures_of(group_of_two(family), run.methods, run.baseline)) {
            f.counters = {{"bytes", 4e6}, {"total_bytes", 5e6}};
            run.figures.push_back(std::move(f));
        }
    return run;
}

TEST(BenchFigures, AreMediansAndRatiosWithinRounds)
{
    const auto figures = figures_of(group_of_two("rays", "ao", "single"), {"embree-robust", "bvh8"}, "embree-robust");
    ASSERT_THAT(figures, SizeIs(2));
    EXPECT_FALSE(figures[0].ratio);
    EXPECT_EQ(figures[0].rounds, 30u);
    EXPECT_EQ(figures[0].time_ns.value, 120);
    EXPECT_EQ(figures[0].wall_ns, 240);
    // The same in each round, though times are not.
    EXPECT_EQ(figures[1].ratio->value, 2);
    EXPECT_EQ(figures[1].ratio->low, 2);
    EXPECT_EQ(figures[1].ratio->high, 2);
    EXPECT_DOUBLE_EQ(figures[1].value().value, 1e3 / 60);  // million rays per second
    EXPECT_EQ(figures[1].name("ball"), "rays/ball/bvh8/ao/single/threads:1");
    // The slowest time is the lowest speed.
    EXPECT_LE(figures[0].value().low, figures[0].value().value);
    EXPECT_GE(figures[0].value().high, figures[0].value().value);
}

TEST(BenchFigures, OfTheClockWhereTheCpuDoesNotCount)
{
    BenchGroup group = group_of_two("build");
    group.by_cpu = false;
    const auto figures = figures_of(group, {"embree-robust", "bvh8"}, "embree-robust");
    EXPECT_DOUBLE_EQ(figures[1].ratio->value, 2.0 / 9);
    EXPECT_DOUBLE_EQ(figures[1].value().value, 1e-9 * 9 * 120);
}

TEST(BenchFigures, OfMethodsWithoutARoundAreNone)
{
    BenchGroup group = group_of_two("build");
    group.times[1] = {};
    EXPECT_THAT(figures_of(group, {"embree-robust", "bvh8"}, "embree-robust"), SizeIs(1));
}

TEST(BenchFiles, HaveTheShapeOfGoogleBenchmark)
{
    const auto json = nlohmann::json::parse(to_json(small_run()));
    EXPECT_EQ(json["context"]["num_cpus"], 2);
    EXPECT_EQ(json["context"]["load_avg"][0], 0.5);
    EXPECT_EQ(json["context"]["build_id"], "abc");
    ASSERT_THAT(json["benchmarks"], SizeIs(12));
    for (const auto& row : json["benchmarks"]) {
        EXPECT_EQ(row["run_name"], row["name"]);
        EXPECT_EQ(row["time_unit"], "ns");
        EXPECT_EQ(row["run_type"], "aggregate");
        EXPECT_EQ(row["aggregate_name"], "median");
        EXPECT_TRUE(row["real_time"].is_number() && row["cpu_time"].is_number());
    }
    EXPECT_EQ(json["benchmarks"][1]["real_time"], 9 * 120);
    EXPECT_EQ(json["benchmarks"][1]["cpu_time"], 60);
    EXPECT_EQ(json["benchmarks"][1]["ratio"], 2);
    EXPECT_EQ(json["benchmarks"][1]["ratio_to"], "embree-robust");
}

TEST(BenchFiles, GiveTheRunBack)
{
    const BenchRun run = small_run();
    const BenchRun again = read_bench_run("bench.json", to_json(run));
    EXPECT_EQ(to_json(again), to_json(run));
    EXPECT_EQ(again.rays, run.rays);
    EXPECT_EQ(again.methods, run.methods);
    EXPECT_EQ(again.machine.load_at_end, 1.5);
    ASSERT_EQ(again.figures.size(), run.figures.size());
    EXPECT_EQ(again.figures[3].counter("missed_per_million"), 0);
}

TEST(BenchFiles, RefuseWhatIsNoRun)
{
    const auto refused = [](const std::string& json, const std::string& words) {
        try {
            read_bench_run("other.json", json);
            ADD_FAILURE() << "was read";
        } catch (const Error& problem) {
            EXPECT_EQ(problem.kind(), ErrorKind::invalid_input);
            EXPECT_THAT(problem.what(), HasSubstr("other.json"));
            EXPECT_THAT(problem.what(), HasSubstr(words));
        }
    };
    refused("{", "not JSON");
    refused(R"({"context":{},"benchmarks":[{"name":"a","family":"b"}]})", "not written by lancer bench");
    refused(R"({"context":{"lancer_bench":2},"benchmarks":[{"name":"a","family":"b"}]})", "another version");
    refused(R"({"context":{"lancer_bench":1,"ray_kinds":"ao"},"benchmarks":[{"name":"a","family":"b"}]})",
            "ray_hashes");
}

TEST(BenchFiles, CsvHasTheSameColumnsForEachFigure)
{
    const std::string csv = to_csv(small_run());
    EXPECT_THAT(csv, testing::StartsWith("name,family,mesh,accel,rays,way,clock,ratio_to,threads,repetitions,real_time,"
                                         "cpu_time,time,time_low,time_high,items_per_second,ratio,ratio_low,ratio_high,"
                                         "wrong_per_million,missed_per_million,ray_count,bytes,total_bytes,spp,"
                                         "differing_pixels,against,against_low,against_high,against_differs\n"));
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 13);
    EXPECT_THAT(csv, HasSubstr("rays/ball/bvh8/primary/single/threads:1,rays,ball,bvh8,primary,single,cpu,"
                               "embree-robust,1,30,1080,60,60,"));
}

TEST(BenchAgainst, ItselfHasNothingThatDiffers)
{
    const BenchRun run = small_run();
    const BenchAgainst against = compare(run, run, "itself");
    EXPECT_THAT(against.cells, SizeIs(6));
    EXPECT_EQ(against.differing(), 0u);
    EXPECT_EQ(against.close(), 6u);
    EXPECT_THAT(against.remarks, SizeIs(0));
    for (const AgainstCell& cell : against.cells) {
        EXPECT_EQ(cell.quotient.value, 1);
        EXPECT_EQ(cell.absolute, 1);
    }
}

TEST(BenchAgainst, TellsWhatDiffersBeyondBothIntervals)
{
    BenchRun now = small_run();
    const BenchRun before = small_run();
    now.figures[1].ratio = {3, 2.5, 3.5};    // 2 before
    now.figures[3].ratio = {2.2, 1.9, 2.4};  // may still be 2
    now.figures[5].ratio = Ranged{4};        // without an interval nothing can be told
    now.figures[0].counters[0].second = 7;
    BenchAgainst against = compare(now, before, "earlier");
    EXPECT_EQ(against.differing(), 1u);
    EXPECT_EQ(against.close(), 3u);
    EXPECT_TRUE(against.cells[0].differs);
    EXPECT_DOUBLE_EQ(against.cells[0].quotient.low, 1.25);
    EXPECT_DOUBLE_EQ(against.cells[0].quotient.high, 1.75);
    EXPECT_TRUE(against.cells[1].judged);
    EXPECT_FALSE(against.cells[2].judged);
    ASSERT_THAT(against.remarks, SizeIs(1));
    EXPECT_THAT(against.remarks[0], HasSubstr("wrong_per_million 7"));
    EXPECT_THAT(to_text(against_table(against, false)), HasSubstr("differs"));
    EXPECT_EQ(verdict_of(against), "against earlier: of 6 ratios 3 agree within 5 %; 1 differ beyond both intervals");
    annotate(now, against);
    EXPECT_EQ(now.figures[1].counter("against_differs"), 1);
    EXPECT_EQ(now.figures[3].counter("against_differs"), 0);
    EXPECT_FALSE(now.figures[5].counter("against_differs"));
}

TEST(BenchAgainst, RefusesAnotherMeshAndOtherRays)
{
    const BenchRun now = small_run();
    const auto refused = [&](const BenchRun& before, const std::string& words) {
        try {
            compare(now, before, "earlier");
            ADD_FAILURE() << "was compared";
        } catch (const Error& problem) {
            EXPECT_THAT(problem.what(), HasSubstr("earlier"));
            EXPECT_THAT(problem.what(), HasSubstr(words));
        }
    };
    BenchRun other = small_run();
    other.mesh_hash = "4567", other.mesh = "cube", other.triangles = 12;
    refused(other, "is of another mesh: 'cube' with 12 triangles, not 'ball' with 760");
    other = small_run();
    other.rays.pop_back();
    refused(other, "is of other kinds of rays: primary; these are primary, ao");
    // The same kinds from another view can be compared, with a remark.
    other = small_run();
    other.rays[0].second = "cc";
    EXPECT_THAT(compare(now, other, "earlier").remarks[0], HasSubstr("the rays are not the same"));
}

TEST(BenchPage, IsWellFormedAndHasOneTableOfFiguresAndBars)
{
    const BenchRun run = small_run();
    const BenchAgainst against = compare(run, run, "earlier");
    const std::string page = to_html(make_page(run, &against));
    const XmlReader xml(page);
    size_t plots = 0, bars = 0, bad = 0;
    for (const XmlElement& e : xml.elements) {
        plots += e.has_class("plot"), bars += e.has_class("bar"), bad += e.has_class("bad");
        EXPECT_FALSE(e.attributes.contains("src")) << "the page loads something";
    }
    EXPECT_EQ(plots, 4u);  // singly, in batches, building, pictures
    EXPECT_EQ(bars, 12u);
    EXPECT_EQ(bad, 2u);  // missed hits of one method, for both kinds
    EXPECT_THAT(page, HasSubstr("of 6 ratios 6 agree within 5 %"));
    EXPECT_EQ(page.find("<script>"), std::string::npos);
}

TEST(BenchTable, HasAColumnForEachMethod)
{
    const std::string text = to_text(figures_table(small_run(), false));
    EXPECT_THAT(text, testing::StartsWith("what"));
    EXPECT_THAT(text, HasSubstr("bvh8"));
    EXPECT_THAT(text, HasSubstr("16.7 ×2.00"));
    EXPECT_THAT(text, HasSubstr("tree and mesh, MB"));
}

}  // namespace
}  // namespace lancer
