// --write-scene: what is written renders the same bits as what was given.
#include <gtest/gtest.h>

#include "app/run_program.h"

namespace lancer {
namespace {

const char* const block =
    "v 0 0 0\nv 2 0 0\nv 2 0 1\nv 0 0 1\nv 0 3 0\nv 2 3 0\nv 2 3 1\nv 0 3 1\n"
    "f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";

class WriteScene : public AppTest {
protected:
    WriteScene() { write("block.obj", block); }

    Said render_as(const std::string& scene, const std::string& name, std::vector<std::string> more = {}) const
    {
        more.insert(more.begin(), {"render", scene, "-o", name + ".exr", "-o", name + ".ppm"});
        return run(more);
    }
    // That the scene with these options, and what it is written as, have the same pixels, in EXR and in PPM.
    void expect_same(const std::string& scene, const std::vector<std::string>& options)
    {
        std::vector<std::string> all = options;
        all.insert(all.end(), {"--write-scene", "written.toml"});
        const Said first = render_as(scene, "first", all);
        ASSERT_EQ(first.code, 0) << first.err;
        expect_words(first.out, "written.toml");
        const Said second = render_as("written.toml", "second", {"--strict"});
        ASSERT_EQ(second.code, 0) << second.err << read_bytes(file("written.toml"));
        EXPECT_TRUE(same_pixels(image("first.exr"), image("second.exr"))) << read_bytes(file("written.toml"));
        EXPECT_EQ(pixels_of(file("first.ppm")), pixels_of(file("second.ppm"))) << read_bytes(file("written.toml"));
        EXPECT_EQ(second.err.find("added to the scene"), std::string::npos) << second.err;
    }
    // The comments of a PPM tell of the run.
    static std::string pixels_of(const std::string& path)
    {
        const std::string bytes = read_bytes(path);
        return bytes.substr(bytes.size() - 32 * 24 * 3);
    }
    static std::vector<std::string> small(std::vector<std::string> more = {})
    {
        more.insert(more.begin(), {"--size", "32x24", "-s", "4"});
        return more;
    }
};

TEST_F(WriteScene, BareMeshes)
{
    expect_same("block.obj", small());
    expect_words(read_bytes(file("written.toml")), "exposure = \"auto\"");
    expect_same("block.obj", small({"--view", "-40,25", "--up", "z", "--no-ground"}));
    expect_same("block.obj", small({"--exposure", "0.7", "--tonemap", "agx", "--seed", "5", "--max-depth", "3"}));
    expect_same("block.obj", small({"--set", "multiscatter=false", "--filter", "box"}));
    expect_same("block.obj", small({"--smooth", "100"}));
    expect_words(read_bytes(file("written.toml")), "smooth = 100");
    expect_same("block.obj", small({"--smooth", "off"}));
    expect_same("block.obj", small({"-D", "camera.fov=25", "-D", "mesh.0.material=m", "-D",
                                    "material.m={type=\"metal\", base_color=[0.9, 0.1234567, 0.2]}"}));
}

TEST_F(WriteScene, SceneFiles)
{
    expect_same("scene.toml", small());
    write("partial.toml",
          "[[mesh]]\nfile = \"block.obj\"\nmaterial = \"a \\\"b\\\"\"\n[material.\"a \\\"b\\\"\"]\nbase_color = 0.5\n"
          "[camera]\nfov = 30\ntype = \"thin_lens\"\naperture = 0.1\n[output]\nexposure = 1\n"
          "[[light]]\ntype = \"environment\"\nradiance = 1\n");
    expect_same("partial.toml", small());
    write("named.toml", std::string(small_scene) +
                            "[camera.low]\nposition = [0, 0.2, 4]\n[camera.wide]\nfov = 90\n[render]\nseed = 3\n");
    expect_same("named.toml", small({"--camera", "low"}));
    // The other cameras see what they saw before.
    EXPECT_EQ(render_as("named.toml", "wide", small({"--camera", "wide"})).code, 0);
    EXPECT_EQ(render_as("written.toml", "still", {"--camera", "wide"}).code, 0);
    EXPECT_TRUE(same_pixels(image("wide.exr"), image("still.exr")));
}

TEST_F(WriteScene, ElsewhereWithAnAssetRoot)
{
    std::filesystem::create_directory(file("other"));
    const Said said = render_as("block.obj", "first", small({"--write-scene", "other/s.toml"}));
    ASSERT_EQ(said.code, 0) << said.err;
    expect_words(said.err, "to render other/s.toml, add --asset-root ");
    const std::string root = std::filesystem::canonical(file("other")).parent_path();
    expect_words(said.err, root);
    EXPECT_EQ(render_as("other/s.toml", "second").code, 66);
    EXPECT_EQ(render_as("other/s.toml", "second", {"--asset-root", root}).code, 0);
    EXPECT_TRUE(same_pixels(image("first.exr"), image("second.exr")));
}

TEST_F(WriteScene, WithAnEnvironmentOfAnotherFolder)
{
    for (const char* folder : {"meshes", "sky", "other"}) std::filesystem::create_directory(file(folder));
    write("meshes/b.obj", block);
    EXPECT_EQ(render_as("block.obj", "sky/e", small()).code, 0);
    const Said said =
        render_as("meshes/b.obj", "first", small({"--env", "sky/e.exr", "--write-scene", "other/s.toml"}));
    ASSERT_EQ(said.code, 0) << said.err;
    const std::string root = std::filesystem::canonical(file("other")).parent_path();
    expect_words(said.err, "add --asset-root " + root);
    const Said second = render_as("other/s.toml", "second", {"--asset-root", root});
    ASSERT_EQ(second.code, 0) << second.err;
    EXPECT_TRUE(same_pixels(image("first.exr"), image("second.exr"))) << read_bytes(file("other/s.toml"));
}

TEST_F(WriteScene, SparesInputs)
{
    expect_words(render_as("block.obj", "x", {"--write-scene", "s.obj"}).err, "must end in .toml");
    write("same.toml", small_scene);
    const Said said = render_as("same.toml", "x", small({"--write-scene", "same.toml"}));
    EXPECT_EQ(said.code, 2);
    expect_words(said.err, "--write-scene: 'same.toml' would overwrite the input");
    EXPECT_EQ(read_bytes(file("same.toml")), small_scene);
    EXPECT_EQ(render_as("block.obj", "x", {"--write-scene", "none/s.toml"}).code, 1);
}

TEST_F(WriteScene, OutputIsATableOfScenes)
{
    write("bright.toml", std::string(small_scene) + "[output]\nexposure = 1.5\ntonemap = \"agx\"\n");
    EXPECT_EQ(render_as("bright.toml", "said", small()).code, 0);
    EXPECT_EQ(render_as("scene.toml", "given", small({"--exposure", "1.5", "--tonemap", "agx"})).code, 0);
    EXPECT_EQ(render_as("scene.toml", "usual", small()).code, 0);
    EXPECT_EQ(pixels_of(file("said.ppm")), pixels_of(file("given.ppm")));
    EXPECT_NE(pixels_of(file("said.ppm")), pixels_of(file("usual.ppm")));
    EXPECT_TRUE(same_pixels(image("said.exr"), image("usual.exr"))) << "EXR holds the light";
    // The command line comes first.
    EXPECT_EQ(render_as("bright.toml", "over", small({"--exposure", "0", "--tonemap", "srgb"})).code, 0);
    EXPECT_EQ(pixels_of(file("over.ppm")), pixels_of(file("usual.ppm")));
    EXPECT_EQ(render_as("scene.toml", "defined", small({"-D", "output.exposure=1.5", "-D", "output.tonemap=agx"})).code,
              0);
    EXPECT_EQ(pixels_of(file("defined.ppm")), pixels_of(file("given.ppm")));
    EXPECT_EQ(render_as("scene.toml", "filtered", small({"--denoise"})).code, 0);
    EXPECT_EQ(render_as("scene.toml", "asked", small({"-D", "output.denoise=true", "--write-scene", "w.toml"})).code, 0);
    EXPECT_TRUE(same_pixels(image("filtered.exr"), image("asked.exr")));
    EXPECT_FALSE(same_pixels(image("usual.exr"), image("asked.exr")));
    EXPECT_EQ(render_as("w.toml", "written", {}).code, 0);
    EXPECT_TRUE(same_pixels(image("filtered.exr"), image("written.exr")));
    EXPECT_EQ(render_as("w.toml", "not", {"-D", "output.denoise=false"}).code, 0);
    EXPECT_TRUE(same_pixels(image("usual.exr"), image("not.exr")));
    const auto mistake = [&](const std::string& definition) {
        const Said said = render_as("scene.toml", "x", {"-D", definition});
        EXPECT_EQ(said.code, 65);
        return said.err;
    };
    expect_words(mistake("output.exposre=1"), "unknown key 'exposre' in [output]; did you mean 'exposure'?");
    expect_words(mistake("output.exposure=aut"), "did you mean 'auto'?");
    expect_words(mistake("output.exposure=65"), "'exposure' in [output]");
    expect_words(mistake("output.tonemap=srg"), "did you mean 'srgb'?");
}

}  // namespace
}  // namespace lancer
