// lancer render --aov lights,parts,lobes: the light of a picture in layers.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "app/run_program.h"
#include "render/mattes.h"

namespace lancer {
namespace {

// Number of steps between two floats of the same sign, or NaNs.
int64_t steps_between(float a, float b)
{
    return std::abs(int64_t{std::bit_cast<int32_t>(a)} - int64_t{std::bit_cast<int32_t>(b)});
}

class Layers : public AppTest {
protected:
    Layers() { write("room.toml", scene("1.2")); }
    // Lights of every kind, a mirror that shows them, glass before one of them. sky: its brightness.
    static std::string scene(const std::string& sky)
    {
        return "[camera]\nposition = [0, 1, 5]\ntarget = [0, 0.6, 0]\n"
               "[[light]]\ntype = \"point\"\nposition = [-2, 3, 1]\nintensity = [4, 3, 2]\ngroup = \"points\"\n"
               "[[light]]\ntype = \"directional\"\ndirection = [1, -2, -1]\nirradiance = 0.4\n"
               "[[light]]\ntype = \"sphere\"\ncenter = [1.6, 1.7, 0.5]\nradius = 0.2\nradiance = 6\ngroup = \"ball\"\n"
               "[[light]]\ntype = \"environment\"\nradiance = " +
               sky +
               "\ngroup = \"sky\"\n"
               "[material.floor]\nbase_color = [0.6, 0.5, 0.4]\n"
               "[material.lamp]\nbase_color = 0.3\nemission = [1.5, 1, 2]\ngroup = \"lamp-2\"\n"
               "[material.mirror]\ntype = \"mirror\"\n"
               "[material.coated]\ntype = \"plastic\"\nroughness = 0.4\nbase_color = [0.2, 0.5, 0.2]\n"
               "[material.glass]\ntype = \"glass\"\n"
               "[[plane]]\npoint = [0, -0.01, 0]\nnormal = [0, 1, 0]\nmaterial = \"floor\"\n"
               "[[sphere]]\ncenter = [-0.9, 0.5, 0]\nradius = 0.5\nmaterial = \"coated\"\n"
               "[[sphere]]\ncenter = [0.2, 0.4, 0.9]\nradius = 0.4\nmaterial = \"glass\"\n"
               "[[sphere]]\ncenter = [1.2, 0.5, -0.2]\nradius = 0.5\nmaterial = \"lamp\"\n"
               "[[triangle]]\na = [-3, 0, -2]\nb = [3, 0, -2]\nc = [0, 4, -2]\nmaterial = \"mirror\"\n";
    }
    static const Arguments& groups()
    {
        static const Arguments all{"light.rest", "light.points", "light.ball", "light.sky", "light.lamp-2"};
        return all;
    }
    static const Arguments& parts()
    {
        static const Arguments all{"emission", "direct", "indirect"};
        return all;
    }
    static const Arguments& lobes()
    {
        static const Arguments all{"lobe.emission", "lobe.diffuse", "lobe.glossy", "lobe.transmission"};
        return all;
    }
    void draw(const std::string& picture, const Arguments& how, const std::string& scene = "room.toml") const
    {
        const Said said = run(Arguments{"render", scene, "--size", "32x24", "-s", "20", "-q", "-o", picture} + how);
        ASSERT_EQ(said.code, 0) << said.err;
    }
    std::vector<float> channel(const std::string& picture, const std::string& name) const
    {
        return read_exr_channel(file(picture), name);
    }
    // That layers add up to a picture, but for the last rounding of each; each has light.
    void expect_sum(const std::string& picture, const Arguments& layers, const std::string& of) const
    {
        for (const char* const c : {"R", "G", "B"}) {
            const std::vector<float> whole = channel(of, c);
            std::vector<double> sum(whole.size());
            for (const std::string& layer : layers) {
                const std::vector<float> light = channel(picture, layer + "." + c);
                double most = 0;
                for (size_t i = 0; i < sum.size(); ++i) sum[i] += light[i], most = std::max(most, double{light[i]});
                EXPECT_GT(most, 0) << layer;
            }
            for (size_t i = 0; i < sum.size(); ++i)
                ASSERT_LE(steps_between(static_cast<float>(sum[i]), whole[i]), 2) << c << ' ' << i;
        }
    }
};

TEST_F(Layers, AddUpToThePicture)
{
    const std::vector<Arguments> ways{{},
                                      {"--integrator", "direct"},
                                      {"--integrator", "whitted"},
                                      {"--integrator", "random-decision"},
                                      {"--set", "mis=false"},
                                      {"--set", "split=false", "--set", "straight_shadows=true"},
                                      {"--replicates", "4", "--denoise"},
                                      {"--accel", "list8", "--aov", "albedo,denoise"}};
    for (const Arguments& way : ways) {
        std::string shown;
        for (const std::string& word : way) shown += " " + word;
        SCOPED_TRACE(shown);
        const bool is_denoised = std::find(way.begin(), way.end(), "--denoise") != way.end();
        const bool is_classic = shown.find("whitted") + shown.find("random") < 2 * shown.size();
        ASSERT_NO_FATAL_FAILURE(draw("plain.exr", way));
        ASSERT_NO_FATAL_FAILURE(draw("layers.exr", way + Arguments{"--aov", "lights,parts,lobes"}));
        // Who asks for layers gets the same picture.
        EXPECT_TRUE(same_pixels(image("plain.exr"), image("layers.exr")));
        if (is_denoised) continue;
        expect_sum("layers.exr", groups(), "layers.exr");
        expect_sum("layers.exr", lobes(), "layers.exr");
        const bool has_indirect = !is_classic && shown.find("direct") == std::string::npos;
        expect_sum("layers.exr", has_indirect ? parts() : Arguments{"emission", "direct"}, "layers.exr");
    }
}

// Where the BSDF alone chooses ways, paths are the same whatever shines.
TEST_F(Layers, AreWhatOtherGroupsLeaveInTheDark)
{
    const Arguments way{"--set", "nee=false", "--set", "roulette=false", "--set", "split=false"};
    std::string lamp_alone = scene("0");
    const std::string ball = "radiance = 6";
    lamp_alone.replace(lamp_alone.find(ball), ball.size(), "radiance = 1e-20");
    write("lamp.toml", lamp_alone);
    ASSERT_NO_FATAL_FAILURE(draw("layers.exr", way + Arguments{"--aov", "lights"}));
    ASSERT_NO_FATAL_FAILURE(draw("lamp.exr", way, "lamp.toml"));
    const std::vector<float> layer = channel("layers.exr", "light.lamp-2.G"), alone = channel("lamp.exr", "G");
    for (size_t i = 0; i < layer.size(); ++i) EXPECT_NEAR(layer[i], alone[i], 1e-6f + 1e-6f * alone[i]) << i;
}

// Each part is the picture that has no other.
TEST_F(Layers, OfPartsAreThePicturesOfTheParts)
{
    ASSERT_NO_FATAL_FAILURE(draw("layers.exr", {"--aov", "parts"}));
    const std::vector<std::string> switches{"emitters", "direct", "indirect"};
    for (size_t part = 0; part < parts().size(); ++part) {
        Arguments only;
        for (size_t i = 0; i < switches.size(); ++i)
            if (i != part) only = only + Arguments{"--set", switches[i] + "=false"};
        ASSERT_NO_FATAL_FAILURE(draw("only.exr", only));
        const std::vector<float> layer = channel("layers.exr", parts()[part] + ".R"), alone = channel("only.exr", "R");
        for (size_t i = 0; i < layer.size(); ++i)
            ASSERT_LE(steps_between(layer[i], alone[i]), 2) << parts()[part] << ' ' << i;
    }
}

TEST_F(Layers, HaveTheSameBitsForThreadsTilesPassesAndShards)
{
    const Arguments what{"--aov", "lights,parts,lobes,denoise"};
    const auto expect_same = [&](const std::string& picture) {
        EXPECT_TRUE(same_pixels(image("one.exr"), image(picture))) << picture;
        for (const Arguments& layers : {groups(), parts(), lobes()})
            for (const std::string& layer : layers)
                EXPECT_EQ(channel("one.exr", layer + ".B"), channel(picture, layer + ".B")) << picture << layer;
    };
    ASSERT_NO_FATAL_FAILURE(draw("one.exr", what + Arguments{"-t", "1"}));
    ASSERT_NO_FATAL_FAILURE(draw("two.exr", what + Arguments{"-t", "4", "--tile", "5", "--batch", "3"}));
    expect_same("two.exr");
    const Arguments kept = what + Arguments{"--checkpoint", "c.lancer"};
    ASSERT_EQ(run(Arguments{"render", "room.toml", "--size", "32x24", "-q", "-s", "7", "-o", "kept.exr"} + kept).code,
              0);
    for (const char* const k : {"1", "2", "3"})
        ASSERT_NO_FATAL_FAILURE(
            draw(std::string("p.") + k + "-of-3.lancer", what + Arguments{"--shard", std::string(k) + "/3"}));
    const Said merged = run({"merge", "p.1-of-3.lancer", "p.3-of-3.lancer", "p.2-of-3.lancer", "-o", "merged.exr"});
    ASSERT_EQ(merged.code, 0) << merged.err;
    expect_same("merged.exr");
}

TEST_F(Layers, AreRefusedWhereLightHasNoSource)
{
    for (const char* const layers : {"lights", "lobes"})
        for (const Arguments& way : {Arguments{"--legacy"}, Arguments{"--integrator", "ao"}}) {
            const Said said = run(Arguments{"render", "room.toml", "-q", "-o", "a.exr", "--aov", layers} + way);
            EXPECT_EQ(said.code, 2);
            expect_words(said.err, "--aov: lights, parts and lobes do not work with ");
        }
    const Said said = run({"render", "room.toml", "-q", "-o", "a.png", "--aov", "parts"});
    EXPECT_EQ(said.code, 2);
    expect_words(said.err, "--aov: its channels are written to EXR pictures");
}

TEST_F(Layers, NamesOfGroupsAreChecked)
{
    write("bad.toml",
          "[[light]]\ntype = \"point\"\nposition = [0, 1, 0]\nintensity = 1\ngroup = \"a.b\"\n"
          "[material.m]\ngroup = \"\"\n[background]\nsky = 1\ngroup = \"two words\"\n");
    const Said said = run({"render", "bad.toml", "-o", "a.exr"});
    EXPECT_NE(said.code, 0);
    expect_words(said.err, "bad.toml:5:9: error: group 'a.b' must have letters, digits, '_' and '-' alone");
    expect_words(said.err, "bad.toml:7:9: error: 'group' in [material.m] must not be empty");
    expect_words(said.err, "bad.toml:10:9: error: group 'two words'");
    write("two.toml", "[[light]]\ntype = \"environment\"\nradiance = 1\ngroup = \"a\"\n[background]\nsky = 1\n");
    const Said two = run({"render", "two.toml", "-o", "a.exr"});
    EXPECT_NE(two.code, 0);
    expect_words(two.err, "all environments and the background are of one group; the first is stated at two.toml:1");
}

// Filtered light of groups is near the truth, and adds up to about the picture.
TEST_F(Layers, AreDenoisedLikeThePicture)
{
    const Arguments few{"--size", "80x60", "-s", "8"};
    ASSERT_NO_FATAL_FAILURE(draw("noisy.exr", few + Arguments{"--aov", "lights"}));
    ASSERT_NO_FATAL_FAILURE(draw("denoised.exr", few + Arguments{"--aov", "lights", "--denoise"}));
    ASSERT_NO_FATAL_FAILURE(draw("truth.exr", {"--size", "80x60", "-s", "600", "--aov", "lights"}));
    double sum_of_errors = 0, sum_of_noisy = 0;
    std::vector<double> sum(channel("noisy.exr", "G").size());
    for (const std::string& group : groups()) {
        const std::vector<float> truth = channel("truth.exr", group + ".G"), noisy = channel("noisy.exr", group + ".G"),
                                 filtered = channel("denoised.exr", group + ".G");
        for (size_t i = 0; i < truth.size(); ++i) {
            const double norm = truth[i] * truth[i] + 0.01;
            sum_of_noisy += std::pow(noisy[i] - truth[i], 2) / norm;
            sum_of_errors += std::pow(filtered[i] - truth[i], 2) / norm;
            sum[i] += filtered[i];
        }
    }
    EXPECT_LT(sum_of_errors, 0.8 * sum_of_noisy);
    const std::vector<float> picture = channel("denoised.exr", "G");
    double difference = 0, whole = 0;
    for (size_t i = 0; i < sum.size(); ++i) difference += std::abs(sum[i] - picture[i]), whole += picture[i];
    EXPECT_LT(difference, 0.05 * whole);
}

TEST_F(Layers, CryptomatteCountsWhatPixelsShow)
{
    ASSERT_NO_FATAL_FAILURE(draw("m.exr", {"--aov", "cryptomatte,material,mask,z,depth,position"}));
    ASSERT_NO_FATAL_FAILURE(draw("plain.exr", {}));
    EXPECT_TRUE(same_pixels(image("m.exr"), image("plain.exr")));
    const std::vector<float> mask = channel("m.exr", "mask.A"), first = channel("m.exr", "material.ID");
    for (const std::string kind : {"CryptoObject", "CryptoMaterial"}) {
        std::vector<double> covered(mask.size());
        std::vector<float> before;
        for (const char* const rank : {"00.R", "00.B", "01.R", "01.B", "02.R", "02.B"}) {
            const char* const of_coverage = rank[3] == 'R' ? ".G" : ".A";
            const std::vector<float> id = channel("m.exr", kind + rank),
                                     part = channel("m.exr", kind + std::string(rank, 2) + of_coverage);
            for (size_t i = 0; i < part.size(); ++i) {
                covered[i] += part[i];
                EXPECT_EQ(part[i] > 0, id[i] != 0);
                if (!before.empty()) {
                    EXPECT_LE(part[i], before[i]);
                }
            }
            before = part;
        }
        for (size_t i = 0; i < mask.size(); ++i) EXPECT_NEAR(covered[i], mask[i], 1e-6) << i;
    }
    // A pixel in the middle of the lamp, which is the sphere that the file names third, shows it alone.
    const size_t lamp = 11 * 32 + 21;
    EXPECT_EQ(channel("m.exr", "CryptoMaterial00.G")[lamp], 1);
    EXPECT_EQ(std::bit_cast<uint32_t>(channel("m.exr", "CryptoObject00.R")[lamp]), matte_id("sphere#2"));
    EXPECT_EQ(std::bit_cast<uint32_t>(channel("m.exr", "CryptoMaterial00.R")[lamp]), matte_id("lamp"));
    // The camera looks down a little: a point's distance from its plane.
    const std::vector<float> z = channel("m.exr", "Z"), y = channel("m.exr", "position.Y"),
                             at_z = channel("m.exr", "position.Z");
    const double norm = std::hypot(0.4, 5.0);
    const double expected = ((1 - double{y[lamp]}) * 0.4 + (5 - double{at_z[lamp]}) * 5) / norm;
    EXPECT_NEAR(z[lamp], expected, 1e-5);
    EXPECT_LT(z[lamp], channel("m.exr", "depth.Z")[lamp]);
}

TEST_F(Layers, HaveTheNamesOfOtherPrograms)
{
    const std::string all = "all,lights,lobes,oidn,cryptomatte";
    ASSERT_NO_FATAL_FAILURE(draw("ours.exr", {"--aov", all}));
    ASSERT_NO_FATAL_FAILURE(draw("nuke.exr", {"--aov", all, "--layer-names", "nuke"}));
    ASSERT_NO_FATAL_FAILURE(draw("blender.exr", {"--aov", all, "--layer-names", "blender"}));
    const std::vector<std::array<const char*, 3>> names{
        {"normal.X", "N.X", "Normal.X"},
        {"Z", "Z", "Depth.Z"},
        {"light.lamp-2.G", "light_lamp-2.G", "Combined_lamp-2.G"},
        {"lobe.diffuse.R", "lobe_diffuse.R", "lobe_diffuse.R"},
        {"oidn.albedo.B", "oidn_albedo.B", "Denoising Albedo.B"},
        {"CryptoMaterial01.A", "CryptoMaterial01.A", "CryptoMaterial01.A"}};
    for (const auto& [ours, nuke, blender] : names) {
        const std::vector<float> values = channel("ours.exr", ours);
        EXPECT_EQ(channel("nuke.exr", nuke), values) << ours;
        EXPECT_EQ(channel("blender.exr", blender), values) << ours;
    }
}

TEST_F(Layers, CryptomatteIsRefusedWhereItWouldBeDestroyed)
{
    const Said said = run({"render", "room.toml", "-o", "a.exr", "--aov", "cryptomatte", "--exr-compression", "dwab"});
    EXPECT_EQ(said.code, 2);
    expect_words(said.err, "dwaa and dwab would destroy the names of cryptomatte");
}

}  // namespace
}  // namespace lancer
