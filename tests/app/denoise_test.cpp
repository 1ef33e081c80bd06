// lancer render --denoise and lancer denoise, as a user sees them.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/run_program.h"
#include "io/image/exr.h"

namespace lancer {
namespace {

class Denoising : public AppTest {
protected:
    std::vector<std::string> channels(const std::string& name) const
    {
        std::vector<std::string> names;
        for (const auto& c : read_exr_info(file(name)).channels) names.push_back(c.name);
        return names;
    }
};

TEST_F(Denoising, KeepsTheNoisyPictureAsALayer)
{
    ASSERT_EQ(render({"-o", "plain.exr", "-s", "8"}).code, 0);
    const Said said = render({"-o", "a.exr", "-o", "a.png", "-s", "8", "--denoise", "--stats", "a.json"});
    ASSERT_EQ(said.code, 0) << said.err;
    const Image plain = image("plain.exr"), denoised = image("a.exr");
    EXPECT_FALSE(same_pixels(plain, denoised));
    EXPECT_EQ(channels("plain.exr"), (std::vector<std::string>{"B", "G", "R"})) << "nothing where it is not asked for";
    EXPECT_EQ(channels("a.exr"),
              (std::vector<std::string>{"B", "G", "R", "denoise_error.V", "noisy.B", "noisy.G", "noisy.R"}));
    Image noisy = plain;
    const auto red = read_exr_channel(file("a.exr"), "noisy.R"), green = read_exr_channel(file("a.exr"), "noisy.G"),
               blue = read_exr_channel(file("a.exr"), "noisy.B");
    for (size_t i = 0; i < noisy.pixels.size(); ++i) noisy.pixels[i] = {red[i], green[i], blue[i]};
    EXPECT_TRUE(same_pixels(plain, noisy)) << "the ordinary picture";
    EXPECT_EQ(metadata("plain.exr", "bias"), "none");
    EXPECT_EQ(metadata("a.exr", "bias"), "denoised");
    expect_words(run({"info", "a.png"}).out, "denoised");
    EXPECT_EQ(read_exr_channel(file("a.exr"), "denoise_error.V").size(), plain.pixels.size());
    const auto stats = nlohmann::json::parse(std::ifstream(file("a.json")));
    EXPECT_TRUE(stats["denoised"]["error"].is_null()) << "without replicates nothing is held out";
}

TEST_F(Denoising, DependsOnNothingElse)
{
    ASSERT_EQ(render({"-o", "one.exr", "-s", "8", "--denoise", "-t", "1"}).code, 0);
    ASSERT_EQ(render({"-o", "two.exr", "-s", "8", "--denoise", "-t", "5", "--tile", "5", "--batch", "7"}).code, 0);
    EXPECT_TRUE(same_pixels(image("one.exr"), image("two.exr")));
}

TEST_F(Denoising, OfASavedPictureIsThatOfTheRender)
{
    ASSERT_EQ(render({"-o", "now.exr", "-s", "7", "--denoise"}).code, 0);
    ASSERT_EQ(render({"-o", "noisy.exr", "-s", "7", "--aov", "denoise"}).code, 0);
    const Said said = run({"denoise", "noisy.exr", "-o", "later.exr", "-o", "later.png"});
    ASSERT_EQ(said.code, 0) << said.err;
    EXPECT_EQ(said.out, "later.exr\nlater.png\n");
    EXPECT_TRUE(same_pixels(image("now.exr"), image("later.exr")));
    EXPECT_EQ(metadata("noisy.exr", "bias"), "none");
    EXPECT_EQ(metadata("later.exr", "bias"), "denoised");
}

TEST_F(Denoising, TellsItsErrorBySamplesHeldOut)
{
    ASSERT_EQ(render({"-o", "a.exr", "-s", "16", "--replicates", "8", "--denoise", "--stats", "a.json"}).code, 0);
    const auto stats = nlohmann::json::parse(std::ifstream(file("a.json")));
    ASSERT_TRUE(stats["denoised"]["error"].is_number());
    EXPECT_LE(stats["denoised"]["interval"][0], stats["denoised"]["error"]);
    EXPECT_GE(stats["denoised"]["interval"][1], stats["denoised"]["error"]);
}

TEST_F(Denoising, StopsWhenTheDenoisedPictureIsGoodEnough)
{
    const Said said = run({"render", "scene.toml", "-o", "a.exr", "--size", "64x48", "--denoise", "--error", "0.01",
                           "--stats", "a.json"});
    ASSERT_EQ(said.code, 0) << said.err;
    expect_words(said.err, "--replicates 8, so that");
    expect_words(said.err, "stopped by --error at ");
    const auto stats = nlohmann::json::parse(std::ifstream(file("a.json")));
    EXPECT_LE(stats["denoised"]["error"], 0.01);
    ASSERT_EQ(run({"render", "scene.toml", "-o", "b.exr", "--size", "64x48", "--error", "0.01", "--replicates", "8",
                   "--stats", "b.json"})
                  .code,
              0);
    const std::string samples = std::to_string(stats["settings"]["spp"].get<int>());
    ASSERT_EQ(
        run({"render", "scene.toml", "-o", "same.exr", "--size", "64x48", "-s", samples, "--replicates", "8"}).code, 0);
    const auto noisy = read_exr_channel(file("a.exr"), "noisy.G"), same = read_exr_channel(file("same.exr"), "G");
    EXPECT_EQ(noisy, same) << "rendered with the replicates that hold samples out";
    const auto of_noisy = nlohmann::json::parse(std::ifstream(file("b.json")));
    EXPECT_LT(stats["samples"]["count"], of_noisy["samples"]["count"]) << "it needs fewer samples than the noisy one";
    const Said few = render({"-o", "c.exr", "--denoise", "--error", "0.05", "--replicates", "2"});
    EXPECT_EQ(few.code, 2);
    expect_words(few.err, "needs --replicates 4 or more");
}

TEST_F(Denoising, IsRefusedWhereItHasNoUse)
{
    const Said ao = render({"-o", "a.exr", "--denoise", "--integrator", "ao"});
    EXPECT_EQ(ao.code, 2);
    expect_words(ao.err, "works with the integrators path and direct");
    const Said one = render({"-o", "a.exr", "--denoise", "-s", "1"});
    EXPECT_EQ(one.code, 2);
    expect_words(one.err, "at least 2");
    ASSERT_EQ(render({"-o", "plain.exr"}).code, 0);
    const Said plain = run({"denoise", "plain.exr", "-o", "b.exr"});
    EXPECT_EQ(plain.code, 65);
    expect_words(plain.err, "render it with --aov denoise");
    EXPECT_EQ(run({"denoise", "plain.exr", "-o", "plain.exr"}).code, 65);
}

}  // namespace
}  // namespace lancer
