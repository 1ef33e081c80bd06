// help, version, compare and pixel.
#include <gtest/gtest.h>

#include <cmath>

#include "app/run_program.h"
#include "io/png.h"

namespace lancer {
namespace {

using Commands = AppTest;

TEST_F(Commands, HelpNamesEveryOption)
{
    const Said said = run({"render", "--help"});
    EXPECT_EQ(said.code, 0);
    EXPECT_EQ(said.err, "");
    for (const char* option : {"-o,--output",  "-s,--spp",  "-t,--threads", "--size",       "--crop",    "--seed",
                               "--integrator", "--accel",   "--sampler",    "--filter",     "--set",     "--isa",
                               "--max-depth",  "--tile",    "--batch",      "--asset-root", "--half",    "--exposure",
                               "--dither",     "--stats",   "--progress",   "--strict",     "--camera",  "-D",
                               "--aov",        "--tonemap", "-q,--quiet",   "-v,--verbose", "--version", "-h,--help"}) {
        expect_words(said.out, option);
    }
    for (const char* command : {"render", "check", "info", "compare", "pixel", "export"}) {
        expect_words(run({"--help"}).out, "lancer " + std::string(command));
        EXPECT_EQ(run({command, "--help"}).code, 0);
    }
}

TEST_F(Commands, VersionNamesTheLibraries)
{
    const Said said = run({"--version"});
    EXPECT_EQ(said.code, 0);
    for (const char* name : {"lancer ", "Embree ", "OpenEXR ", "libpng ", "compiled by "}) expect_words(said.out, name);
    EXPECT_EQ(run({"render", "--version"}).out, said.out);
}

class Compare : public AppTest {
protected:
    Compare()
    {
        Image image = make_image(8, 4);
        for (Color& c : image.pixels) c = {0.5f, 0.25f, 1};
        write_exr(file("a.exr"), image);
        image.at(3, 2).g = 0.35f;
        write_exr(file("b.exr"), image);
        image.at(0, 0).g = std::nanf("");
        write_exr(file("nan.exr"), image);
        write_exr(file("small.exr"), make_image(4, 4));
        write_png(file("a.png"), image);
    }
};

TEST_F(Compare, PrintsAndJudges)
{
    const Said same = run({"compare", "a.exr", "a.exr", "--fail-above", "0"});
    EXPECT_EQ(same.code, 0);
    expect_words(same.out, "rmse                 0\n");
    expect_words(same.out, "differing_pixels     0 of 32\n");
    const Said other = run({"compare", "b.exr", "a.exr"});
    EXPECT_EQ(other.code, 0);
    expect_words(other.out, "differing_pixels     1 of 32\n");
    expect_words(other.out, " at 3 2\n");
    // 0.1^2 / (0.25^2 + 0.01) over 96 values is 1.44e-3; the root of 0.1^2 / 96 is 1.02e-2.
    EXPECT_EQ(run({"compare", "b.exr", "a.exr", "--fail-above", "1.5e-3"}).code, 0);
    EXPECT_EQ(run({"compare", "b.exr", "a.exr", "--fail-above", "1.4e-3"}).code, 1);
    EXPECT_EQ(run({"compare", "b.exr", "a.exr", "--metric", "rmse", "--fail-above", "1.1e-2"}).code, 0);
    EXPECT_EQ(run({"compare", "b.exr", "a.exr", "--metric", "rmse", "--fail-above", "1e-2"}).code, 1);
    EXPECT_EQ(run({"compare", "nan.exr", "a.exr", "--fail-above", "1000"}).code, 1);
    EXPECT_EQ(run({"compare", "a.png", "b.exr", "--fail-above", "0.01"}).code, 0);
}

TEST_F(Compare, TwoReferencesGiveTheUnbiasedError)
{
    // One of the references is right, so that the product of the differences is 0.
    const Said said = run({"compare", "a.exr", "b.exr", "a.exr", "--fail-above", "1e-9"});
    EXPECT_EQ(said.code, 0);
    expect_words(said.out, "relmse_unbiased      0\n");
    EXPECT_EQ(run({"compare", "a.exr", "b.exr", "--reference2", "b.exr", "--fail-above", "1e-9"}).code, 1);
}

TEST_F(Compare, RefusesWhatCannotBeCompared)
{
    EXPECT_EQ(run({"compare", "a.exr"}).code, 2);
    EXPECT_EQ(run({"compare", "a.exr", "b.exr", "--fail-above", "-1"}).code, 2);
    EXPECT_EQ(run({"compare", "a.exr", "b.exr", "--metric", "psnr"}).code, 2);
    EXPECT_EQ(run({"compare", "a.exr", "none.exr"}).code, 66);
    EXPECT_EQ(run({"compare", "a.exr", "small.exr"}).code, 65);
    EXPECT_EQ(run({"compare", "a.exr", "scene.toml"}).code, 65);
    write_bytes(file("cut.exr"), read_bytes(file("a.exr")).substr(0, 200));
    EXPECT_EQ(run({"compare", "a.exr", "cut.exr"}).code, 65);
}

class ReplayedPixel : public AppTest {
protected:
    // The line "radiance (r, g, b)".
    static Color radiance_of(const Said& said)
    {
        Color c;
        const size_t at = said.out.rfind("radiance (");
        EXPECT_NE(at, std::string::npos) << said.out;
        EXPECT_EQ(std::sscanf(said.out.c_str() + at, "radiance (%f, %f, %f)", &c.r, &c.g, &c.b), 3) << said.out;
        return c;
    }
};

TEST_F(ReplayedPixel, HasTheBitsOfTheRender)
{
    ASSERT_EQ(render({"-o", "a.exr", "-s", "1", "--seed", "7"}).code, 0);
    const Image picture = image("a.exr");
    for (const auto& [x, y] : std::vector<std::pair<int, int>>{{0, 0}, {12, 8}, {23, 15}, {9, 12}}) {
        const Color c = radiance_of(
            run({"pixel", "scene.toml", std::to_string(x), std::to_string(y), "--size", "24x16", "--seed", "7"}));
        EXPECT_EQ(c.r, picture.at(x, y).r) << x << " " << y;
        EXPECT_EQ(c.g, picture.at(x, y).g) << x << " " << y;
        EXPECT_EQ(c.b, picture.at(x, y).b) << x << " " << y;
    }
}

TEST_F(ReplayedPixel, PrintsVerticesInTheUnitsOfTheFile)
{
    write("far.toml",
          "version = 1\n[camera]\nposition = [0, 0, 5000]\n[[sphere]]\nradius = 1000\nmaterial = \"ball\"\n"
          "[material.ball]\ntype = \"lambert\"\n[[light]]\ntype = \"point\"\nposition = [0, 0, 4000]\n"
          "intensity = [1e6, 1e6, 1e6]\n");
    const Said said = run({"pixel", "far.toml", "50", "50", "3", "--size", "101x101", "--filter", "box"});
    ASSERT_EQ(said.code, 0) << said.err;
    expect_words(said.out, "origin         (0, 0, 5000)");
    expect_words(said.out, "hit            sphere 0");
    expect_words(said.out, "t              4000.");
    expect_words(said.out, "'ball'");
    expect_words(said.out, "front side");
    expect_words(said.out, ": arrives");
}

TEST_F(ReplayedPixel, RefusesPixelsOutsideOfThePicture)
{
    EXPECT_EQ(run({"pixel", "scene.toml", "24", "0", "--size", "24x16"}).code, 2);
    EXPECT_EQ(run({"pixel", "scene.toml", "0", "16", "--size", "24x16"}).code, 2);
    EXPECT_EQ(run({"pixel", "scene.toml", "-1", "0"}).code, 2);
    EXPECT_EQ(run({"pixel", "scene.toml", "0"}).code, 2);
    EXPECT_EQ(run({"pixel", "none.toml", "0", "0"}).code, 66);
}

}  // namespace
}  // namespace lancer
