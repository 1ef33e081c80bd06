// lancer render --background transparent and opaque-glass, and other choices of what picture files hold.
#include <gtest/gtest.h>

#include <fstream>

#include "app/run_program.h"
#include "io/image/png.h"

namespace lancer {
namespace {

constexpr float sky = 0.75f;

class Alpha : public AppTest {
protected:
    Alpha()
    {
        write("ball.toml",
              "[[light]]\ntype = \"environment\"\nradiance = [0.75, 0.75, 0.75]\n"
              "[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 0]\n"
              "[material.m]\nbase_color = [0.5, 0.25, 0.125]\n[material.g]\ntype = \"glass\"\n"
              "[[sphere]]\ncenter = [-0.4, 0, 0]\nradius = 0.7\nmaterial = \"m\"\n"
              "[[sphere]]\ncenter = [0.9, 0.3, 0]\nradius = 0.5\nmaterial = \"g\"\n");
    }
    Said ball(std::vector<std::string> arguments) const
    {
        arguments.insert(arguments.begin(), {"render", "ball.toml", "--size", "32x24", "-s", "20", "-q"});
        return run(arguments);
    }
    std::vector<float> channel(const std::string& name, const std::string& which) const
    {
        return read_exr_channel(file(name), which);
    }
};

// The light of the sky that camera rays see is all that is missing, whatever finds the rest; also where they see it
// through glass.
TEST_F(Alpha, LeavesOutTheSkyThatCameraRaysSee)
{
    const std::vector<std::vector<std::string>> ways{
        {},
        {"--integrator", "direct"},
        {"--integrator", "whitted"},
        {"--integrator", "random-decision"},
        {"--set", "nee=false"},
        {"--accel", "list8", "--aov", "albedo"},
        {"--legacy", "--integrator", "path"},
    };
    for (const auto& way : ways) {
        std::string shown;
        for (const std::string& word : way) shown += " " + word;
        SCOPED_TRACE(shown);
        auto keep = way, hide = way;
        keep.insert(keep.end(), {"-o", "keep.exr"});
        hide.insert(hide.end(), {"-o", "hide.exr", "--background", "transparent"});
        auto glass = way;
        glass.insert(glass.end(), {"-o", "glass.exr", "--background", "opaque-glass"});
        if (const Said said = ball(glass); said.code != 0) FAIL() << said.err;
        if (const Said said = ball(keep); said.code != 0) FAIL() << said.err;
        if (const Said said = ball(hide); said.code != 0) FAIL() << said.err;
        const Image with = image("keep.exr"), without = image("hide.exr");
        const std::vector<float> alpha = channel("hide.exr", "A");
        // Glass that is opaque shows the sky; nothing else differs.
        const Image with_glass = image("glass.exr");
        const std::vector<float> opaque = channel("glass.exr", "A");
        size_t open = 0, covered = 0, edge = 0, seen_through = 0;
        for (size_t i = 0; i < alpha.size(); ++i) {
            const Color a = with.pixels[i], b = without.pixels[i];
            const float behind = (1 - alpha[i]) * sky;
            ASSERT_NEAR(b.r + behind, a.r, 1e-5) << i;
            ASSERT_NEAR(b.g + behind, a.g, 1e-5) << i;
            ASSERT_NEAR(b.b + behind, a.b, 1e-5) << i;
            ASSERT_NEAR(with_glass.pixels[i].g + (1 - opaque[i]) * sky, a.g, 1e-5) << i;
            ASSERT_LE(alpha[i], opaque[i] + 1e-6f) << i;
            seen_through += alpha[i] < 0.3f && opaque[i] == 1;
            if (opaque[i] == 0) {
                ASSERT_EQ(alpha[i], 0);
                ASSERT_EQ(b, Color{});
                ++open;
            }
            covered += alpha[i] == 1, edge += alpha[i] > 0 && alpha[i] < 1;
        }
        EXPECT_GT(open, 100u);
        EXPECT_GT(covered, 50u);
        EXPECT_GT(edge, 20u);
        // Of the older program's glass the sky is not seen behind.
        EXPECT_EQ(seen_through > 10, way.empty() || way[0] != "--legacy");
    }
}

TEST_F(Alpha, IsTheSameForThreadsTilesAndPasses)
{
    const std::vector<std::string> what{"--background", "transparent", "--denoise"};
    auto one = what, two = what;
    one.insert(one.end(), {"-o", "one.exr", "-t", "1"});
    two.insert(two.end(), {"-o", "two.exr", "-t", "4", "--tile", "5", "--batch", "3"});
    ASSERT_EQ(ball(one).code, 0);
    ASSERT_EQ(ball(two).code, 0);
    EXPECT_TRUE(same_pixels(image("one.exr"), image("two.exr")));
    const std::vector<float> alpha = channel("one.exr", "A");
    EXPECT_EQ(alpha, channel("two.exr", "A"));
    const Image denoised = image("one.exr");
    for (size_t i = 0; i < alpha.size(); ++i)
        if (alpha[i] == 0) {
            ASSERT_EQ(denoised.pixels[i], Color{}) << "light spread by the filter";
        }
}

// A tinted pane: alpha is what it takes from the light behind it, and the picture is what it adds.
TEST_F(Alpha, OfAPaneIsWhatItTakesAway)
{
    const auto pane = [&](const std::string& tint, const std::string& ior) {
        write("pane.toml",
              "[[light]]\ntype = \"environment\"\nradiance = 0.75\n"
              "[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 0]\n"
              "[material.g]\ntype = \"glass\"\nthin = true\nior = " +
                  ior + "\nbase_color = " + tint +
                  "\n[[triangle]]\na = [-9, -9, 0]\nb = [9, -9, 0]\nc = [0, 20, 0]\nmaterial = \"g\"\n");
        const Said said = run({"render", "pane.toml", "--size", "8x8", "-s", "256", "-q", "-o", "pane.exr",
                               "--background", "transparent", "--filter", "box"});
        EXPECT_EQ(said.code, 0) << said.err;
        return std::pair(channel("pane.exr", "A"), image("pane.exr"));
    };
    const auto [of_air, air] = pane("1", "1.000001");
    for (size_t i = 0; i < of_air.size(); ++i) {
        EXPECT_NEAR(of_air[i], 0, 1e-6) << "no glass at all";
        EXPECT_NEAR(air.pixels[i].g, 0, 1e-6);
    }
    // A pane that reflects next to nothing and lets 0.36 through at both faces.
    const auto [of_tinted, tinted] = pane("[0.6, 0.6, 0.6]", "1.000001");
    for (const float a : of_tinted) EXPECT_NEAR(a, 1 - 0.36, 1e-4);
    // Green light counts as the eye sees it: Rec. 709.
    const auto [of_green, green] = pane("[0, 1, 0]", "1.000001");
    for (const float a : of_green) EXPECT_NEAR(a, 1 - 0.7152, 1e-4);
    // A clear pane reflects about 8 % of the sky, and that is what it adds.
    const auto [of_clear, clear] = pane("1", "1.5");
    double alpha = 0, light = 0;
    for (size_t i = 0; i < of_clear.size(); ++i) alpha += of_clear[i], light += clear.pixels[i].g;
    EXPECT_NEAR(alpha / 64, 2 * 0.04 / 1.04, 0.004);
    EXPECT_NEAR(light, alpha * sky, 1e-4);
}

// A plate that catches shadows, under a ball.
class Catcher : public Alpha {
protected:
    // lights: tables of scene files; ball: whether there is one.
    void write_plate(const std::string& name, const std::string& lights, bool ball,
                     const std::string& material = "") const
    {
        write(name, "[camera]\nposition = [0, 6, 6]\ntarget = [0, 0, 0]\nfov = 30\n" + lights +
                        "[material.plate]\nbase_color = [0.6, 0.5, 0.4]\n" + material +
                        "[material.m]\nbase_color = [0.5, 0.25, 0.125]\n"
                        "[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nmaterial = \"plate\"\n" +
                        (ball ? "[[sphere]]\ncenter = [0, 0.8, 0]\nradius = 0.5\nmaterial = \"m\"\n" : ""));
    }
    Said draw(const std::string& scene, const std::string& picture, std::vector<std::string> more = {}) const
    {
        more.insert(more.begin(), {"render", scene, "--size", "32x24", "-q", "-o", picture});
        return run(more);
    }
    const std::string catches = "shadow_catcher = true\n";
};

// Of two directional lights the ball takes one, the other or none: alpha is the part of the light that is missing,
// as that of the picture drawn with the ball over that without.
TEST_F(Catcher, HasThePartOfTheLightThatIsBlocked)
{
    const std::string sun = "[[light]]\ntype = \"directional\"\ndirection = [-1, -1.5, 0]\nirradiance = 3\n";
    // It is so far off that its own shadow from the sun is not seen.
    const std::string lamps = "[[light]]\ntype = \"sphere\"\ncenter = [6, 3, 0]\nradius = 0.8\nradiance = 40\n";
    for (const std::string& lights :
         {sun, lamps, sun + lamps + "[[light]]\ntype = \"environment\"\nradiance = 0.5\n"}) {
        SCOPED_TRACE(lights);
        write_plate("catch.toml", lights, true, catches);
        write_plate("with.toml", lights, true);
        write_plate("without.toml", lights, false);
        const std::vector<std::string> direct{"--integrator", "direct", "-s", "1024"};
        ASSERT_EQ(draw("with.toml", "with.exr", direct).code, 0);
        ASSERT_EQ(draw("without.toml", "without.exr", direct).code, 0);
        const Said said = draw("catch.toml", "catch.exr", {"-s", "1024", "--background", "transparent"});
        ASSERT_EQ(said.code, 0) << said.err;
        EXPECT_EQ(text_of(read_exr_info(file("catch.exr")).metadata, "bias"), "shadow_ratio");
        ASSERT_EQ(draw("catch.toml", "mask.exr", {"-s", "1024", "--aov", "cryptomatte"}).code, 0);
        const std::vector<float> alpha = channel("catch.exr", "A"), part = channel("mask.exr", "CryptoMaterial00.G");
        const std::vector<float> first = channel("mask.exr", "CryptoObject00.R");
        const Image with = image("with.exr"), without = image("without.exr"), caught = image("catch.exr");
        const auto ball = size_t{9 * 32 + 16};  // a pixel that shows the ball
        size_t plain = 0, dark = 0, half = 0;
        for (size_t i = 0; i < alpha.size(); ++i) {
            if (part[i] != 1) continue;
            if (first[i] == first[ball]) {
                ASSERT_EQ(alpha[i], 1) << i;
                continue;
            }
            ASSERT_EQ(caught.pixels[i], Color{}) << i;
            ASSERT_NEAR(alpha[i], 1 - with.pixels[i].g / without.pixels[i].g, 0.05) << i;
            plain += alpha[i]<0.01f, dark += alpha[i]> 0.9f, half += alpha[i] > 0.1f && alpha[i] < 0.9f;
        }
        EXPECT_GT(plain, 100u);
        EXPECT_GT(dark + half, 10u);
    }
}

// The ball is drawn as it would be over a ground that is seen, which is drawn where nothing is hidden.
TEST_F(Catcher, IsAGroundToAllElse)
{
    const std::string light = "[[light]]\ntype = \"sphere\"\ncenter = [3, 3, 0]\nradius = 0.5\nradiance = 12\n";
    write_plate("catch.toml", light, true, catches);
    write_plate("plain.toml", light, true);
    ASSERT_EQ(draw("catch.toml", "keep.exr").code, 0);
    ASSERT_EQ(draw("plain.toml", "plain.exr").code, 0);
    EXPECT_TRUE(same_pixels(image("keep.exr"), image("plain.exr")));
    EXPECT_EQ(text_of(read_exr_info(file("keep.exr")).metadata, "bias"), "none");
    const std::vector<std::string> hide{"--background", "transparent"};
    auto two = hide;
    two.insert(two.end(), {"-t", "4", "--tile", "5", "--batch", "3"});
    ASSERT_EQ(draw("catch.toml", "one.exr", hide).code, 0);
    ASSERT_EQ(draw("catch.toml", "two.exr", two).code, 0);
    EXPECT_TRUE(same_pixels(image("one.exr"), image("two.exr")));
    EXPECT_EQ(channel("one.exr", "A"), channel("two.exr", "A"));
    const Image one = image("one.exr"), plain = image("plain.exr");
    const size_t ball = 9 * 32 + 16;
    EXPECT_EQ(one.pixels[ball], plain.pixels[ball]);
    EXPECT_GT(one.pixels[ball].g, 0.01f);
    const Said verified = run({"verify", "one.exr", "--pixels", "all"});
    EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
}

TEST_F(Alpha, OfPngIsStraight)
{
    ASSERT_EQ(ball({"-o", "a.exr", "-o", "a.png", "--background", "transparent", "--tonemap", "none"}).code, 0);
    ASSERT_EQ(ball({"-o", "plain.png"}).code, 0);
    EXPECT_EQ(read_png_info(file("plain.png")).channels, 3u);
    const Raster png = read_png_raster(file("a.png"));
    ASSERT_EQ(png.channels, 4u);
    const Image light = image("a.exr");
    const std::vector<float> alpha = channel("a.exr", "A");
    for (size_t i = 0; i < alpha.size(); ++i) {
        ASSERT_EQ(png.bytes[4 * i + 3], std::lround(alpha[i] * 255));
        const float green = alpha[i] > 0 ? light.pixels[i].g / alpha[i] : 0;
        ASSERT_NEAR(png.bytes[4 * i + 1], std::min(1.0f, green) * 255, 1.01);
    }
}

TEST_F(Alpha, IsRefusedWhereNoFileCanHoldIt)
{
    const Said said = ball({"-o", "a.png", "-o", "a.ppm", "--background", "transparent"});
    EXPECT_EQ(said.code, 2);
    expect_words(said.err, "'a.ppm' cannot hold an alpha channel");
}

using PictureFiles = Alpha;

TEST_F(PictureFiles, OfOneCommandHaveTheSameBytes)
{
    for (const char* threads : {"1", "3"}) {
        const std::string base = std::string("of") + threads;
        ASSERT_EQ(ball({"-o", base + ".exr", "-o", base + ".png", "-t", threads, "--reproducible"}).code, 0);
    }
    for (const std::string extension : {".exr", ".png"})
        EXPECT_EQ(read_bytes(file("of1" + extension)), read_bytes(file("of3" + extension))) << extension;
}

TEST_F(PictureFiles, KeepTheirBitsInAnyLosslessCompression)
{
    ASSERT_EQ(ball({"-o", "plain.exr"}).code, 0);
    const Image plain = image("plain.exr");
    for (const std::string how : {"none", "rle", "zips", "zip", "piz", "dwaa", "dwab"}) {
        ASSERT_EQ(ball({"-o", "a.exr", "--exr-compression", how, "--aov", "depth"}).code, 0) << how;
        EXPECT_EQ(read_exr_info(file("a.exr")).compression, how);
        const Image read = image("a.exr");
        if (!how.starts_with("dwa")) {
            EXPECT_TRUE(same_pixels(read, plain)) << how;
        }
        for (size_t i = 0; i < read.pixels.size(); ++i) ASSERT_NEAR(read.pixels[i].g, plain.pixels[i].g, 0.05) << how;
    }
}

// What Open Image Denoise takes: of matt surfaces what the AOVs have, behind glass what is seen through it.
TEST_F(PictureFiles, HaveGuidesForOtherDenoisers)
{
    ASSERT_EQ(ball({"-o", "a.exr", "--aov", "oidn,albedo,normal"}).code, 0);
    const size_t matt = 12 * 32 + 12, open = 0;
    for (const char* name : {"albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z"}) {
        const std::vector<float> guide = channel("a.exr", std::string("oidn.") + name), aov = channel("a.exr", name);
        EXPECT_NEAR(guide[matt], aov[matt], 1e-5) << name;
        EXPECT_NE(guide[matt], 0) << name;
        EXPECT_EQ(guide[open], 0) << name;
    }
    ASSERT_EQ(ball({"-o", "b.exr"}).code, 0);
    EXPECT_TRUE(same_pixels(image("a.exr"), image("b.exr"))) << "the picture stays as it is";
}

}  // namespace
}  // namespace lancer
