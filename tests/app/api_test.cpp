// The library for C: the bits of the program, clear failures, nothing printed.
#include "app/api/lancer.h"

#include <gtest/gtest.h>

#include <memory>

#include "app/run_program.h"

namespace lancer {
namespace {

struct FreeScene {
    void operator()(lancer_scene* s) const { lancer_scene_free(s); }
};
using SceneHandle = std::unique_ptr<lancer_scene, FreeScene>;

constexpr const char* room =
    "[camera]\nposition = [0.4, 0.5, 4]\ntarget = [0.3, 0.3, 0]\n[render]\nspp = 20\nsize = [24, 16]\n"
    "[[light]]\ntype = \"environment\"\nradiance = [0.5, 0.6, 0.9]\n[material.red]\ntype = \"plastic\"\n"
    "base_color = [0.8, 0.1, 0.1]\nroughness = 0.3\n[[sphere]]\ncenter = [1.2, 0.4, 0]\nradius = 0.4\nmaterial = "
    "\"red\"\n";
constexpr const char* triangle = "[[mesh]]\nfile = \"t.obj\"\nmaterial = \"red\"\n";

class Api : public AppTest {
protected:
    Api()
    {
        write("room.toml", room);
        write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        write("both.toml", std::string(room) + triangle);
    }
    SceneHandle open(const std::string& name) const { return SceneHandle(lancer_scene_open(file(name).c_str())); }
    // The layer of a scene of 24 x 16 pixels; its code in `code`.
    static std::vector<float> layer_of(lancer_scene* scene, const char* name, int& code, unsigned threads = 0)
    {
        std::vector<float> values(24 * 16 * lancer_layer_channels(name), -7);
        const lancer_layer layer{name, values.data(), values.size()};
        code = lancer_scene_render(scene, &layer, 1, threads, nullptr, nullptr);
        return values;
    }
    static std::vector<float> color_of(lancer_scene* scene)
    {
        int code = -1;
        std::vector<float> color = layer_of(scene, "color", code);
        EXPECT_EQ(code, LANCER_OK) << lancer_error();
        return color;
    }
    std::vector<float> color_of_program(const std::string& name)
    {
        const Said said = run({"render", name, "-q", "-o", "program.exr"});
        EXPECT_EQ(said.code, 0) << said.err;
        std::vector<float> color;
        for (const Color& c : image("program.exr").pixels) color.insert(color.end(), {c.r, c.g, c.b});
        return color;
    }
};

TEST_F(Api, HasTheBitsOfTheProgram)
{
    EXPECT_EQ(color_of(open("both.toml").get()), color_of_program("both.toml"));
    const SceneHandle scene = open("both.toml");
    int code = -1;
    EXPECT_EQ(layer_of(scene.get(), "color", code, 1), layer_of(scene.get(), "color", code, 2)) << "threads";
    const std::string text = std::string(room) + triangle;
    const SceneHandle in_memory(lancer_scene_from_text(text.c_str(), file("").c_str()));
    EXPECT_EQ(color_of(in_memory.get()), color_of_program("both.toml"));
}

TEST_F(Api, MeshesInMemoryHaveTheBitsOfMeshFiles)
{
    const double positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const uint32_t indices[] = {0, 1, 2};
    const SceneHandle scene = open("room.toml");
    const lancer_mesh mesh{.name = nullptr,
                           .material = "red",
                           .positions = positions,
                           .vertices = 3,
                           .triangles = indices,
                           .triangle_count = 1,
                           .normals = nullptr,
                           .uvs = nullptr};
    const std::vector<float> without = color_of(scene.get());
    ASSERT_EQ(lancer_scene_add_mesh(scene.get(), &mesh), LANCER_OK) << lancer_error();
    EXPECT_EQ(color_of(scene.get()), color_of_program("both.toml"));
    EXPECT_NE(color_of(scene.get()), without);
}

TEST_F(Api, DefinitionsAreThoseOfTheProgram)
{
    const SceneHandle scene = open("both.toml");
    ASSERT_EQ(lancer_scene_define(scene.get(), "render.size=[30, 20]"), LANCER_OK);
    uint32_t width = 0, height = 0;
    ASSERT_EQ(lancer_scene_size(scene.get(), &width, &height), LANCER_OK);
    EXPECT_EQ(width, 30u);
    EXPECT_EQ(height, 20u);
    EXPECT_EQ(lancer_scene_define(scene.get(), "nonsense"), LANCER_OK) << "said when the scene is read";
    EXPECT_NE(lancer_scene_size(scene.get(), &width, &height), LANCER_OK);
    EXPECT_NE(std::string(lancer_error()).find("nonsense"), std::string::npos) << lancer_error();
}

TEST_F(Api, LayersAreThoseOfTheFile)
{
    ASSERT_EQ(run({"render", "both.toml", "-q", "--aov", "depth,albedo", "-o", "program.exr"}).code, 0);
    const SceneHandle scene = open("both.toml");
    int code = -1;
    const std::vector<float> depth = layer_of(scene.get(), "depth", code);
    ASSERT_EQ(code, LANCER_OK) << lancer_error();
    EXPECT_EQ(depth.size(), size_t{24} * 16);
    EXPECT_TRUE(std::any_of(depth.begin(), depth.end(), [](float z) { return z > 3 && z < 5; }));
    EXPECT_EQ(layer_of(scene.get(), "albedo", code).size(), size_t{24} * 16 * 3);
    EXPECT_EQ(lancer_layer_channels("albedo"), 3u);
    EXPECT_EQ(lancer_layer_channels("uv"), 2u);
    EXPECT_EQ(lancer_layer_channels("nothing"), 0u);
    EXPECT_EQ(lancer_layer_channels(nullptr), 0u);
}

TEST_F(Api, FailuresHaveTheCodesOfTheProgramAndSayWhy)
{
    write("bad.toml", "[camera]\npositon = [0, 0, 1]\n");
    int code = 0;
    layer_of(open("bad.toml").get(), "color", code);
    EXPECT_EQ(code, LANCER_INVALID_INPUT);
    EXPECT_NE(std::string(lancer_error()).find("bad.toml:2:1: error: unknown key 'positon'"), std::string::npos)
        << lancer_error();
    layer_of(open("none.toml").get(), "color", code);
    EXPECT_EQ(code, LANCER_MISSING_INPUT);
    const SceneHandle scene = open("room.toml");
    std::vector<float> values(5, 3);
    lancer_layer layer{"color", values.data(), values.size()};
    EXPECT_EQ(lancer_scene_render(scene.get(), &layer, 1, 0, nullptr, nullptr), LANCER_USAGE);
    EXPECT_NE(std::string(lancer_error()).find("needs room for 1152 numbers, not 5"), std::string::npos);
    layer.name = "colour";
    EXPECT_EQ(lancer_scene_render(scene.get(), &layer, 1, 0, nullptr, nullptr), LANCER_USAGE);
    EXPECT_EQ(values, std::vector<float>(5, 3)) << "untouched";
    EXPECT_EQ(lancer_scene_define(nullptr, "a=1"), LANCER_USAGE);
    EXPECT_EQ(lancer_scene_size(nullptr, nullptr, nullptr), LANCER_USAGE);
    lancer_scene_free(nullptr);
}

TEST_F(Api, MeshesThatAreBrokenAreRefused)
{
    const double positions[] = {0, 0, 0, 1, 0, 0, 0, 1, NAN};
    const uint32_t indices[] = {0, 1, 3};
    const SceneHandle scene = open("room.toml");
    lancer_mesh mesh{nullptr, nullptr, positions, 3, indices, 1, nullptr, nullptr};
    EXPECT_EQ(lancer_scene_add_mesh(scene.get(), &mesh), LANCER_USAGE);
    EXPECT_NE(std::string(lancer_error()).find("vertex 2 of a mesh is not finite"), std::string::npos);
    mesh.vertices = 2;
    EXPECT_EQ(lancer_scene_add_mesh(scene.get(), &mesh), LANCER_USAGE);
    EXPECT_NE(std::string(lancer_error()).find("triangle 0 of a mesh has a vertex"), std::string::npos);
    mesh.triangles = nullptr;
    EXPECT_EQ(lancer_scene_add_mesh(scene.get(), &mesh), LANCER_USAGE);
    color_of(scene.get());
}

TEST_F(Api, ProgressIsToldAndMayCancel)
{
    const SceneHandle scene = open("both.toml");
    std::vector<float> values(24 * 16 * 3, -7);
    const lancer_layer layer{"color", values.data(), values.size()};
    double last = 0;
    const auto note = [](void* user, double done) {
        *static_cast<double*>(user) = done;
        return 0;
    };
    EXPECT_EQ(lancer_scene_render(scene.get(), &layer, 1, 0, note, &last), LANCER_OK);
    EXPECT_GT(last, 0.5);
    std::fill(values.begin(), values.end(), -7.0f);
    const auto cancel = [](void*, double) { return 1; };
    EXPECT_EQ(lancer_scene_render(scene.get(), &layer, 1, 0, cancel, nullptr), LANCER_CANCELLED);
    EXPECT_EQ(values, std::vector<float>(values.size(), -7));
    EXPECT_EQ(color_of(scene.get()), color_of_program("both.toml")) << "and goes on afterwards";
}

TEST_F(Api, WarningsAreKeptAndNothingIsPrinted)
{
    write("w.toml", std::string(room) + "[material.idle]\ntype = \"lambert\"\n");
    const SceneHandle scene = open("w.toml");
    EXPECT_STREQ(lancer_scene_warnings(scene.get()), "");
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    color_of(scene.get());
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_NE(std::string(lancer_scene_warnings(scene.get())).find("'idle' is not used"), std::string::npos);
}

TEST_F(Api, TellsItsVersion)
{
    EXPECT_EQ(lancer_api_version(), LANCER_API_VERSION);
    EXPECT_NE(run({"--version"}).out.find(std::string("lancer ") + lancer_version()), std::string::npos);
}

}  // namespace
}  // namespace lancer
