// help, version, pixel and tune.
#include <gtest/gtest.h>

#include <cmath>

#include "app/run_program.h"
#include "io/image/png.h"

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
    for (const char* command : {"render", "check", "info", "compare", "pixel", "tune", "bench", "export"}) {
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

TEST_F(Commands, TunePrintsARowForEachEstimatorThatMatters)
{
    write("lamp.toml",
          "version = 1\n[camera]\nposition = [0, 0, 5]\n[[sphere]]\nradius = 1\n[[light]]\ntype = \"sphere\"\n"
          "center = [0, 3, 3]\nradius = 0.2\nradiance = 50\n");
    const Said said = run({"tune", "lamp.toml", "--size", "32x24", "--time", "1s", "-t", "2"});
    ASSERT_EQ(said.code, 0) << said.err;
    expect_words(said.out, "error x time");
    expect_words(said.out, "nee=false");
    expect_words(said.err, "round 6");
    EXPECT_EQ(run({"tune", "lamp.toml", "--time", "soon"}).code, 2);
    EXPECT_EQ(run({"tune", "missing.toml"}).code, 66);
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
