// What the program knows of the pictures of a background.
#include <gtest/gtest.h>

#include "app/run_program.h"

namespace lancer {
namespace {

using BackgroundPictures = AppTest;

TEST_F(BackgroundPictures, AreReadToldOfSparedAndHashed)
{
    ASSERT_EQ(render({"-o", "sky.png", "-o", "ground.exr"}).code, 0);
    write("sky.toml",
          "[[sphere]]\n[background]\nglow = true\nsky = {file = \"sky.png\", projection = \"equisolid\"}\n"
          "ground = {file = \"ground.exr\", projection = \"planar\"}\n");
    const Said told = run({"info", "sky.toml"});
    EXPECT_EQ(told.code, 0) << told.err;
    expect_words(told.out, "background    sky: picture 24x16, ground: picture 24x16, glow of lights\n");
    const std::vector<std::string> small{"--size", "8x8", "-s", "1", "-q", "-o"};
    const auto render_sky = [&](const std::string& output) {
        std::vector<std::string> arguments{"render", "sky.toml"};
        arguments.insert(arguments.end(), small.begin(), small.end());
        arguments.push_back(output);
        return run(arguments);
    };
    EXPECT_EQ(render_sky("a.exr").code, 0);
    for (const char* input : {"sky.png", "ground.exr"}) {
        const Said said = render_sky(input);
        EXPECT_EQ(said.code, 2);
        expect_words(said.err, "would overwrite the input '" + std::string(input) + "'");
    }
    ASSERT_EQ(render({"-o", "ground.exr", "--seed", "3"}).code, 0);
    EXPECT_EQ(render_sky("b.exr").code, 0);
    EXPECT_NE(metadata("a.exr", "scene_hash"), metadata("b.exr", "scene_hash"));
    write("sky.png", "broken");
    const Said checked = run({"check", "sky.toml"});
    EXPECT_EQ(checked.code, 65);
    expect_words(checked.out, "sky.toml:4:7: error: background not read: ");
}

TEST_F(BackgroundPictures, ABareMeshUnderABackgroundGetsNoOtherLight)
{
    write("bare.obj", "v 0 0 0\nv 2 0 0\nv 2 3 0\nf 1 2 3\n");
    const Said lit = run({"render", "bare.obj", "-s", "1", "--size", "8x8", "-o", "a.exr"});
    expect_words(lit.err, "type = \"environment\"");
    const Said said =
        run({"render", "bare.obj", "-s", "1", "--size", "8x8", "-o", "b.exr", "-D", "background.sky=dawn"});
    EXPECT_EQ(said.code, 0) << said.err;
    EXPECT_EQ(said.err.find("environment"), std::string::npos) << said.err;
}

}  // namespace
}  // namespace lancer
