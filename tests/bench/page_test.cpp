#include "bench/report/page.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bench/report/markdown.h"
#include "bench/report/repeat.h"
#include "bench/report/scaling.h"
#include "bench/report/speed.h"
#include "core/error.h"
#include "report/page/html.h"
#include "support/xml_check.h"

namespace lancer {
namespace {

using Json = nlohmann::ordered_json;

Json context()
{
    return {{"date", "2030-01-01T00:00:00Z"},
            {"cpu", "a cpu"},
            {"num_cpus", 2},
            {"threads", 1},
            {"load_avg", {0.5, 1, 2}},
            {"compiler", "gcc 12"},
            {"flags", "-O3"},
            {"embree", "3.13.5"},
            {"embree_isa", "avx2"},
            {"embree_asserts", true},
            {"tbb", "2021.8"},
            {"executable", "build/bench_accel"},
            {"lancer", "0.1.0"}};
}

// A row of a million items per second and `mega` times that.
Json timed(const std::string& family, const std::string& name, double mega, double ratio)
{
    return {{"name", family + "/" + name},
            {"run_name", family + "/" + name},
            {"family", family},
            {"min", 900 / mega},
            {"max", 1250 / mega},
            {"items_per_second", 1e6 * mega},
            {"ratio", ratio},
            {"ratio_min", 0.9 * ratio},
            {"ratio_max", 1.1 * ratio},
            {"ratio_to", "embree-robust-high-avx2/single"}};
}
Json speed(const std::string& accel, const std::string& rays, const std::string& way, double mega, double ratio)
{
    Json row = timed("accel", "bunny/" + accel + "/" + rays + "/" + way, mega, ratio);
    row["mesh"] = "bunny", row["accel"] = accel, row["rays"] = rays, row["way"] = way;
    row["disagreements"] = accel == "bvh8" ? 0 : 3;
    return row;
}

Json rows()
{
    Json all = Json::array();
    for (const char* rays : {"primary", "shadow"}) {
        all.push_back(speed("embree-robust-high-avx2", rays, "single", 10, 1));
        all.push_back(speed("embree-fast-high-avx2", rays, "single", 12.5, 1.25));
        for (const char* way : {"single", "batch"}) {
            all.push_back(speed("embree", rays, way, 10, 1));
            all.push_back(speed("bvh8", rays, way, 15, 1.5));
        }
    }
    all.push_back({{"name", "watertight/sphere/bvh8"},
                   {"family", "watertight"},
                   {"mesh", "sphere"},
                   {"accel", "bvh8"},
                   {"misses_random", 0},
                   {"misses_edge", 0},
                   {"misses_vertex", 17}});
    all.push_back({{"name", "watertight/sphere/embree"},
                   {"family", "watertight"},
                   {"mesh", "sphere"},
                   {"accel", "embree"},
                   {"misses_random", 0},
                   {"misses_edge", 1.5},
                   {"misses_vertex", 26471}});
    for (const int threads : {1, 2}) {
        Json build = timed("build", "bunny/bvh8/threads" + std::to_string(threads), 1e-5, 0.5);
        build["mesh"] = "bunny", build["accel"] = "bvh8", build["threads"] = threads, build["triangles"] = 69451;
        build["build_seconds"] = 0.1 / threads, build["triangles_per_second"] = 694510 * threads;
        build["bytes_per_triangle"] = 80.5, build["sah_cost"] = 42.25;
        all.push_back(build);
    }
    for (const int triangles : {1000, 100000, 10000000}) {
        Json point = timed("scaling", "sphere/bvh8/primary/" + std::to_string(triangles), 20.0 / triangles, 1);
        point["mesh"] = "sphere", point["accel"] = "bvh8", point["what"] = point["rays"] = "primary";
        point["size"] = triangles;
        all.push_back(point);
        all.push_back({{"name", "scaling/sphere/bvh8/build/" + std::to_string(triangles)},
                       {"family", "scaling"},
                       {"mesh", "sphere"},
                       {"accel", "bvh8"},
                       {"what", "build"},
                       {"size", triangles},
                       {"build_seconds", 1e-6 * triangles},
                       {"bytes", 80 * triangles}});
    }
    all.push_back({{"name", "scaling/sphere/bvh8/primary/exponent"},
                   {"family", "scaling"},
                   {"mesh", "sphere"},
                   {"accel", "bvh8"},
                   {"what", "primary"},
                   {"exponent", -0.15},
                   {"exponent_low", -0.18},
                   {"exponent_high", -0.12}});
    all.push_back({{"name", "limit/cornell"}, {"family", "limit"}, {"share", 0.7}});
    all.push_back({{"name", "render/cornell/bvh8"}, {"family", "render"}, {"seconds", 1.5}, {"same_bits", true}});
    all.push_back({{"name", "unheard/of"}, {"family", "unheard"}, {"a_figure", 77.5}, {"of", "<what>"}});
    return all;
}

BenchFile file_of(const Json& all, const std::string& name = "accel.json") { return read_bench(name, all.dump()); }
BenchFile whole_file() { return file_of({{"context", context()}, {"benchmarks", rows()}}); }

std::string refusal(const std::string& json)
{
    try {
        read_bench("x.json", json);
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::invalid_input);
        return e.what();
    }
    return "";
}

// Text of the first cell in the row that begins with these cells, in the column of this head.
std::string cell(const std::vector<Section>& sections, const std::vector<std::string>& begin, const std::string& head)
{
    for (const Section& section : sections) {
        for (const Block& block : section.blocks) {
            const auto* table = std::get_if<Table>(&block);
            if (!table) continue;
            const auto column = std::find(table->head.begin(), table->head.end(), head) - table->head.begin();
            for (const auto& row : table->rows) {
                bool fits = row.size() > static_cast<size_t>(column) && row.size() >= begin.size();
                for (size_t i = 0; fits && i < begin.size(); ++i) fits = row[i].text == begin[i];
                if (fits) return row[static_cast<size_t>(column)].text;
            }
        }
    }
    return "no such cell";
}

TEST(BenchResults, ReadsRowsAndMachine)
{
    const BenchFile file = whole_file();
    EXPECT_EQ(file.rows.size(), rows().size());
    EXPECT_EQ(file.machine.cpu, "a cpu");
    EXPECT_EQ(file.machine.threads, 1);
    EXPECT_EQ(file.machine.load, 0.5);
    EXPECT_EQ(file.machine.embree_asserts, true);
    const BenchRow& row = file.rows[0];
    EXPECT_EQ(row.name, "accel/bunny/embree-robust-high-avx2/primary/single");
    EXPECT_EQ(row.rays, "primary");
    EXPECT_DOUBLE_EQ(row.mega_per_second().value, 10);
    EXPECT_DOUBLE_EQ(row.mega_per_second().low, 8);
    EXPECT_DOUBLE_EQ(row.mega_per_second().high, 10 / 0.9);
    EXPECT_DOUBLE_EQ(row.speed_ratio()->low, 0.9);
    EXPECT_FALSE(row.number("nothing"));
}

TEST(BenchResults, RefusesWhatIsNoRun)
{
    EXPECT_EQ(refusal("{"), "x.json: error: not JSON");
    EXPECT_EQ(refusal("[]"), "x.json: error: no \"context\" or no \"benchmarks\": not a file of a bench program");
    EXPECT_EQ(refusal(R"({"context": {}, "benchmarks": []})"), "x.json: error: no row");
    EXPECT_EQ(refusal(R"({"context": {}, "benchmarks": [1]})"),
              "x.json: error: a row of \"benchmarks\" that is not an object");
    EXPECT_EQ(refusal(R"({"context": {}, "benchmarks": [{"name": "a"}]})"),
              "x.json: error: a row without \"name\" or \"family\"");
    // A context that tells nothing is read, and says so in the verdicts.
    const BenchFile bare = read_bench("x.json", R"({"context": {}, "benchmarks": [{"name": "a", "family": "f"}]})");
    EXPECT_FALSE(verdicts({bare}).empty());
}

TEST(BenchResults, WhatTheMachineCannotBeIsNotKnown)
{
    const MachineBlock machine =
        read_bench("x.json", R"({"context": {"num_cpus": 1e300, "threads": -1, "embree_asserts": 1},
                                 "benchmarks": [{"name": "a", "family": "f"}]})")
            .machine;
    EXPECT_FALSE(machine.num_cpus || machine.threads || machine.embree_asserts);
}

TEST(BenchSpeed, ComparesWithBothModesOfEmbree)
{
    const auto sections = speed_sections({whole_file()});
    ASSERT_EQ(sections.size(), 2u);  // at a glance, and one mesh
    EXPECT_EQ(cell(sections, {"bunny", "bvh8"}, "primary"), "×1.50 [1.35 .. 1.65]");
    EXPECT_EQ(cell(sections, {"bunny", "bvh8"}, "geometric mean"), "1.50");
    EXPECT_EQ(cell({{"fast", {sections[0].blocks.back()}}}, {"bunny", "bvh8"}, "shadow"), "×1.20 [0.982 .. 1.47]");
    EXPECT_EQ(cell(sections, {"bvh8", "batch"}, "primary"), "15.0 [12.0 .. 16.7]\n×1.50 [1.35 .. 1.65]\nwrong: 0");
    EXPECT_EQ(cell(sections, {"bvh8", "single"}, "misses random / edge / vertex"), "0 / 0 / 17");
    const std::string of_embree = "0 / 1.50 / 26471";
    EXPECT_EQ(cell(sections, {"embree", "batch"}, "misses random / edge / vertex"), of_embree);
    EXPECT_EQ(cell(sections, {"embree-robust-high-avx2", "single"}, "misses random / edge / vertex"), of_embree);
    EXPECT_EQ(cell(sections, {"embree-fast-high-avx2", "single"}, "misses random / edge / vertex"), "");
}

TEST(BenchSpeed, TellsWhatBuildingCosts)
{
    const auto sections = build_sections({whole_file()});
    EXPECT_EQ(cell(sections, {"bvh8", "1"}, "bytes per triangle"), "80.5");
    EXPECT_EQ(cell(sections, {"bvh8", "1"}, "SAH cost"), "42.2");
    EXPECT_EQ(cell(sections, {"bvh8", "2"}, "Mtriangles/s"), "1.39");
    EXPECT_EQ(cell(sections, {"bvh8", "2"}, "seconds"), "0.0500 [0.0900 .. 0.125]");
}

TEST(BenchScaling, HasExponentsAndCurves)
{
    const auto sections = scaling_sections({whole_file()});
    ASSERT_EQ(sections.size(), 2u);  // and every size
    EXPECT_EQ(cell(sections, {"sphere", "bvh8", "primary"}, "exponent"), "-0.150 [-0.180 .. -0.120]");
    size_t plots = 0;
    for (const Block& block : sections[0].blocks) plots += std::holds_alternative<Plot>(block);
    EXPECT_EQ(plots, 3u);  // speed, build time, memory
}

TEST(BenchPage, ShowsEveryFamilyAndKeepsTheData)
{
    const BenchFile file = whole_file();
    const std::string page = to_html(make_bench_page({file}, {}));
    std::vector<std::string> headings;
    size_t data = 0;
    for (const XmlElement& e : read_xml(page)) {
        if (e.name == "h2") headings.push_back(e.text);
        if (e.name != "script") continue;
        ++data;
        EXPECT_EQ(Json::parse(e.text), Json::parse(file.json));
    }
    EXPECT_EQ(data, 1u);
    EXPECT_EQ(headings,
              (std::vector<std::string>{"Speed at a glance", "Speed: bunny", "Building", "Growth", "Growth: every size",
                                        "The limit of a render", "Whole pictures", "Watertightness",
                                        "Watertightness: every mesh", "unheard", "Raw data"}));
    const auto sections = make_bench_page({file}, {}).sections;
    EXPECT_EQ(cell(sections, {"of"}, "a figure"), "77.5");
    EXPECT_EQ(cell(sections, {"of"}, "of"), "<what>");
    EXPECT_EQ(cell(sections, {"cornell/bvh8"}, "same bits"), "yes");
    EXPECT_NE(to_markdown(make_bench_page({file}, {}), 3).find("| bunny | bvh8 | ×1.50"), std::string::npos);
}

// The documentation has the sums over meshes and kinds of rays, the page every row.
TEST(BenchPage, SumsUpWhatHasARowForEachMesh)
{
    Json all = Json::array();
    for (const char* mesh : {"bunny", "sponza"})
        for (const char* accel : {"embree", "bvh8"})
            all.push_back({{"name", std::string("agreement/") + mesh + "/" + accel},
                           {"family", "agreement"},
                           {"mesh", mesh},
                           {"accel", accel},
                           {"rays_traced", 20000},
                           {"ties", accel[0] == 'e' ? 100 + mesh[0] : 0},
                           {"wrong", 0}});
    const BenchFile file = read_bench("run.json", Json{{"context", context()}, {"benchmarks", all}}.dump());
    const Document page = make_bench_page({file}, {});
    const std::string text = to_markdown(page, 3);
    EXPECT_NE(text.find("| embree | 40000 | 0 | 413 | 0 | 0 | 0 |"), std::string::npos) << text;
    EXPECT_NE(text.find("| bvh8 | 40000 | 0 | 0 | 0 | 0 | 0 |"), std::string::npos);
    EXPECT_EQ(text.find("sponza"), std::string::npos);
    EXPECT_NE(to_html(page).find("sponza"), std::string::npos);
}

TEST(BenchPage, SaysWhatIsNotComparable)
{
    EXPECT_TRUE(verdicts({whole_file()}).empty());
    Json busy{{"context", context()}, {"benchmarks", rows()}}, other = busy;
    busy["context"]["load_avg"] = {3.5, 0, 0};
    other["context"]["flags"] = "-O2";
    other["context"]["threads"] = 2;  // what the program was asked for
    EXPECT_EQ(verdicts({whole_file(), file_of(busy, "folder/busy.json"), file_of(other, "other.json")}),
              (std::vector<std::string>{"busy.json: load 3.50 is above 2.5", "other.json: flags '-O3' against '-O2'"}));
    const std::string page = to_html(make_bench_page({file_of(busy)}, {}));
    EXPECT_NE(page.find("<p class=\"bad\">Not comparable: accel.json: load 3.50 is above 2.5.</p>"), std::string::npos);
}

TEST(BenchRepeat, ConfirmsARunByItself)
{
    const std::vector<BenchFile> run{whole_file()};
    EXPECT_TRUE(comparison_reasons(run, run).empty());
    const auto repeated = repeated_rows(run, run);
    EXPECT_FALSE(repeated.empty());
    for (const RepeatedRow& row : repeated) EXPECT_TRUE(row.agrees()) << row.name;
}

TEST(BenchRepeat, FindsTheRowThatDiffers)
{
    Json second{{"context", context()}, {"benchmarks", rows()}};
    second["context"]["executable"] = "elsewhere/bench_accel";
    second["context"]["tbb"] = "2022";
    for (Json& row : second["benchmarks"]) {
        if (row["name"] != "accel/bunny/bvh8/shadow/single") continue;
        row["ratio"] = 1.9, row["ratio_min"] = 1.8, row["ratio_max"] = 2.0;
    }
    const std::vector<BenchFile> a{whole_file()}, b{file_of(second)};
    std::vector<std::string> differing;
    for (const RepeatedRow& row : repeated_rows(a, b))
        if (!row.agrees()) differing.push_back(row.name);
    EXPECT_EQ(differing, std::vector<std::string>{"accel/bunny/bvh8/shadow/single"});
    EXPECT_EQ(comparison_reasons(a, b), std::vector<std::string>{"bench_accel: TBB '2021.8' against '2022'"});
    const Section section = repeat_section(a, b);
    EXPECT_EQ(cell({section}, {"accel"}, "not confirmed"), "1");
    EXPECT_EQ(cell({section}, {"accel"}, "farthest from 1"), "1.27");
    EXPECT_EQ(cell({section}, {"accel/bunny/bvh8/shadow/single"}, "second / first"), "1.27");
}

}  // namespace
}  // namespace lancer
