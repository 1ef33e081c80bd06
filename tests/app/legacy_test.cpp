// What --legacy changes besides the integrators: pixels, filters, 8 bits. And the pictures of the student's program,
// where they are at hand.
#include <gtest/gtest.h>

#include <cstdlib>

#include "app/run_program.h"
#include "io/image/png.h"
#include "io/image/read.h"

namespace lancer {
namespace {

class Legacy : public AppTest {
protected:
    std::string filter_of(std::vector<std::string> arguments) const
    {
        arguments.insert(arguments.end(), {"-o", "a.exr", "-q"});
        EXPECT_EQ(render(arguments).code, 0);
        return metadata("a.exr", "filter");
    }
    std::vector<uint8_t> bytes(const std::string& name) const { return read_raster(file(name))->bytes; }
};

TEST_F(Legacy, TakesTheFilterOfTheProgramUnlessOneIsNamed)
{
    EXPECT_EQ(filter_of({"--legacy"}), "narrow-gaussian");
    EXPECT_EQ(filter_of({"--legacy", "-s", "1"}), "centre");
    EXPECT_EQ(filter_of({"--legacy", "--filter", "box"}), "box");
    EXPECT_EQ(filter_of({"--set", "legacy=true"}), "narrow-gaussian");
    EXPECT_EQ(filter_of({"--filter", "centre"}), "centre");
    EXPECT_EQ(filter_of({}), "blackman-harris");
}

TEST_F(Legacy, IsSaidInTheHeaderAndChangesThePicture)
{
    EXPECT_EQ(render({"--legacy", "--filter", "box", "-o", "old.exr", "-q"}).code, 0);
    EXPECT_EQ(render({"--filter", "box", "-o", "new.exr", "-q"}).code, 0);
    EXPECT_EQ(metadata("old.exr", "bias"), "max_depth=5, legacy");
    EXPECT_EQ(metadata("new.exr", "bias"), "none");
    EXPECT_FALSE(same_pixels(image("old.exr"), image("new.exr")));
}

TEST_F(Legacy, ReplaysItsSamplesByTheOptionsThatItPrints)
{
    const Said said = render({"--legacy", "-v", "-o", "a.exr", "-s", "1"});
    expect_words(said.err, "--filter centre");
    expect_words(said.err, "--set legacy=true");
    const Said pixel =
        run({"pixel", "scene.toml", "12", "3", "0", "--size", "24x16", "--legacy", "--filter", "centre"});
    EXPECT_EQ(pixel.code, 0) << pixel.err;
    const Color c = image("a.exr").at(12, 3);
    EXPECT_FALSE(is_black(c));
    char text[64];
    std::snprintf(text, sizeof text, "radiance (%.9g, %.9g, %.9g)", static_cast<double>(c.r), static_cast<double>(c.g),
                  static_cast<double>(c.b));
    expect_words(pixel.out, text);
}

TEST_F(Legacy, TakesTheToneMapOfTheProgramUnlessOneIsNamed)
{
    const auto same_steps = [&](std::vector<std::string> a, std::vector<std::string> b) {
        for (auto* arguments : {&a, &b}) arguments->insert(arguments->end(), {"-q", "--legacy"});
        a.insert(a.end(), {"-o", "a.png"}), b.insert(b.end(), {"-o", "b.ppm"});
        EXPECT_EQ(render(a).code, 0);
        EXPECT_EQ(render(b).code, 0);
        return bytes("a.png") == bytes("b.ppm");
    };
    EXPECT_TRUE(same_steps({}, {"--tonemap", "gamma22"}));
    EXPECT_FALSE(same_steps({}, {"--tonemap", "srgb"}));
    EXPECT_TRUE(same_steps({"--tonemap", "srgb"}, {"--tonemap", "srgb", "--ascii-ppm"}));
}

TEST_F(Legacy, AsciiPpmIsText)
{
    EXPECT_EQ(render({"-o", "a.ppm", "--ascii-ppm", "-q"}).code, 0);
    EXPECT_EQ(render({"-o", "b.ppm", "-q"}).code, 0);
    EXPECT_TRUE(read_bytes(file("a.ppm")).starts_with("P3\n# lancer:software lancer "));
    EXPECT_TRUE(read_bytes(file("b.ppm")).starts_with("P6\n"));
    EXPECT_EQ(bytes("a.ppm"), bytes("b.ppm"));
}

TEST_F(Legacy, StepsAreComparedAsTheyStandInTheFiles)
{
    Image image = make_image(2, 1);
    image.at(0, 0) = {0.2f, 0.4f, 0.6f};
    write_png(file("a.png"), image, {}, {.tonemap = ToneMap::none});
    image.at(1, 0) = {2 / 255.f, 0, 0};
    write_png(file("b.png"), image, {}, {.tonemap = ToneMap::none});
    const Said said = run({"compare", "--steps", "a.png", "b.png", "--metric", "rmse", "--fail-above", "0.9"});
    EXPECT_EQ(said.code, 0) << said.err;
    expect_words(said.out, "mean                 25.5 51 76.5\n");
    expect_words(said.out, "reference_mean       26.5 51 76.5\n");
    expect_words(said.out, "beyond_one_step      1\n");
}

// Bit for bit the conventions of the program, to the one step that float costs.
TEST_F(Legacy, DrawsTheDirectLightOfTheProgram)
{
    const char* const shared = std::getenv("LANCER_SHARED");
    const std::string theirs = std::string(shared ? shared : LANCER_SOURCE_DIR "/../shared") + "/seeds/noeffects.png";
    if (!std::filesystem::exists(theirs)) GTEST_SKIP() << "no " << theirs;
    const Said said =
        run({"render", LANCER_SOURCE_DIR "/scenes/seed-b/noeffects.toml", "--legacy", "-q", "-o", "a.png"});
    ASSERT_EQ(said.code, 0) << said.err;
    const std::vector<uint8_t> ours = bytes("a.png"), reference = read_raster(theirs)->bytes;
    ASSERT_EQ(ours.size(), reference.size());
    size_t wrong = 0;
    for (size_t i = 0; i < ours.size(); ++i) wrong += std::abs(ours[i] - reference[i]) > 1;
    EXPECT_LT(wrong, ours.size() / 1000);
}

}  // namespace
}  // namespace lancer
