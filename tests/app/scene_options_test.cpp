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
    EXPECT_EQ(render_as("scene.toml", "b.exr", {"--set", "multiscatter=true,terminator=true"}).code, 0);
    EXPECT_EQ(metadata("b.exr", "bias"), "multiscatter, terminator");
    write("on.toml", std::string(small_scene) + "[render]\nmultiscatter = true\n");
    EXPECT_EQ(render_as("on.toml", "c.exr").code, 0);
    EXPECT_EQ(metadata("c.exr", "bias"), "multiscatter");
    EXPECT_EQ(render_as("on.toml", "d.exr", {"--set", "multiscatter=false"}).code, 0);
    EXPECT_EQ(metadata("d.exr", "bias"), "none");
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
