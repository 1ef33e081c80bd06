// What the program does without, as it tells and as the system sees it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/run_program.h"
#include "io/image_files.h"

namespace lancer {
namespace {

class Specialisation : public AppTest {
protected:
    // What is mapped into a render of the scene once it traces rays.
    std::string mapped_while_rendering(const std::string& scene)
    {
        Program program(folder_,
                        {"render", scene, "--size", "64x64", "-s", "1000000", "-o", "x.exr", "--verbose", "-t", "1"});
        EXPECT_TRUE(program.wait_for_message("unused features:")) << program.err();
        return read_bytes("/proc/" + std::to_string(program.pid()) + "/maps");
    }
};

TEST_F(Specialisation, OpenImageIoIsOpenedOnFirstNeed)
{
    write("grey.ppm", "P6 1 2 255\n\x10\x20\x30\x40\x50\x60");
    write("worn.toml", std::string(small_scene) +
                           "[[sphere]]\ncenter = [3, 1, 0]\nmaterial = \"m\"\n[material.m]\ntexture = "
                           "\"grey.ppm\"\n");
    write("grey.jpg", jpeg());
    write("jpeg.toml", std::string(small_scene) +
                           "[[sphere]]\ncenter = [3, 1, 0]\nmaterial = \"m\"\n[material.m]\ntexture = "
                           "\"grey.jpg\"\n");
    write("unused.toml", std::string(small_scene) + "[material.m]\ntexture = \"grey.ppm\"\n");
    const std::string without = mapped_while_rendering("scene.toml");
    expect_words(without, "embree");
    EXPECT_EQ(without.find("OpenImageIO"), std::string::npos);
    EXPECT_EQ(mapped_while_rendering("unused.toml").find("OpenImageIO"), std::string::npos);
    EXPECT_EQ(mapped_while_rendering("jpeg.toml").find("OpenImageIO"), std::string::npos);
    expect_words(mapped_while_rendering("worn.toml"), "OpenImageIO");
}

// Of a picture that nothing wears neither the bytes nor the name count: it may be gone.
TEST_F(Specialisation, PicturesThatNothingWearsAreNotOpened)
{
    const auto scene_hash = [&](const std::string& scene) {
        EXPECT_EQ(run({"render", scene, "--size", "8x8", "-s", "1", "-q", "-o", "x.exr"}).code, 0);
        return metadata("x.exr", "scene_hash");
    };
    write("a.ppm", "P6 1 1 255\n\x10\x20\x30");
    write("unused.toml", std::string(small_scene) + "[material.m]\ntexture = \"a.ppm\"\n");
    write("worn.toml", std::string(small_scene) +
                           "[[sphere]]\nmaterial = \"x\"\n[material.x]\ntype = \"mix\"\nfirst = "
                           "\"m\"\nsecond = \"m\"\n[material.m]\ntexture = "
                           "\"a.ppm\"\n");
    const std::string unused = scene_hash("unused.toml"), worn = scene_hash("worn.toml");
    write("a.ppm", "P6 1 1 255\n\x10\x20\x31");
    EXPECT_EQ(scene_hash("unused.toml"), unused);
    EXPECT_NE(scene_hash("worn.toml"), worn);
}

TEST_F(Specialisation, IsInTheStatistics)
{
    write("some.toml", std::string(small_scene) +
                           "[material.unused]\n[[light]]\ntype = \"point\"\nposition = [0, 5, 0]\nintensity = 0\n");
    const Said said =
        run({"render", "some.toml", "--size", "16x16", "-s", "1", "-o", "x.exr", "--verbose", "--stats", "x.json"});
    EXPECT_EQ(said.code, 0) << said.err;
    expect_words(said.err, "kernel 'wide'; unused features:\nlancer:   1 lights without power");
    const auto stats = nlohmann::json::parse(read_bytes(file("x.json")));
    EXPECT_EQ(stats["settings"]["kernel"], "wide");
    EXPECT_EQ(stats["samples"]["background_only"], 0) << "there is a plane";
    std::string all;
    for (const auto& l : stats["scene"]["unused_features"]) {
        all += l["what"].get<std::string>() + "\n";
        EXPECT_GT(l["count"], 0);
        EXPECT_GE(l["bytes"], 0);
        // What this run saves in time it has not measured.
        EXPECT_FALSE(l.contains("time")) << l;
        const auto what = l["what"].get<std::string>();
        const bool is_code = what.starts_with("OpenImageIO") || what == "general kernel";
        EXPECT_TRUE(!is_code || l["bytes"] == 0) << l;
    }
    EXPECT_EQ(said.err.find("1 general kernel;"), std::string::npos) << said.err;
    expect_words(all, "lights without power\n");
    expect_words(all, "unused materials\n");
    expect_words(all, "general kernel\n");
    expect_words(all, "OpenImageIO module, not loaded\n");
    write("amber.toml", std::string(small_scene) +
                            "[[sphere]]\ncenter = [0, 3, 0]\nradius = 1\nmaterial = \"amber\"\n"
                            "[material.amber]\ntype = \"glass\"\nabsorption = [0.1, 0.3, 0.8]\n");
    const Said amber = run({"render", "amber.toml", "--size", "16x16", "-s", "1", "-o", "m.exr", "--verbose"});
    expect_words(amber.err, "kernel 'all'; unused features:");
    EXPECT_EQ(amber.err.find("general kernel"), std::string::npos);
}

// Whatever AOVs are wanted, the kernel is the same, and the open sky is left out.
TEST_F(Specialisation, AovsTakeNothingBack)
{
    write("plain.toml", R"([camera]
position = [0, 0, 9]
target = [0, 0, 0]
[[light]]
type = "environment"
radiance = [1, 1, 1]
[[mesh]]
file = "quad.obj"
)");
    const auto render = [&](std::vector<std::string> aov) {
        aov.insert(aov.begin(), {"render", "plain.toml", "--size", "64x64", "-s", "4", "-o", "x.exr", "--verbose",
                                 "--stats", "x.json"});
        const Said said = run(aov);
        EXPECT_EQ(said.code, 0) << said.err;
        const auto stats = nlohmann::json::parse(read_bytes(file("x.json")));
        const auto kernel = stats["settings"]["kernel"].get<std::string>();
        expect_words(said.err, "kernel '" + kernel + "'; unused features:");
        EXPECT_EQ(said.err.find("1 general kernel\n") != std::string::npos, kernel != "all") << said.err;
        const bool leaves_out = stats["samples"]["background_only"] > 0;
        EXPECT_EQ(said.err.find("background only: ") != std::string::npos, leaves_out) << said.err;
        return kernel + (leaves_out ? " without sky" : "");
    };
    EXPECT_EQ(render({}), "wide without sky");
    EXPECT_EQ(render({"--aov", "variance,samples"}), "wide without sky");
    EXPECT_EQ(render({"--aov", "albedo,normal,mask"}), "wide without sky");
}

}  // namespace
}  // namespace lancer
