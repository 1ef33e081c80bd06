// lancer study: what it makes, that it goes on where it ended, and what it says of wrong files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/run_program.h"
#include "report/study/json.h"
#include "support/xml_check.h"

namespace lancer {
namespace {

class StudyCommand : public AppTest {
protected:
    StudyCommand() { write("study.toml", study); }
    Study result() const { return read_study("study.json", read_bytes(file("out/study.json"))); }

    static constexpr const char* study = R"(version = 1
title = "Two ways"
seeds = 2
spp = 16
baseline = "path"
[[scene]]
name = "balls"
file = "scene.toml"
options = "--size 12x8"
reference_spp = 64
[[method]]
name = "path"
[[method]]
name = "whitted"
options = "--integrator whitted"
)";
};

TEST_F(StudyCommand, DrawsEveryMethodWithEverySeedAndMakesAPage)
{
    const Said said = run({"study", "study.toml", "-o", "out"});
    ASSERT_EQ(said.code, 0) << said.err;
    EXPECT_THAT(said.out, testing::ContainsRegex("balls +whitted .* not ranked: "));
    EXPECT_THAT(said.out, testing::ContainsRegex("geometric mean +whitted +not ranked: "));
    EXPECT_TRUE(said.out.ends_with("\nout/index.html\nout/study.json\nout/runs.csv\n")) << said.out;
    EXPECT_NE(said.err.find("4 of 4: balls, whitted, seed 2"), std::string::npos) << said.err;
    const Study s = result();
    ASSERT_EQ(s.runs.size(), 4u);
    for (const StudyRun& run : s.runs) {
        ASSERT_EQ(run.points.size(), 5u);  // 1, 2, 4, 8 and 16 samples
        EXPECT_EQ(run.points.back().spp, 16u);
        EXPECT_EQ(run.points.back().rays_camera, 12u * 8 * 16);
        EXPECT_GT(run.points.back().rmse, 0);
        EXPECT_GT(run.points.back().flip, 0);
    }
    // In turns, so that a machine that slows down slows all of them.
    EXPECT_EQ(s.runs[0].method, "path");
    EXPECT_EQ(s.runs[1].method, "whitted");
    EXPECT_EQ(s.runs[2].seed, 2u);
    EXPECT_TRUE(s.methods[0].biases.empty());
    EXPECT_FALSE(s.methods[1].biases.empty());
    EXPECT_GT(s.scenes[0].reference_noise_relmse, 0);
    const std::string page = read_bytes(file("out/index.html"));
    EXPECT_NE(page.find("Two ways"), std::string::npos);
    EXPECT_NE(page.find("whitted (biased)"), std::string::npos);
}

TEST_F(StudyCommand, DenoisesWhereAMethodAsksForIt)
{
    std::string denoised = study;
    denoised.replace(denoised.find("--integrator whitted"), 20, "--denoise");
    write("study.toml", denoised);
    ASSERT_EQ(run({"study", "study.toml", "-o", "out"}).code, 0);
    const Study s = result();
    EXPECT_EQ(s.methods[1].biases, std::vector<std::string>{"denoised"});
    const auto last = [&](size_t run) { return s.runs[run].points.back(); };
    EXPECT_NE(last(0).rmse, last(1).rmse);
    for (const size_t run : {0, 1}) EXPECT_EQ(last(run).spp, 16u);
    EXPECT_EQ(last(0).rays_shadow, last(1).rays_shadow);
    EXPECT_NE(read_bytes(file("out/index.html")).find("s to FLIP 0.1"), std::string::npos);
}

TEST_F(StudyCommand, TheLedgerOfAMethodIsOfAllScenes)
{
    // On the second scene the reference has the limit as well.
    std::string two = study;
    two.replace(two.find("--integrator whitted"), 20, "--max-depth 3");
    const size_t at = two.find("[[method]]");
    two.insert(at,
               "[[scene]]\nname = \"short\"\nfile = \"scene.toml\"\noptions = \"--size 12x8 --max-depth 3\"\n"
               "reference_spp = 64\n");
    write("study.toml", two);
    ASSERT_EQ(run({"study", "study.toml", "-o", "out"}).code, 0);
    const Study s = result();
    EXPECT_EQ(s.methods[1].biases, std::vector<std::string>{"max_depth=3"});
    EXPECT_TRUE(s.methods[0].biases.empty());
    EXPECT_NE(s.scenes[1].reference.find("its limits, shared by the methods: max_depth=3"), std::string::npos);
    EXPECT_EQ(s.scenes[0].reference.find("its limits"), std::string::npos);
}

TEST_F(StudyCommand, GoesOnWhereItEndedAndDrawsAnewWhatHasChanged)
{
    ASSERT_EQ(run({"study", "study.toml", "-o", "out"}).code, 0);
    const Study before = result();
    ASSERT_EQ(run({"study", "study.toml", "-o", "out"}).code, 0);
    const Study again = result();
    for (size_t i = 0; i < before.runs.size(); ++i)
        EXPECT_EQ(before.runs[i].points.back().wall_s, again.runs[i].points.back().wall_s);
    std::filesystem::remove(file("out/runs/balls.path.2.exr.done"));
    std::string changed = study;
    changed.replace(changed.find("--integrator whitted"), 20, "--integrator whitted --max-depth 3");
    write("study.toml", changed);
    ASSERT_EQ(run({"study", "study.toml", "-o", "out"}).code, 0);
    const Study after = result();
    EXPECT_EQ(before.runs[0].points.back().wall_s, after.runs[0].points.back().wall_s);
    EXPECT_NE(before.runs[1].points.back().wall_s, after.runs[1].points.back().wall_s);
    EXPECT_NE(before.runs[2].points.back().wall_s, after.runs[2].points.back().wall_s);
}

TEST_F(StudyCommand, ARunThatFailsIsSaidAndNotHidden)
{
    std::string broken = study;
    broken.replace(broken.find("--integrator whitted"), 20, "--camera nobody     ");
    write("study.toml", broken);
    const Said said = run({"study", "study.toml", "-o", "out"});
    EXPECT_EQ(said.code, 1);
    EXPECT_NE(said.err.find("2 of 4 runs failed; the first one, whitted on balls, said:"), std::string::npos)
        << said.err;
    EXPECT_NE(said.err.find("'nobody'"), std::string::npos) << said.err;
    EXPECT_TRUE(result().runs[1].failed);
    EXPECT_FALSE(result().runs[0].failed);
}

TEST_F(StudyCommand, OfAStrangerWritesNothingAndStartsNothing)
{
    for (const std::string options :
         {"--output evil.exr", "-qo evil.exr", "-oevil.exr", "--stats=evil.json", "--error-log evil.csv",
          "--write-scene evil.toml", "--checkpoint evil.lancer", "--resume evil.lancer", "--shard 1/2", "--frames 1-2",
          "--display-server localhost:1", "--reference evil.exr", "other.toml", "--help", "--integrator whited"}) {
        std::string bad = study;
        bad.replace(bad.find("--integrator whitted"), 20, options);
        write("study.toml", bad);
        const Said said = run({"study", "study.toml", "-o", "out"});
        EXPECT_EQ(said.code, 65) << options << said.err;
        EXPECT_NE(said.err.find("study.toml: error: 'whitted': options: "), std::string::npos) << said.err;
        EXPECT_FALSE(exists("out")) << options;
        std::string of_scene = study;
        of_scene.replace(of_scene.find("--size 12x8"), 11, options);
        write("study.toml", of_scene);
        EXPECT_EQ(run({"study", "study.toml", "-o", "out"}).code, 65) << options;
    }
    std::string with_peer = study;
    with_peer.replace(with_peer.find("spp = 16"), 8, "spp = 16\npeers = \"peers\"");
    with_peer.replace(with_peer.find("options = \"--integrator whitted\""), 32, "peer = \"evil\"");
    write("study.toml", with_peer);
    std::filesystem::create_directory(file("peers"));
    write("peers/run", "#!/bin/sh\ntouch evil.exr\n");
    std::filesystem::permissions(file("peers/run"), std::filesystem::perms::all);
    const Said peer = run({"study", "study.toml", "-o", "out"});
    EXPECT_EQ(peer.code, 2);
    expect_words(peer.err, "if you trust it, add --allow-peers");
    EXPECT_FALSE(exists("evil.exr"));
}

TEST_F(StudyCommand, SaysWhatIsWrongWithItsFile)
{
    const auto expect = [&](const std::string& text, int code, const std::string& words) {
        write("bad.toml", text);
        const Said said = run({"study", "bad.toml", "-o", "bad"});
        EXPECT_EQ(said.code, code) << said.err;
        EXPECT_NE(said.err.find(words), std::string::npos) << said.err;
        EXPECT_FALSE(exists("bad"));
    };
    const std::string scene = "[[scene]]\nname = \"a\"\nfile = \"scene.toml\"\n", method = "[[method]]\nname = \"m\"\n";
    expect("version = 1\nspp = 4\n" + method, 65, "there is no [[scene]]");
    expect("version = 1\nspp = 4\n" + scene, 65, "there is no [[method]]");
    expect("version = 1\n" + scene + method, 65, "'time' (seconds of a run) or 'spp' is needed");
    expect("version = 1\nspp = 4\nsped = 2\n" + scene + method, 65, "bad.toml:3:1: error: unknown key 'sped'");
    expect("version = 1\nspp = 4\n" + scene + method + method, 65, "two are named 'm'");
    expect("version = 1\nspp = 4\nbaseline = \"x\"\n" + scene + method, 65, "no [[method]] is named 'x'");
    expect("version = 1\nspp = 4\n[[scene]]\nname = \"a/b\"\nfile = \"scene.toml\"\n" + method, 65, "may have letters");
    expect("version = 1\nspp = 4\n[[scene]]\nname = \"a\"\nfile = \"gone.toml\"\n" + method, 66, "no such file");
    const std::string optional = "[[scene]]\nname = \"b\"\nfile = \"gone.toml\"\noptional = true\n";
    expect("version = 1\nspp = 4\n" + optional + method, 65, "none of its scenes is there");
    expect("version = [\n", 65, "invalid TOML");
    EXPECT_EQ(run({"study", "nothing.toml"}).code, 66);
    EXPECT_EQ(run({"study"}).code, 2);
}

TEST_F(StudyCommand, AnOptionalSceneMayBeMissing)
{
    write("study.toml", std::string(study) + "[[scene]]\nname = \"gone\"\nfile = \"gone.toml\"\noptional = true\n");
    const Said said = run({"study", "study.toml", "-o", "out"});
    ASSERT_EQ(said.code, 0) << said.err;
    expect_words(said.err, "gone.toml'");
    expect_words(said.err, "the scene is left out");
    EXPECT_EQ(read_bytes(file("out/study.json")).find("\"gone\""), std::string::npos);
}

TEST_F(StudyCommand, AnInterruptEndsItAndTheNextOneGoesOn)
{
    std::string longer = study;
    longer.replace(longer.find("spp = 16"), 8, "time = 20");
    write("study.toml", longer);
    Program program(folder_, {"study", "study.toml", "-o", "out"});
    ASSERT_TRUE(program.wait_for([&] { return exists("out/runs/balls.path.1.csv"); })) << program.err();
    program.send(SIGINT);
    const Said said = program.wait();
    EXPECT_EQ(said.code, 130);
    EXPECT_NE(said.err.find("the same command goes on"), std::string::npos) << said.err;
    EXPECT_FALSE(exists("out/index.html"));
    EXPECT_FALSE(exists("out/runs/balls.path.1.exr.done"));
}

}  // namespace
}  // namespace lancer
