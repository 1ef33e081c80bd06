// lancer render as it should go: files, names, metadata, and pixels that depend on nothing else.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/run_program.h"
#include "io/image/png.h"

namespace lancer {
namespace {

using Render = AppTest;

TEST_F(Render, WritesEveryOutputAndNamesItOnStdout)
{
    const Said said = render({"-o", "a.exr", "-o", "b.PNG", "--output", "c.exr"});
    EXPECT_EQ(said.code, 0) << said.err;
    EXPECT_EQ(said.out, "a.exr\nb.PNG\nc.exr\n");
    EXPECT_EQ(image("a.exr").display, (Window{0, 0, 24, 16}));
    EXPECT_TRUE(same_pixels(image("a.exr"), image("c.exr")));
    EXPECT_EQ(read_png(file("b.PNG")).data, (Window{0, 0, 24, 16}));
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"a.exr", "b.PNG", "c.exr", "quad.obj", "scene.toml"}));
}

TEST_F(Render, IsMeantWithoutAWordAndNamesItsFileItself)
{
    const Said said = run({"scene.toml", "--size=24x16", "-s4", "-q"});
    EXPECT_EQ(said.code, 0) << said.err;
    EXPECT_EQ(said.out, "scene.exr\n");
    EXPECT_EQ(said.err, "");
    EXPECT_EQ(metadata("scene.exr", "spp"), "4");
}

TEST_F(Render, ANameBehindTwoDashesIsNoOption)
{
    write("-x.toml", small_scene);
    const Said said = run({"render", "--size", "8x8", "-s", "1", "-q", "--", "-x.toml"});
    EXPECT_EQ(said.code, 0) << said.err;
    EXPECT_EQ(said.out, "-x.exr\n");
}

TEST_F(Render, PixelsDependOnlyOnWhatDecidesThem)
{
    ASSERT_EQ(render({"-o", "one.exr", "--threads", "1", "-s", "40"}).code, 0);
    ASSERT_EQ(render({"-o", "two.exr", "-t", "2", "-s", "40", "--tile", "7", "--batch", "33"}).code, 0);
    ASSERT_EQ(render({"-o", "list.exr", "-s", "40", "--accel", "list"}).code, 0);
    ASSERT_EQ(render({"-o", "seed.exr", "-s", "40", "--seed", "1"}).code, 0);
    EXPECT_TRUE(same_pixels(image("one.exr"), image("two.exr")));
    EXPECT_TRUE(same_pixels(image("one.exr"), image("list.exr")));
    EXPECT_FALSE(same_pixels(image("one.exr"), image("seed.exr")));
    EXPECT_NE(metadata("one.exr", "settings_hash"), metadata("seed.exr", "settings_hash"));
    EXPECT_EQ(metadata("one.exr", "settings_hash"), metadata("two.exr", "settings_hash"));
}

TEST_F(Render, ACropIsThatPartOfTheWhole)
{
    ASSERT_EQ(render({"-o", "whole.exr"}).code, 0);
    ASSERT_EQ(render({"-o", "crop.exr", "--crop", "5,3,20,11"}).code, 0);
    const Image whole = image("whole.exr"), crop = image("crop.exr");
    EXPECT_EQ(crop.display, whole.display);
    ASSERT_EQ(crop.data, (Window{5, 3, 20, 11}));
    for (int y = 3; y < 11; ++y)
        for (int x = 5; x < 20; ++x) {
            EXPECT_EQ(crop.at(x, y).r, whole.at(x, y).r) << x << " " << y;
            EXPECT_EQ(crop.at(x, y).b, whole.at(x, y).b) << x << " " << y;
        }
}

TEST_F(Render, TheCommandLineGoesBeforeTheSceneAndTheSceneBeforeDefaults)
{
    write("settings.toml", std::string(small_scene) +
                               "[render]\nspp = 3\nsize = [10, 6]\nseed = 5\nintegrator = \"direct\"\nmax_depth = 2\n"
                               "filter = \"box\"\nsampler = \"independent\"\n");
    ASSERT_EQ(run({"settings.toml", "-o", "a.exr"}).code, 0);
    EXPECT_EQ(image("a.exr").display, (Window{0, 0, 10, 6}));
    EXPECT_EQ(metadata("a.exr", "spp"), "3");
    EXPECT_EQ(metadata("a.exr", "seed"), "5");
    EXPECT_EQ(metadata("a.exr", "integrator"), "direct");
    EXPECT_EQ(metadata("a.exr", "max_depth"), "2");
    EXPECT_EQ(metadata("a.exr", "filter"), "box");
    EXPECT_EQ(metadata("a.exr", "sampler"), "independent");
    EXPECT_EQ(metadata("a.exr", "bias"), "max_depth=2");
    ASSERT_EQ(run({"settings.toml", "-o", "a.exr", "-s", "2", "--size", "8x8", "--seed", "0", "--integrator", "path",
                   "--max-depth", "0", "--filter", "gaussian", "--sampler", "sobol"})
                  .code,
              0);
    EXPECT_EQ(image("a.exr").display, (Window{0, 0, 8, 8}));
    EXPECT_EQ(metadata("a.exr", "spp"), "2");
    EXPECT_EQ(metadata("a.exr", "integrator"), "path");
    EXPECT_EQ(metadata("a.exr", "filter"), "gaussian");
    EXPECT_EQ(metadata("a.exr", "bias"), "none");
}

// Of integrators with a depth of their own the picture tells the depth that it really has.
TEST_F(Render, TheLedgerTellsTheDepthThatTheIntegratorKeptTo)
{
    for (const std::string name : {"whitted", "random-decision"}) {
        ASSERT_EQ(run({"scene.toml", "-o", "a.exr", "-s", "1", "--integrator", name}).code, 0);
        EXPECT_EQ(metadata("a.exr", "max_depth"), "7");
        EXPECT_EQ(metadata("a.exr", "bias"), "no_diffuse_bounces, straight_shadows, max_depth=7");
        ASSERT_EQ(
            run({"scene.toml", "-o", "a.exr", "-s", "1", "--integrator", name, "--max-depth", "3", "--legacy"}).code,
            0);
        EXPECT_EQ(metadata("a.exr", "bias"), "no_diffuse_bounces, straight_shadows, max_depth=3, legacy, clamp");
    }
    ASSERT_EQ(run({"scene.toml", "-o", "a.exr", "-s", "1", "--integrator", "path"}).code, 0);
    EXPECT_EQ(metadata("a.exr", "max_depth"), "0");
}

TEST_F(Render, SwitchesChangeTheNoiseNotTheMean)
{
    ASSERT_EQ(render({"-o", "both.exr", "-s", "256"}).code, 0);
    ASSERT_EQ(render({"-o", "nee.exr", "-s", "256", "--set", "mis=false"}).code, 0);
    ASSERT_EQ(render({"-o", "bsdf.exr", "-s", "256", "--set", "nee=false,mis=false"}).code, 0);
    EXPECT_EQ(run({"compare", "nee.exr", "both.exr", "--fail-above", "0.02"}).code, 0);
    EXPECT_EQ(run({"compare", "bsdf.exr", "both.exr", "--fail-above", "0.02"}).code, 0);
    EXPECT_FALSE(same_pixels(image("nee.exr"), image("both.exr")));
    EXPECT_FALSE(same_pixels(image("bsdf.exr"), image("nee.exr")));
}

TEST_F(Render, HalfExposureAndDitherReachTheFiles)
{
    ASSERT_EQ(render({"-o", "float.exr", "-o", "plain.png"}).code, 0);
    ASSERT_EQ(render({"-o", "half.exr", "-o", "dark.png", "--half", "--exposure", "-2", "--dither"}).code, 0);
    EXPECT_FALSE(same_pixels(image("float.exr"), image("half.exr")));
    EXPECT_LT(read_png(file("dark.png")).at(0, 0).g, 0.5f * read_png(file("plain.png")).at(0, 0).g);
}

TEST_F(Render, ABareMeshGetsACameraAndASkyToPaste)
{
    const Said said = run({"quad.obj", "-o", "bare.exr", "--size", "24x16", "-s", "4"});
    ASSERT_EQ(said.code, 0) << said.err;
    expect_words(said.err, "[camera]");
    expect_words(said.err, "type = \"environment\"");
    expect_words(said.err, "type = \"sphere\"");
    // Beside the quad there is the sky, bluish; the quad itself is grey and lit, neither black nor burnt out.
    const Color sky = image("bare.exr").at(0, 0), face = image("bare.exr").at(12, 8);
    EXPECT_LE(sky.r, sky.b);
    EXPECT_GT(luminance(face), 0.1f);
    EXPECT_LT(luminance(face), 1.5f);

    const size_t begin = said.err.find("version = 1"), end = said.err.find("\nlancer:", begin);
    write("pasted.toml", said.err.substr(begin, end - begin));
    ASSERT_EQ(run({"pasted.toml", "-o", "pasted.exr", "--size", "24x16", "-s", "4"}).code, 0);
    EXPECT_TRUE(same_pixels(image("bare.exr"), image("pasted.exr")));
}

TEST_F(Render, AMeshThatShinesKeepsItsLightAndIsNotLeftInTheDark)
{
    write("lamp.mtl", "newmtl lamp\nKd 0 0 0\nKe 3 2 1\n");
    write("lamp.obj", std::string("mtllib lamp.mtl\nusemtl lamp\n") + quad);
    const Said said = run({"lamp.obj", "-o", "a.exr", "--size", "24x16", "-s", "4"});
    ASSERT_EQ(said.code, 0) << said.err;
    EXPECT_GT(image("a.exr").at(0, 0).r, 0.1f);
    EXPECT_FLOAT_EQ(image("a.exr").at(12, 8).g, 2);
}

TEST_F(Render, ASceneWithoutCameraGetsOneButNoSky)
{
    write("dark.toml", "version = 1\n[[sphere]]\nradius = 1\n");
    const Said said = run({"dark.toml", "-o", "a.exr", "--size", "8x8", "-s", "1"});
    EXPECT_EQ(said.code, 0) << said.err;
    expect_words(said.err, "[camera]");
    expect_words(said.err, "dark.toml: warning: nothing emits light");
    EXPECT_EQ(image("a.exr").at(4, 4).r, 0);
}

TEST_F(Render, ProgressAsJsonIsOneObjectPerLine)
{
    const Said said = render({"-o", "a.exr", "-s", "48", "--progress", "json"});
    size_t objects = 0;
    double fraction = 0;
    std::istringstream lines(said.err);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("{")) continue;
        const auto object = nlohmann::json::parse(line);
        ++objects;
        EXPECT_GE(object.at("fraction").get<double>(), fraction);
        fraction = object.at("fraction").get<double>();
    }
    EXPECT_GE(objects, 2u) << said.err;
    EXPECT_EQ(fraction, 1);
}

TEST_F(Render, StatsTellWhatWasDone)
{
    ASSERT_EQ(render({"-o", "a.exr", "--stats", "s.json", "-s", "40", "-t", "2"}).code, 0);
    const auto s = nlohmann::json::parse(read_bytes(file("s.json")));
    EXPECT_EQ(s.at("schema"), "lancer.stats/1");
    EXPECT_EQ(s.at("context").at("threads"), 2);
    EXPECT_NE(s.at("context").at("embree"), "");
    EXPECT_EQ(s.at("scene").at("spheres"), 2);
    EXPECT_EQ(s.at("scene").at("planes"), 1);
    EXPECT_EQ(s.at("settings").at("spp"), 40);
    EXPECT_EQ(s.at("samples").at("count"), 24 * 16 * 40);
    EXPECT_EQ(s.at("samples").at("dropped").at("count"), 0);
    EXPECT_EQ(s.at("rays").at("camera").at("count"), 24 * 16 * 40);
    EXPECT_GT(s.at("rays").at("shadow").at("count"), 0);
    EXPECT_GT(s.at("memory").at("peak_bytes"), 1000000);
    EXPECT_GT(s.at("estimated_error"), 0);
    EXPECT_EQ(s.at("partial"), false);
    std::vector<std::string> phases;
    for (const auto& p : s.at("phases")) {
        phases.push_back(p.at("name"));
        EXPECT_GT(p.at("resident_bytes"), 1000000);
        EXPECT_GE(p.at("peak_bytes"), p.at("resident_bytes"));
    }
    EXPECT_EQ(phases, (std::vector<std::string>{"load", "build scene", "build accelerator", "finish scene", "render",
                                                "write"}));
    EXPECT_EQ(s.at("passes").back().at("spp"), 40);
}

// The maps and tables of the picture, apart from the accelerator and without the wait for the picture.
TEST_F(Render, StatsTellHowLongTheEnvironmentTook)
{
    const auto seconds = [&] {
        std::vector<double> found;
        EXPECT_EQ(render({"-o", "a.exr", "--stats", "s.json"}).code, 0);
        const auto stats = nlohmann::json::parse(read_bytes(file("s.json")));
        for (const auto& a : stats.at("analyses"))
            if (a.at("name") == "environment") found.push_back(a.at("wall_s"));
        return found;
    };
    EXPECT_TRUE(seconds().empty());
    std::filesystem::rename(file("a.exr"), file("sky.exr"));
    write("scene.toml", std::string(small_scene) + "[[light]]\ntype = 'environment'\nfile = 'sky.exr'\n");
    ASSERT_EQ(seconds().size(), 1u);
    EXPECT_GT(seconds()[0], 0);
    write("scene.toml", std::string(small_scene) + "[background]\nsky = 'dawn'\n");
    EXPECT_EQ(seconds().size(), 1u);
}

// Of one sample each nothing is known of the error; 0 would be a claim.
TEST_F(Render, AnErrorThatIsNotKnownIsNotSaid)
{
    const auto stats = [&] { return nlohmann::json::parse(read_bytes(file("s.json"))); };
    const Said one = render({"-o", "a.exr", "--stats", "s.json", "-s", "1", "--progress", "json"});
    ASSERT_EQ(one.code, 0);
    EXPECT_TRUE(stats().at("estimated_error").is_null());
    EXPECT_TRUE(stats().at("estimated_interval").is_null());
    EXPECT_TRUE(stats().at("passes").back().at("error").is_null());
    EXPECT_EQ(metadata("a.exr", "estimated_error"), "none of this name");
    expect_words(one.err, "\"error\":null");
    EXPECT_EQ(one.err.find("error <"), std::string::npos) << one.err;

    ASSERT_EQ(render({"-o", "a.exr", "--stats", "s.json", "-s", "2"}).code, 0);
    EXPECT_GT(stats().at("estimated_error"), 0);
    EXPECT_GT(std::stod(metadata("a.exr", "estimated_error")), 0);
}

// Where all samples agree they say so.
TEST_F(Render, AnErrorOfNothingIsSaid)
{
    write("scene.toml",
          "version = 1\n[[sphere]]\nradius = 1e-3\ncenter = [0, 99, 0]\n[camera]\n"
          "position = [0, 0, 5]\ntarget = [0, 0, 0]\n");
    ASSERT_EQ(render({"-o", "a.exr", "--stats", "s.json"}).code, 0);
    EXPECT_EQ(nlohmann::json::parse(read_bytes(file("s.json"))).at("estimated_error"), 0);
    EXPECT_EQ(metadata("a.exr", "estimated_error"), "0");
}

// The picture keeps its bits; the log names the samples, and the figures have them too.
TEST_F(Render, ListsOutliers)
{
    ASSERT_EQ(render({"-o", "a.exr", "-s", "16"}).code, 0);
    const Said said = render({"-o", "b.exr", "-s", "16", "--outliers", "3", "--stats", "s.json"});
    ASSERT_EQ(said.code, 0) << said.err;
    EXPECT_TRUE(same_pixels(image("a.exr"), image("b.exr")));
    expect_words(said.err, "lancer pixel ");
    const auto sources = nlohmann::json::parse(read_bytes(file("s.json"))).at("error_sources");
    EXPECT_EQ(sources.at("outliers").size(), 3u);
    EXPECT_GE(sources.at("by_class").size(), 1u);
    EXPECT_EQ(render({"-o", "a.exr", "--outliers", "0"}).code, 2);
}

// What it chose itself it says by name, so that the command that it prints draws the same picture ever after.
TEST_F(Render, SaysWhichAcceleratorItChose)
{
    const auto chosen = [&] {
        const Said said = render({"-o", "a.exr", "--stats", "s.json", "-v"});
        EXPECT_EQ(said.code, 0) << said.err;
        const auto s = nlohmann::json::parse(read_bytes(file("s.json")));
        const std::string name = s.at("settings").at("accel");
        EXPECT_EQ(metadata("a.exr", "accel"), name);
        expect_words(said.err, "--accel " + name + " ");
        return name;
    };
    EXPECT_EQ(chosen(), "embree");
    write("few.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write("scene.toml", "version = 1\n[[mesh]]\nfile = 'few.obj'\n[[light]]\ntype = 'environment'\nradiance = 1\n");
    EXPECT_EQ(chosen(), "list8");
}

TEST_F(Render, MetadataTellHowToMakeItAgain)
{
    ASSERT_EQ(render({"-o", "a.exr", "--seed", "3"}).code, 0);
    ASSERT_EQ(render({"-o", "b.exr", "--seed", "3"}).code, 0);
    EXPECT_EQ(metadata("a.exr", "scene"), "scene.toml");
    EXPECT_EQ(metadata("a.exr", "seed"), "3");
    EXPECT_EQ(metadata("a.exr", "partial"), "0");
    EXPECT_EQ(metadata("a.exr", "dropped_samples"), "0");
    EXPECT_EQ(metadata("a.exr", "command_line"), "lancer render scene.toml --size 24x16 -s 4 -o a.exr --seed 3");
    EXPECT_EQ(metadata("a.exr", "scene_hash"), metadata("b.exr", "scene_hash"));
    write("scene.toml", std::string(small_scene) + "\n");
    ASSERT_EQ(render({"-o", "b.exr", "--seed", "3"}).code, 0);
    EXPECT_NE(metadata("a.exr", "scene_hash"), metadata("b.exr", "scene_hash"));
}

TEST_F(Render, ThreadsComeFromTheEnvironmentUnlessGiven)
{
    ASSERT_EQ(run({"scene.toml", "--size", "8x8", "-s", "1"}, {"LANCER_THREADS=3"}).code, 0);
    EXPECT_EQ(metadata("scene.exr", "threads"), "3");
    ASSERT_EQ(run({"scene.toml", "--size", "8x8", "-s", "1", "-t", "2"}, {"LANCER_THREADS=no"}).code, 0);
    EXPECT_EQ(metadata("scene.exr", "threads"), "2");
    const Said said = run({"scene.toml", "--size", "8x8", "-s", "1"}, {"LANCER_THREADS=no"});
    EXPECT_EQ(said.code, 2);
    expect_words(said.err, "LANCER_THREADS: 'no'");
}

TEST_F(Render, AovsAreFurtherChannels)
{
    EXPECT_EQ(render({"-o", "plain.exr"}).code, 0);
    EXPECT_EQ(render({"-o", "some.exr", "-o", "some.png", "--half", "--aov", "depth,normal", "--aov", "mask"}).code, 0);
    EXPECT_EQ(render({"-o", "all.exr", "--aov", "all"}).code, 0);
    EXPECT_TRUE(same_pixels(image("plain.exr"), image("all.exr")));
    std::string channels;
    for (const auto& c : read_exr_info(file("some.exr")).channels) channels += c.name + " " + c.type + ", ";
    EXPECT_EQ(channels,
              "B half, G half, R half, depth.Z float, mask.A float, normal.X float, normal.Y float, normal.Z float, ");
    EXPECT_EQ(read_exr_info(file("all.exr")).channels.size(), 3 + 3 + 3 + 1 + 3 + 2 + 1 + 1 + 1 + 3 + 1 + 1u);
    const std::vector<float> depth = read_exr_channel(file("all.exr"), "depth.Z");
    EXPECT_EQ(depth, read_exr_channel(file("some.exr"), "depth.Z"));
    EXPECT_EQ(depth.size(), 24u * 16u);
    EXPECT_NEAR(depth[8 * 24 + 12], 4.1f, 0.2f) << "the sphere of radius 1, from 5.1 away";
    const Said wrong = render({"--aov", "dept"});
    EXPECT_EQ(wrong.code, 2);
    expect_words(wrong.err, "did you mean 'depth'?");
}

}  // namespace
}  // namespace lancer
