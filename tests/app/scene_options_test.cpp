// What the command line can say of a scene: its camera, values over those of the file, switches.
#include <gtest/gtest.h>

#include "app/run_program.h"

namespace lancer {
namespace {

class SceneOptions : public AppTest {
protected:
    SceneOptions()
    {
        write("cameras.toml", std::string(small_scene) + "[camera.low]\nposition = [0, 0.2, 4]\n");
        write("low.toml",
              std::string(small_scene).replace(std::string(small_scene).find("[0, 1, 5]"), 9, "[0, 0.2, 4]"));
    }
    Said render_as(const std::string& scene, const std::string& output, std::vector<std::string> more = {}) const
    {
        more.insert(more.begin(), {"render", scene, "--size", "16x12", "-s", "2", "-q", "-o", output});
        return run(more);
    }
};

TEST_F(SceneOptions, CameraPicksANamedOne)
{
    EXPECT_EQ(render_as("low.toml", "low.exr").code, 0);
    EXPECT_EQ(render_as("cameras.toml", "named.exr", {"--camera", "low"}).code, 0);
    EXPECT_EQ(render_as("cameras.toml", "usual.exr").code, 0);
    EXPECT_TRUE(same_pixels(image("low.exr"), image("named.exr")));
    EXPECT_FALSE(same_pixels(image("low.exr"), image("usual.exr")));
    EXPECT_NE(metadata("named.exr", "settings_hash"), metadata("usual.exr", "settings_hash"));
    const Said wrong = render_as("cameras.toml", "x.exr", {"--camera", "lo"});
    EXPECT_EQ(wrong.code, 2);
    expect_words(wrong.err, "--camera: unknown camera 'lo'; did you mean 'low'? known: low");
    EXPECT_EQ(render_as("scene.toml", "x.exr", {"--camera", "low"}).code, 2);
}

TEST_F(SceneOptions, DefinitionsAreAsGoodAsTheFile)
{
    EXPECT_EQ(render_as("low.toml", "low.exr").code, 0);
    EXPECT_EQ(render_as("scene.toml", "said.exr", {"-D", "camera.position=[0, 0.2, 4]"}).code, 0);
    EXPECT_EQ(render_as("scene.toml", "usual.exr").code, 0);
    EXPECT_TRUE(same_pixels(image("low.exr"), image("said.exr")));
    EXPECT_FALSE(same_pixels(image("usual.exr"), image("said.exr")));
    EXPECT_NE(metadata("said.exr", "scene_hash"), metadata("usual.exr", "scene_hash"));
    const Said typo = render_as("scene.toml", "x.exr", {"-D", "camera.fvo=35"});
    EXPECT_EQ(typo.code, 65);
    expect_words(typo.err, "-D camera.fvo=35: error: unknown key 'fvo' in [camera]; did you mean 'fov'?");
    EXPECT_EQ(render_as("scene.toml", "x.exr", {"-D", "camera.fov"}).code, 2);
}

TEST_F(SceneOptions, SmoothIsAsGoodAsTheKeyOfTheMesh)
{
    write("bent.obj", "v -1 0 0\nv 0 0 0.3\nv 0 1 0.3\nv -1 1 0\nv 1 0 0\nv 1 1 0\nf 1 2 3 4\nf 2 5 6 3\n");
    const std::string scene =
        "[camera]\nposition = [0, 0.5, 3]\ntarget = [0, 0.5, 0]\n[[light]]\ntype = \"point\"\nposition = [2, 1, 3]\n"
        "intensity = 9\n[[mesh]]\nfile = \"bent.obj\"\n";
    write("bent.toml", scene);
    write("smooth.toml", scene + "smooth = 40\n");
    write("edge.toml", scene + "smooth = 20\n");
    EXPECT_EQ(render_as("bent.toml", "flat.exr").code, 0);
    EXPECT_EQ(render_as("smooth.toml", "key.exr").code, 0);
    EXPECT_EQ(render_as("edge.toml", "edge.exr").code, 0);
    EXPECT_EQ(render_as("bent.toml", "said.exr", {"--smooth", "40"}).code, 0);
    EXPECT_EQ(render_as("edge.toml", "kept.exr", {"--smooth", "40"}).code, 0);
    EXPECT_TRUE(same_pixels(image("key.exr"), image("said.exr")));
    EXPECT_FALSE(same_pixels(image("key.exr"), image("flat.exr")));
    EXPECT_TRUE(same_pixels(image("edge.exr"), image("kept.exr")));  // the mesh says it itself
    EXPECT_NE(metadata("said.exr", "scene_hash"), metadata("flat.exr", "scene_hash"));
    const Said wrong = render_as("bent.toml", "x.exr", {"--smooth", "no"});
    EXPECT_EQ(wrong.code, 2);
    expect_words(wrong.err, "--smooth: 'no' is not 'off' or an angle from 0 to 180");
    write("wrong.toml", scene + "smooth = \"of\"\n");
    expect_words(render_as("wrong.toml", "x.exr").err, "unknown smooth 'of' in [[mesh]]; did you mean 'off'?");
}

TEST_F(SceneOptions, DefinitionsSuitABareMesh)
{
    write("quad.toml",
          "[[mesh]]\nfile = \"quad.obj\"\nmaterial = \"m\"\n[material.m]\nbase_color = 0.25\n[[light]]\ntype = "
          "\"environment\"\nradiance = 1\n");
    EXPECT_EQ(render_as("quad.toml", "file.exr").code, 0);
    EXPECT_EQ(render_as("quad.obj", "said.exr",
                        {"-D", "mesh.0.material=m", "-D", "material.m.base_color=0.25", "-D",
                         "light.0={type=\"environment\", radiance=1}"})
                  .code,
              0);
    EXPECT_TRUE(same_pixels(image("file.exr"), image("said.exr")));
}

TEST_F(SceneOptions, AMeshBehindALinkIsStillRendered)
{
    TempFolder other;
    write_bytes(other.file("q.obj"), quad);
    std::filesystem::create_symlink(other.file("q.obj"), file("link.obj"));
    EXPECT_EQ(render_as("link.obj", "link.exr").code, 0);
    EXPECT_EQ(run({"render", "none.obj", "-o", "x.exr"}).code, 66);
}

TEST_F(SceneOptions, SwitchesStandInTheLedger)
{
    EXPECT_EQ(render_as("scene.toml", "a.exr").code, 0);
    EXPECT_EQ(metadata("a.exr", "bias"), "none");
    EXPECT_EQ(render_as("scene.toml", "b.exr", {"--set", "multiscatter=false,terminator=true,compact=true"}).code, 0);
    EXPECT_EQ(metadata("b.exr", "bias"), "no_multiscatter, terminator, compact");
    write("on.toml", std::string(small_scene) + "[render]\nmultiscatter = false\n");
    EXPECT_EQ(render_as("on.toml", "c.exr").code, 0);
    EXPECT_EQ(metadata("c.exr", "bias"), "no_multiscatter");
    EXPECT_EQ(render_as("on.toml", "d.exr", {"--set", "multiscatter=true"}).code, 0);
    EXPECT_EQ(metadata("d.exr", "bias"), "none");
}

TEST_F(SceneOptions, PartsOfTheLightStandInTheLedger)
{
    const std::string all = "direct=false,indirect=false,emitters=false,fresnel=false,soft_shadows=false";
    EXPECT_EQ(render_as("scene.toml", "a.exr", {"--set", all}).code, 0);
    EXPECT_EQ(metadata("a.exr", "bias"), "no_direct, no_indirect, no_emitters, no_fresnel, no_soft_shadows");
    for (const Color c : image("a.exr").pixels) EXPECT_EQ(c, Color{});
}

// Pixels that end early are done, not missing; and what decides it stands with the settings.
TEST_F(SceneOptions, PixelsThatEndEarlyAreComplete)
{
    const auto render = [&](const std::string& scene, const std::string& output, std::vector<std::string> more) {
        more.insert(more.end(), {"--aov", "samples", "--stats", "s.json"});
        more.insert(more.begin(), {"-s", "400"});
        const Said said = render_as(scene, output, more);
        EXPECT_EQ(said.code, 0) << said.err;
        EXPECT_EQ(metadata(output, "partial"), "0");
        EXPECT_EQ(metadata(output, "spp_done"), "400");
        EXPECT_EQ(metadata(output, "bias"), "none");
        double sum = 0;
        for (const float n : read_exr_channel(file(output), "samples.N")) {
            EXPECT_GE(n, 16);
            EXPECT_LE(n, 400);
            sum += static_cast<double>(n);
        }
        const std::string said_sum = "\"count\": " + std::to_string(std::llround(sum));
        expect_words(read_bytes(file("s.json")), said_sum);
        return sum / static_cast<double>(image(output).pixels.size());
    };
    EXPECT_EQ(render("scene.toml", "all.exr", {}), 400);
    const double fine = render("scene.toml", "fine.exr", {"--set", "stop=true"});
    const double coarse = render("scene.toml", "coarse.exr", {"--set", "stop=true", "--stop-error", "0.5"});
    EXPECT_LT(fine, 400);
    EXPECT_LT(coarse, 0.5 * fine);
    EXPECT_NE(metadata("fine.exr", "settings_hash"), metadata("coarse.exr", "settings_hash"));
    write("stop.toml", std::string(small_scene) + "[render]\nstop = true\nstop_error = 0.5\n");
    render("stop.toml", "same.exr", {});
    EXPECT_TRUE(same_pixels(image("coarse.exr"), image("same.exr")));
    EXPECT_EQ(metadata("coarse.exr", "settings_hash"), metadata("same.exr", "settings_hash"));
    EXPECT_EQ(render_as("scene.toml", "x.exr", {"--stop-error", "0"}).code, 2);
}

TEST_F(SceneOptions, PicturesOfTheSceneAreSparedAndHashed)
{
    write("t.exr", "not a picture");
    write("textured.toml",
          std::string(small_scene) + "[[sphere]]\nmaterial = \"m\"\n[material.m]\ntexture = \"t.exr\"\n");
    const Said said = render_as("textured.toml", "t.exr");
    EXPECT_EQ(said.code, 2);
    expect_words(said.err, "would overwrite the input");
    EXPECT_EQ(render_as("textured.toml", "a.exr").code, 0);
    EXPECT_EQ(render_as("textured.toml", "x.exr", {"--strict"}).code, 65) << "a picture that cannot be read";
    write("t.exr", "not a picture either");
    EXPECT_EQ(render_as("textured.toml", "b.exr").code, 0);
    EXPECT_NE(metadata("a.exr", "scene_hash"), metadata("b.exr", "scene_hash"));
}

}  // namespace
}  // namespace lancer
