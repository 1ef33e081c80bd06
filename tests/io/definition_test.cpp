// Values of scene files that the command line gives.
#include "io/scene/definition.h"

#include <gtest/gtest.h>

#include "core/hash.h"
#include "scene_test_support.h"

namespace lancer {
namespace {

class Definitions : public SceneFileTest {
protected:
    SceneDescription with(const std::vector<std::string>& definitions, const std::string& text)
    {
        options_.definitions = definitions;
        return scene(text);
    }
    std::string problems_with(const std::string& definition, const std::string& text)
    {
        options_.definitions = {definition};
        return problems(text);
    }
};

TEST_F(Definitions, ReplaceWhatTheFileSays)
{
    const SceneDescription s =
        with({"camera.fov=35", "camera.position = [1, 2, 3]", "light.1.radiance=[1,2,3]",
              "material.\"my.glass\".ior=1.3", "camera.target.1=7"},
             "[camera]\nfov = 20\ntarget = [0, 0, 1]\n[[light]]\ntype = \"environment\"\nradiance = 9\n[[light]]\ntype "
             "= \"environment\"\nradiance = 9\n[material.\"my.glass\"]\ntype = \"glass\"");
    EXPECT_EQ(s.camera->fov_deg, 35);
    EXPECT_EQ(s.camera->position, (Vec3d{1, 2, 3}));
    EXPECT_EQ(s.camera->target, (Vec3d{0, 7, 1}));
    EXPECT_EQ(s.lights.at(0).power, (Color{9, 9, 9}));
    EXPECT_EQ(s.lights.at(1).power, (Color{1, 2, 3}));
    EXPECT_EQ(s.materials.at(0).ior, 1.3f);
}

TEST_F(Definitions, MakeWhatIsMissing)
{
    write("x.obj", "");
    const SceneDescription s =
        with({"mesh.0.file=\"x.obj\"", "mesh.0.scale=2", "light.0.type=environment", "light.0.radiance=3",
              "material.0.type=mirror", "render.spp=16", "light.1={type=\"point\", position=[1,1,1], intensity=1}"},
             "version = 1");
    EXPECT_EQ(loaded_, (std::vector<std::string>{"x.obj"}));
    EXPECT_EQ(s.meshes.at(0).transform.scale, (Vec3d{2, 2, 2}));
    EXPECT_EQ(s.lights.at(0).power, (Color{3, 3, 3}));
    EXPECT_EQ(s.lights.at(1).type, LightType::point);
    EXPECT_EQ(s.materials.at(0).name, "0");
    EXPECT_EQ(s.render.spp, 16u);
}

TEST_F(Definitions, AWordThatIsNoTomlIsAString)
{
    EXPECT_EQ(with({"render.integrator=direct"}, "version = 1").render.integrator, IntegratorKind::direct);
    EXPECT_EQ(with({"render.integrator=\"direct\""}, "version = 1").render.integrator, IntegratorKind::direct);
    const std::string problem = problems_with("render.integrator=a=b\n[x]", "version = 1");
    EXPECT_NE(problem.find("unknown integrator 'a=b?[x]' in [render]"), std::string::npos) << problem;
}

// They come from the headers of pictures, too. Tables are freed one within the other.
TEST_F(Definitions, AKeyOfVeryManyPartsIsRefused)
{
    std::string key = "a";
    for (int i = 0; i < 200000; ++i) key += ".a";
    try {
        problems_with(key + "=1", "version = 1");
        ADD_FAILURE() << "not refused";
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::usage);
        EXPECT_NE(std::string(e.what()).find("has a key with more than 9 parts"), std::string::npos) << e.what();
    }
}

TEST_F(Definitions, TheLastOfEqualsCounts)
{
    EXPECT_EQ(with({"render.spp=1", "render.spp=2"}, "[render]\nspp = 3").render.spp, 2u);
}

TEST_F(Definitions, MistakesAreNamedAsInTheFileWithTheirPlace)
{
    EXPECT_EQ(problems_with("camera.fvo=35", "version = 1"),
              "-D camera.fvo=35: error: unknown key 'fvo' in [camera]; did you mean 'fov'? known: type, position, "
              "target, up, fov, aperture, focus, inside");
    EXPECT_EQ(problems_with("camera.fov=350", "[camera]"),
              "-D camera.fov=350: error: 'fov' in [camera] must be greater than 0 and less than 180, not 350");
    EXPECT_EQ(problems_with("camera.fov.x=1", "[camera]\nfov = 3"),
              "-D camera.fov.x=1: error: 'camera.fov' is neither a table nor a list, so it has no 'x'");
    EXPECT_EQ(problems_with("sphere.2.radius=1", "[[sphere]]"),
              "-D sphere.2.radius=1: error: 'sphere' has no entry '2': they count from 0, and the next one would be 1");
    EXPECT_EQ(problems_with("sphere.radius=1", "[[sphere]]"),
              "-D sphere.radius=1: error: 'sphere' is a list: a number must follow, not 'radius'");
}

TEST_F(Definitions, BelongToTheHash)
{
    const std::string text = "[camera]";
    const uint64_t plain = scene(text).content_hash;
    const uint64_t one = with({"camera.fov=35"}, text).content_hash;
    EXPECT_NE(plain, one);
    EXPECT_NE(one, with({"camera.fov=36"}, text).content_hash);
}

TEST_F(Definitions, AMeshFileIsASceneByItself)
{
    write("dir/q.obj", "");
    options_.definitions = {"camera.fov=35", "mesh.0.scale=3"};
    Diagnostics diagnostics;
    const SceneDescription s = wrap_mesh(path("dir/q.obj"), options_, diagnostics);
    EXPECT_EQ(errors(diagnostics), "");
    EXPECT_EQ(loaded_, (std::vector<std::string>{"dir/q.obj"}));
    EXPECT_EQ(s.file, path("dir/q.obj"));
    EXPECT_EQ(s.camera.value().fov_deg, 35);
    EXPECT_EQ(s.meshes.at(0).transform.scale, (Vec3d{3, 3, 3}));
}

TEST(ParseDefinition, RefusesWhatIsNoKeyAndValue)
{
    for (const char* text : {"", "=", "a", "a=", "=1", "a..b=1", ".a=1", "a.=1", "a.\"b=1", "x\"y\"=1"})
        EXPECT_THROW(parse_definition(text), Error) << text;
    EXPECT_EQ(parse_definition("a.\"b.c\".'d=e'.0=f=g").path, (std::vector<std::string>{"a", "b.c", "d=e", "0"}));
    EXPECT_EQ(parse_definition("a=f=g").value, "f=g");
}

}  // namespace
}  // namespace lancer
