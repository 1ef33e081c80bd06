// lancer bench as one calls it, with so little time that figures say nothing: what it writes, and what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/run_program.h"
#include "report/bench/run.h"
#include "support/scenes/scenes.h"
#include "support/xml_check.h"

namespace lancer {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

class BenchCommand : public AppTest {
protected:
    BenchCommand()
    {
        write("ball.obj", obj_of(*make_uv_sphere(12, 24)));
        write("cube.obj", obj_of(*make_cube()));
    }
    static std::string obj_of(const MeshData& mesh)
    {
        std::string text;
        for (const Vec3d& p : mesh.positions)
            text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
        for (const auto& t : mesh.triangles) {
            text += "f";
            for (const uint32_t i : t) text += " " + std::to_string(i + 1);
            text += "\n";
        }
        return text;
    }
    static constexpr const char* little = "0.3s";
    // Little of everything.
    Said bench(const std::string& scene, const Arguments& more) const
    {
        return run(Arguments{"bench", scene, "--time", little, "--rays", "primary,ao", "--accel", "bvh8"} + more);
    }
    BenchRun result(const std::string& name) const { return read_bench_run(name, read_bytes(file(name))); }
    // The same into a folder, with more time until nothing is left out, however busy the machine is.
    Said whole_bench(const std::string& scene, const std::string& folder, const Arguments& more = {}) const
    {
        Said said;
        for (const char* time : {"1s", "5s", "25s", "125s", "600s"}) {
            said = bench(scene, Arguments{"-o", folder} + more + Arguments{"--time", time});
            if (said.code != 0) continue;
            const BenchRun r = result(folder + "/bench.json");
            const size_t threads = r.machine.threads == 1 ? 1 : 2;
            if (r.figures.size() == r.methods.size() * threads * (2 * r.rays.size() + 2)) break;
        }
        return said;
    }
};

TEST_F(BenchCommand, WritesFiguresOfEveryMethodAndRay)
{
    const Said said = whole_bench("ball.obj", "out");
    ASSERT_EQ(said.code, 0) << said.err;
    expect_words(said.out, "ball.obj: ");
    expect_words(said.out, "primary batch, M/s");
    const BenchRun r = result("out/bench.json");
    EXPECT_EQ(r.methods, (std::vector<std::string>{"embree-robust", "bvh8"}));
    EXPECT_FALSE(r.interrupted);
    EXPECT_NE(r.machine.build_id, "");
    for (const unsigned threads : {1u, static_cast<unsigned>(r.machine.threads.value())})
        for (const char* method : {"embree-robust", "bvh8"})
            for (const char* kind : {"primary", "ao"})
                for (const char* way : {"single", "batch"}) {
                    const BenchFigure* f =
                        r.find({.family = "rays", .accel = {}, .rays = kind, .way = way, .threads = threads}, method);
                    ASSERT_TRUE(f) << method << " " << kind << " " << way << " " << threads;
                    EXPECT_GT(f->value().value, 0);
                    EXPECT_EQ(f->ratio.has_value(), std::string(method) == "bvh8");
                    // No ray is lost, and none meets another triangle than the list says.
                    EXPECT_EQ(f->counter("wrong_per_million"), 0);
                    EXPECT_EQ(f->counter("missed_per_million"), 0);
                }
    for (const char* family : {"build", "picture"})
        EXPECT_TRUE(r.find({.family = family, .accel = {}, .rays = {}, .way = {}, .threads = 1}, "bvh8")) << family;
    EXPECT_NO_THROW(XmlReader(read_bytes(file("out/bench.html"))));
    EXPECT_THAT(read_bytes(file("out/bench.csv")), HasSubstr("rays/ball/bvh8/ao/batch/threads:1,"));
}

TEST_F(BenchCommand, JsonIsWhatItsSchemaSays)
{
    const auto schema = nlohmann::json::parse(read_bytes(LANCER_SOURCE_DIR "/docs/json/bench.schema.json"));
    ASSERT_EQ(bench("ball.obj", {"-o", "first"}).code, 0);
    const Said said = bench("ball.obj", {"--json", "-q", "--against", "first"});
    ASSERT_EQ(said.code, 0) << said.err;
    const auto json = nlohmann::json::parse(said.out);
    const auto check = [](const nlohmann::json& object, const nlohmann::json& rule) {
        for (const auto& [key, value] : object.items())
            EXPECT_TRUE(rule["properties"].contains(key)) << key << " is not in the schema";
        for (const auto& key : rule["required"]) EXPECT_TRUE(object.contains(key)) << key << " is required";
    };
    check(json["context"], schema["properties"]["context"]);
    ASSERT_FALSE(json["benchmarks"].empty());
    for (const auto& row : json["benchmarks"]) check(row, schema["properties"]["benchmarks"]["items"]);
}

TEST_F(BenchCommand, PrintsJsonAloneAndRaysDoNotDependOnTheMethods)
{
    const Said one = bench("ball.obj", {"--json", "-q"}), other = bench("ball.obj", {"--json", "-q", "-t", "1"});
    const Said more = run({"bench", "ball.obj", "--time", little, "--rays", "ao,primary", "--accel",
                           "embree-fast,median", "--json", "-q"});
    ASSERT_EQ(one.code, 0) << one.err;
    EXPECT_EQ(one.err, "");
    const BenchRun a = read_bench_run("a", one.out), b = read_bench_run("b", other.out),
                   c = read_bench_run("c", more.out);
    ASSERT_THAT(a.rays, SizeIs(2));
    EXPECT_EQ(a.rays, b.rays);
    EXPECT_EQ(a.rays, c.rays);
    EXPECT_EQ(a.mesh_hash, c.mesh_hash);
    EXPECT_EQ(c.methods, (std::vector<std::string>{"embree-robust", "embree-fast", "median"}));
    for (const BenchFigure& f : b.figures) EXPECT_EQ(f.threads, 1u);
}

TEST_F(BenchCommand, TakesASceneWithItsCamera)
{
    // Spheres and planes are no triangles.
    const Said said = bench("scene.toml", {"--json", "-q"});
    EXPECT_EQ(said.code, 65);
    expect_words(said.err, "scene.toml");
    expect_words(said.err, "has no triangles");
    EXPECT_EQ(said.out, "");
    write(
        "with_mesh.toml",
        "version = 1\n[camera]\nposition = [0, 0, 5]\ntarget = [0, 0, 0]\n[[mesh]]\nfile = \"ball.obj\"\n"
        "[[light]]\ntype = \"environment\"\nradiance = [1, 1, 1]\n[[plane]]\nnormal = [0, 1, 0]\npoint = [0, -1, 0]\n");
    const Said seen = bench("with_mesh.toml", {"--json", "-q"});
    ASSERT_EQ(seen.code, 0) << seen.err;
    const BenchRun near = read_bench_run("near", seen.out);
    EXPECT_EQ(near.triangles, make_uv_sphere(12, 24)->triangles.size());
    const Said turned = bench("with_mesh.toml", {"--json", "-q", "-D", "camera.position=[3, 0, 5]"});
    const BenchRun far = read_bench_run("far", turned.out);
    EXPECT_EQ(near.mesh_hash, far.mesh_hash);
    EXPECT_NE(near.rays, far.rays);
}

TEST_F(BenchCommand, ComparesWithAnEarlierRunOfTheSameMesh)
{
    ASSERT_EQ(whole_bench("ball.obj", "first").code, 0);
    const Said again = whole_bench("ball.obj", "second", {"--against", "first"});
    ASSERT_EQ(again.code, 0) << again.err;
    expect_words(again.out, "against first: of ");
    EXPECT_TRUE(result("second/bench.json")
                    .find({.family = "rays", .accel = {}, .rays = "ao", .way = "single", .threads = 1}, "bvh8"));
    EXPECT_THAT(read_bytes(file("second/bench.html")), HasSubstr("Against an earlier run"));
    EXPECT_THAT(read_bytes(file("second/bench.json")), HasSubstr("\"against\":"));

    const Said other = bench("cube.obj", {"--against", "first/bench.json"});
    EXPECT_EQ(other.code, 65);
    expect_words(other.err, "first/bench.json");
    expect_words(other.err, "is of another mesh: 'ball'");
    EXPECT_EQ(other.out, "");
    const Said kinds = run({"bench", "ball.obj", "--time", little, "--rays", "ao", "--against", "first"});
    EXPECT_EQ(kinds.code, 65);
    expect_words(kinds.err, "is of other kinds of rays: primary, ao; these are ao");
    EXPECT_EQ(bench("ball.obj", {"--against", "nowhere"}).code, 66);
    write("broken.json", "{");
    EXPECT_EQ(bench("ball.obj", {"--against", "broken.json"}).code, 65);
}

TEST_F(BenchCommand, OverwritesNoFolderOfAnotherKind)
{
    std::filesystem::create_directory(file("mine"));
    write("mine/notes.txt", "kept");
    const Said said = bench("ball.obj", {"-o", "mine"});
    EXPECT_EQ(said.code, 2);
    expect_words(said.err, "'mine' holds something else than a run of lancer bench");
    EXPECT_EQ(read_bytes(file("mine/notes.txt")), "kept");
    EXPECT_FALSE(exists("mine/bench.json"));
    EXPECT_EQ(bench("ball.obj", {"-o", "ball.obj"}).code, 2);
    // An earlier run may be replaced, and an empty folder is free.
    std::filesystem::create_directory(file("empty"));
    ASSERT_EQ(bench("ball.obj", {"-o", "empty"}).code, 0);
    EXPECT_EQ(bench("ball.obj", {"-o", "empty"}).code, 0);
}

TEST_F(BenchCommand, RefusesWrongOptions)
{
    const auto refused = [&](const Arguments& arguments, const std::string& words) {
        const Said said = run(Arguments{"bench"} + arguments);
        EXPECT_EQ(said.code, 2) << words;
        expect_words(said.err, words);
    };
    refused({"ball.obj", "--time", "soon"}, "--time");
    refused({"ball.obj", "--quick", "--time", "5s"}, "--quick and --time exclude each other");
    refused({"ball.obj", "--accel", "bvh9"}, "'bvh9'");
    refused({"ball.obj", "--accel", "bvh8,"}, "--accel");
    refused({"ball.obj", "--rays", "primary,specular"}, "'specular'");
    refused({"ball.obj", "--error", "0"}, "--error");
    refused({"ball.obj", "--threads", "0"}, "--threads");
    refused({"ball.obj", "--spp", "4"}, "--spp");
    EXPECT_EQ(run({"bench", "missing.obj"}).code, 66);
    EXPECT_EQ(run({"bench", "--help"}).code, 0);
}

TEST_F(BenchCommand, AnInterruptEndsItWithWhatItHas)
{
    Program program(folder_, {"bench", "ball.obj", "--time", "10m", "--rays", "ao", "--accel", "bvh8", "-o", "out"});
    ASSERT_TRUE(program.wait_for_message("round 1"));
    program.send(SIGINT);
    const Said said = program.wait();
    EXPECT_EQ(said.code, 130) << said.err;
    const BenchRun r = result("out/bench.json");
    EXPECT_TRUE(r.interrupted);
    EXPECT_FALSE(r.figures.empty());
    EXPECT_THAT(read_bytes(file("out/bench.html")), HasSubstr("Interrupted"));
}

}  // namespace
}  // namespace lancer
