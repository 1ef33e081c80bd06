// lancer export: what it writes of each kind of thing, and what it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "app/run_program.h"

namespace lancer {
namespace {

using Json = nlohmann::json;

class Export : public AppTest {
protected:
    Json exported(const std::string& scene, std::vector<std::string> more = {})
    {
        write("s.toml", scene);
        more.insert(more.begin(), {"export", "s.toml", "-o", "out"});
        const Said said = run(more);
        EXPECT_EQ(said.code, 0) << said.err;
        EXPECT_EQ(said.out, "");
        return Json::parse(read_bytes(file("out/scene.json")));
    }
    // Expects that the scene is refused, with these words, and that nothing is written.
    void expect_refused(const std::string& scene, const std::string& words)
    {
        write("bad.toml", scene);
        const Said said = run({"export", "bad.toml", "-o", "bad"});
        EXPECT_EQ(said.code, 65) << scene;
        expect_words(said.err, words);
        EXPECT_FALSE(exists("bad")) << scene;
    }

    static constexpr const char* lit = "version = 1\n[[light]]\ntype = \"environment\"\nradiance = 1\n";
};

TEST_F(Export, SaysTheViewAndEveryLight)
{
    const Json j = exported(
        "version = 1\n[render]\nmax_depth = 5\nsize = [40, 30]\nfilter = \"box\"\nintegrator = \"whitted\"\n[camera]\n"
        "position = [1, 2, 3]\ntarget = [0, 1, 0]\nup = [0, 0, 1]\nfov = 33\n[[sphere]]\n"
        "[[light]]\ntype = \"point\"\nposition = [1, 2, 4]\nintensity = [3, 2, 1]\n"
        "[[light]]\ntype = \"directional\"\ndirection = [0, -2, 0]\nirradiance = 2\n"
        "[[light]]\ntype = \"sphere\"\ncenter = [0, 9, 0]\nradius = 0.25\nradiance = 8\n"
        "[[light]]\ntype = \"environment\"\nradiance = 0.25\n[[light]]\ntype = \"environment\"\nradiance = 0.5\n");
    EXPECT_EQ(j["schema"], "lancer.scene/2");
    EXPECT_EQ(j["size"], (Json{40, 30}));
    EXPECT_EQ(j["max_depth"], 5);
    EXPECT_EQ(j["integrator"], "whitted");
    EXPECT_EQ(j["filter"], "box");
    EXPECT_EQ(
        j["camera"],
        (Json{
            {"type", "pinhole"}, {"position", {1, 2, 3}}, {"target", {0, 1, 0}}, {"up", {0, 0, 1}}, {"fov_deg", 33}}));
    ASSERT_EQ(j["lights"].size(), 4u);
    EXPECT_EQ(j["lights"][0], (Json{{"type", "point"}, {"position", {1, 2, 4}}, {"intensity", {3, 2, 1}}}));
    EXPECT_EQ(j["lights"][1], (Json{{"type", "directional"}, {"direction", {0, -1, 0}}, {"irradiance", {2, 2, 2}}}));
    EXPECT_EQ(j["lights"][2],
              (Json{{"type", "sphere"}, {"center", {0, 9, 0}}, {"radius", 0.25}, {"radiance", {8, 8, 8}}}));
    EXPECT_EQ(j["lights"][3], (Json{{"type", "environment"}, {"radiance", {0.75, 0.75, 0.75}}}));
}

TEST_F(Export, TheCommandLineIsOverTheScene)
{
    const Json j =
        exported(std::string(lit) + "[[sphere]]\n", {"--size", "8x4", "--max-depth", "3", "-D", "camera.fov=20"});
    EXPECT_EQ(j["size"], (Json{8, 4}));
    EXPECT_EQ(j["max_depth"], 3);
    EXPECT_EQ(j["camera"]["fov_deg"], 20);
}

TEST_F(Export, ShapesNameTheirMaterialsByPlace)
{
    const Json j = exported(std::string(lit) +
                            "[camera]\naperture = 0.5\nfocus = 3\ntype = \"thin_lens\"\n"
                            "[[sphere]]\ncenter = [1, 0, 0]\nradius = 2\nmaterial = \"g\"\n"
                            "[[plane]]\npoint = [0, -1, 0]\nnormal = [0, 4, 0]\nmaterial = \"m\"\n"
                            "[material.g]\ntype = \"glass\"\nior = 1.25\n[material.m]\ntype = \"mirror\"\nbase_color = "
                            "0.5\nemission = [0, 2, 0]\n");
    EXPECT_EQ(j["camera"]["type"], "thin_lens");
    EXPECT_EQ(j["camera"]["aperture"], 0.5);
    EXPECT_EQ(j["camera"]["focus"], 3);
    ASSERT_EQ(j["spheres"].size(), 1u);
    EXPECT_EQ(j["spheres"][0]["center"], (Json{1, 0, 0}));
    EXPECT_EQ(j["spheres"][0]["radius"], 2);
    const Json glass = j["materials"][j["spheres"][0]["material"].get<size_t>()];
    EXPECT_EQ(glass["name"], "g");
    EXPECT_EQ(glass["type"], "glass");
    EXPECT_EQ(glass["ior"], 1.25);
    EXPECT_FALSE(glass.contains("emission"));
    EXPECT_EQ(j["planes"][0]["normal"], (Json{0, 1, 0}));
    EXPECT_EQ(j["planes"][0]["uv"], (Json{{"origin", {0, 0, 0}}, {"u", {1, 0, 0}}, {"v", {0, 0, -1}}}));
    const Json mirror = j["materials"][j["planes"][0]["material"].get<size_t>()];
    EXPECT_EQ(mirror["type"], "mirror");
    EXPECT_EQ(mirror["base_color"], (Json{0.5, 0.5, 0.5}));
    EXPECT_EQ(mirror["emission"], (Json{0, 2, 0}));
    EXPECT_EQ(mirror["emission_both_sides"], false);
}

// Two materials of the file, one of them overridden; polygons cut into triangles; a place for each instance.
TEST_F(Export, MeshesBecomePlainTriangles)
{
    write("two.mtl", "newmtl a\nKd 0.25 0.5 0.75\nnewmtl b\nKd 1 1 1\n");
    write("two.obj",
          "mtllib two.mtl\nv 0.1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nusemtl a\nf 1 2 3 4\nusemtl b\nf 1//1 2//1 "
          "3//1\n");
    const Json j = exported(std::string(lit) +
                            "[[mesh]]\nname = \"two\"\nfile = \"two.obj\"\nscale = [1, 2, 1]\n[[instance]]\nmesh = "
                            "\"two\"\ntranslate = [5, 0, 0]\n[[instance]]\nmesh = \"two\"\nrotate = [0, 0, 90]\n"
                            "[[mesh]]\nfile = \"quad.obj\"\ntranslate = [0, 0, 7]\n"
                            "[[material_override]]\nmatch = \"b\"\ntype = \"mirror\"\n");
    ASSERT_EQ(j["meshes"].size(), 2u);
    EXPECT_EQ(j["meshes"][0]["file"], "mesh_0.obj");
    EXPECT_EQ(j["meshes"][0]["transforms"],
              (Json{{{1, 0, 0, 5}, {0, 2, 0, 0}, {0, 0, 1, 0}}, {{0, -2, 0, 0}, {1, 0, 0, 0}, {0, 0, 1, 0}}}));
    EXPECT_EQ(j["meshes"][1]["transforms"], (Json{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 7}}}));
    EXPECT_EQ(read_bytes(file("out/mesh_0.obj")),
              "v 0.1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nusemtl m0\nf 1 2 3\nf 1 3 4\nusemtl m1\nf 1//1 2//1 "
              "3//1\n");
    EXPECT_EQ(j["materials"][0]["name"], "a");
    EXPECT_EQ(j["materials"][0]["base_color"], (Json{0.25, 0.5, 0.75}));
    EXPECT_EQ(j["materials"][1]["type"], "mirror");
}

// What is read again is the very same scene, so the picture is the same, bit for bit.
TEST_F(Export, WhatIsWrittenRendersTheSame)
{
    write("s.toml", std::string(lit) + "[camera]\nposition = [0.3, 0.4, 3]\n[[mesh]]\nfile = \"quad.obj\"\n");
    ASSERT_EQ(run({"export", "s.toml", "-o", "out"}).code, 0);
    write("again.toml", std::string(lit) + "[camera]\nposition = [0.3, 0.4, 3]\n[[mesh]]\nfile = \"out/mesh_0.obj\"\n");
    for (const char* name : {"s", "again"})
        ASSERT_EQ(run({"render", std::string(name) + ".toml", "-o", std::string(name) + ".exr", "--size", "16x12", "-s",
                       "2", "-q"})
                      .code,
                  0);
    EXPECT_TRUE(same_pixels(image("s.exr"), image("again.exr")));
}

// Corners run so that the side of the normals is the front, whichever way the file had them.
TEST_F(Export, NormalsSayWhichSideIsTheFront)
{
    write("turned.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 -1\nf 1//1 2//1 3//1\n");
    exported(std::string(lit) + "[[mesh]]\nfile = \"turned.obj\"\n");
    expect_words(read_bytes(file("out/mesh_0.obj")), "f 1//1 3//1 2//1\n");
}

TEST_F(Export, MeshesHaveTextureCoordinatesWhereTheyAreRead)
{
    write("uv.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 2 0\nvt 0 0.5\nf 1/1 2/2 3/3\nf 2 4 3\n");
    const std::string mesh = "[[mesh]]\nfile = \"uv.obj\"\nmaterial = \"x\"\n[material.x]\n";
    exported(std::string(lit) + mesh);
    EXPECT_EQ(read_bytes(file("out/mesh_0.obj")).find("vt"), std::string::npos);
    exported(std::string(lit) + mesh + "texture = { type = \"checker\" }\n");
    expect_words(read_bytes(file("out/mesh_0.obj")), "vt 0 0\nvt 2 0\nvt 0 0.5\nusemtl m0\nf 1/1 2/2 3/3\nf 2 4 3\n");
}

// A picture's numbers are those that the renderer computes with.
TEST_F(Export, TexturesAreWrittenAsLinearNumbers)
{
    Image picture = make_image(2, 2);
    picture.pixels = {{0.25f, 0.5f, 1}, {0, 0.125f, 0}, {1, 1, 1}, {0.5f, 2, 0.75f}};
    write_exr(file("p.exr"), picture);
    const Json j = exported(std::string(lit) +
                            "[[sphere]]\nmaterial = \"x\"\n[material.x]\ntype = \"plastic\"\nbase_color = "
                            "0.5\ntexture = \"p\"\nroughness = 0.25\nroughness_texture = \"q\"\n[texture.p]\nfile = "
                            "\"p.exr\"\nscale = [2, 3]\noffset = 0.5\n[texture.q]\nfile = \"p.exr\"\nchannel = "
                            "\"g\"\ngain = 0.5\nbias = 0.25\nwrap = \"clamp\"\n");
    const Json& x = j["materials"][0];
    EXPECT_EQ(x["type"], "plastic");
    EXPECT_EQ(x["base_color"], (Json{0.5, 0.5, 0.5}));
    EXPECT_EQ(x["roughness"], 0.25);
    const Json &color = j["textures"][x["texture"].get<size_t>()],
               &number = j["textures"][x["roughness_texture"].get<size_t>()];
    EXPECT_EQ(color["type"], "image");
    EXPECT_EQ(color["wrap"], "repeat");
    EXPECT_EQ(color["scale"], (Json{2, 3}));
    EXPECT_EQ(color["offset"], (Json{0.5, 0.5}));
    EXPECT_EQ(number["wrap"], "clamp");
    EXPECT_TRUE(same_pixels(image("out/" + color["file"].get<std::string>()), picture));
    Image numbers = make_image(2, 2);
    numbers.pixels = {{0.5f, 0.5f, 0.5f}, {0.3125f, 0.3125f, 0.3125f}, {0.75f, 0.75f, 0.75f}, {1.25f, 1.25f, 1.25f}};
    EXPECT_TRUE(same_pixels(image("out/" + number["file"].get<std::string>()), numbers));
}

TEST_F(Export, TranslucentSheetsHaveTwoColours)
{
    const Json j = exported(std::string(lit) +
                            "[[sphere]]\nmaterial = \"x\"\n[material.x]\ntype = \"translucent\"\nbase_color = 0.5\n"
                            "transmittance = [0.25, 0.5, 0.125]\ntransmittance_texture = { type = \"checker\" }\n");
    const Json& x = j["materials"][0];
    EXPECT_EQ(x["type"], "translucent");
    EXPECT_EQ(x["base_color"], (Json{0.5, 0.5, 0.5}));
    EXPECT_EQ(x["transmittance"], (Json{0.25, 0.5, 0.125}));
    EXPECT_EQ(j["textures"][x["transmittance_texture"].get<size_t>()]["type"], "checker");
}

TEST_F(Export, TexturesByFormulaAreSaid)
{
    const Json j = exported(std::string(lit) +
                            "[[sphere]]\nmaterial = \"x\"\n[material.x]\ntexture = { type = \"checker\", odd = 0.25, "
                            "scale = 4 }\nopacity_texture = { type = \"grid\", width = 0.5 }\nemission = 2\n"
                            "[[triangle]]\na = [0, 1, 0]\nb = [1, 1, 0]\nc = [0, 0, 0]\nband_width = "
                            "0.25\nband_material = \"x\"\n");
    const Json& x = j["materials"][0];
    EXPECT_EQ(j["textures"][x["texture"].get<size_t>()], (Json{{"type", "checker"},
                                                               {"scale", {4, 4}},
                                                               {"offset", {0, 0}},
                                                               {"even", {1, 1, 1}},
                                                               {"odd", {0.25, 0.25, 0.25}}}));
    EXPECT_EQ(x["opacity"], 1);
    const Json& holes = j["textures"][x["opacity_texture"].get<size_t>()];
    EXPECT_EQ(holes["type"], "grid");
    EXPECT_EQ(holes["width"], 0.5);
    EXPECT_EQ(x["emission"], (Json{2, 2, 2}));
    const auto banded =
        std::find_if(j["materials"].begin(), j["materials"].end(), [](const Json& m) { return m["type"] == "mix"; });
    ASSERT_NE(banded, j["materials"].end());
    EXPECT_EQ(j["materials"][(*banded)["second"].get<size_t>()]["name"], "x");
    EXPECT_EQ(j["textures"][(*banded)["weight_texture"].get<size_t>()]["type"], "rim");
}

TEST_F(Export, MaterialsSayAllTheirParameters)
{
    const Json j = exported(
        std::string(lit) +
        "[[sphere]]\nmaterial = \"metal\"\n[[sphere]]\nmaterial = \"index\"\n[[sphere]]\nmaterial = \"pane\"\n"
        "[[sphere]]\nmaterial = \"both\"\n[[sphere]]\nmaterial = \"veil\"\n[material.metal]\ntype = "
        "\"metal\"\nbase_color = 0.5\nroughness = 0.75\n[material.index]\ntype = \"metal\"\neta = [0.25, 0.5, 1]\nk = "
        "2\n[material.pane]\ntype = \"glass\"\nthin = true\nroughness = 0.5\n[material.both]\ntype = \"mix\"\nfirst "
        "= \"metal\"\nsecond = \"veil\"\nweight = 0.25\n[material.veil]\nopacity = 0.5\n");
    std::map<std::string, Json> by_name;
    for (const Json& m : j["materials"]) by_name[m["name"].get<std::string>()] = m;
    EXPECT_EQ(by_name["metal"],
              (Json{{"name", "metal"}, {"type", "metal"}, {"base_color", {0.5, 0.5, 0.5}}, {"roughness", 0.75}}));
    EXPECT_EQ(by_name["index"]["eta"], (Json{0.25, 0.5, 1}));
    EXPECT_EQ(by_name["index"]["k"], (Json{2, 2, 2}));
    EXPECT_EQ(by_name["pane"]["thin"], true);
    EXPECT_EQ(by_name["pane"]["roughness"], 0.5);
    EXPECT_EQ(by_name["both"]["type"], "mix");
    EXPECT_EQ(by_name["both"]["weight"], 0.25);
    EXPECT_EQ(j["materials"][by_name["both"]["first"].get<size_t>()]["name"], "metal");
    EXPECT_EQ(by_name["veil"]["opacity"], 0.5);
}

// A slope of 45 degrees along u in heights that rise to the right, by texels.
TEST_F(Export, BumpsAreWrittenAsNormals)
{
    Image heights = make_image(4, 1);
    heights.pixels = {{0, 0, 0}, {0.25f, 0.25f, 0.25f}, {0.5f, 0.5f, 0.5f}, {0.75f, 0.75f, 0.75f}};
    write_exr(file("h.exr"), heights);
    const Json j = exported(std::string(lit) +
                            "[[sphere]]\nmaterial = \"x\"\n[material.x]\nbump_texture = { file = \"h.exr\", wrap = "
                            "\"clamp\", scale = 2 }\nbump_scale = 4\n");
    const Json& bumps = j["materials"][0]["bumps"];
    EXPECT_EQ(bumps["wrap"], "clamp");
    EXPECT_EQ(bumps["scale"], (Json{2, 2}));
    const Image normals = image("out/" + bumps["file"].get<std::string>());
    ASSERT_EQ(normals.pixels.size(), 4u);
    const float half = std::sqrt(0.5f);
    EXPECT_NEAR(normals.at(1, 0).r, 0.5f - 0.5f * half, 1e-3f);
    EXPECT_NEAR(normals.at(1, 0).g, 0.5f, 1e-3f);
    EXPECT_NEAR(normals.at(1, 0).b, 0.5f + 0.5f * half, 1e-3f);
}

// Of a coat without roughness: what Fresnel's equations leave.
TEST_F(Export, TheCoatOfPlasticIsATable)
{
    const Json j = exported(std::string(lit) + "[[sphere]]\nmaterial = \"x\"\n[material.x]\ntype = \"plastic\"\n");
    const Image coat = image("out/" + j["materials"][0]["coat"].get<std::string>());
    EXPECT_EQ(coat.data.height(), 1);
    EXPECT_FLOAT_EQ(coat.at(coat.data.width() - 1, 0).r, 0.96f);
    EXPECT_FLOAT_EQ(coat.at(0, 0).r, 0);
}

// A sheet that is hardly rough does what a smooth one does; of a rough one both sides together are as bright.
TEST_F(Export, ARoughSheetIsATableToo)
{
    const auto left = [this](const std::string& roughness, int row) {
        const Json j = exported(std::string(lit) +
                                "[[sphere]]\nmaterial = \"x\"\n[material.x]\ntype = \"glass\"\nthin = "
                                "true\nbase_color = 0.5\nroughness = " +
                                roughness + "\n");
        const Image sheet = image("out/" + j["materials"][0]["sheet"].get<std::string>());
        return sheet.at(sheet.data.width() - 1, row).r;
    };
    EXPECT_NEAR(left("0.02", 0), 1, 1e-3f);
    EXPECT_NEAR(left("0.02", 1), 1, 1e-3f);
    const float reflected = 2 * 0.04f / 1.04f, through = left("1", 0);  // of a smooth sheet, seen from above
    EXPECT_GT(std::abs(through - 1), 1e-3f);
    EXPECT_NEAR((1 - reflected) * through + reflected * left("1", 1), 1, 0.01f);
}

TEST_F(Export, TheEnvironmentIsAPictureOfRadiance)
{
    Image sky = make_image(2, 1);
    sky.pixels = {{1, 2, 3}, {0.5f, 0, 0}};
    write_exr(file("sky.exr"), sky);
    const Json j = exported(
        "version = 1\n[[sphere]]\n[[light]]\ntype = \"environment\"\nfile = \"sky.exr\"\nscale = "
        "[2, 1, 1]\nrotate = [0, 90, 0]\n[[light]]\ntype = \"environment\"\nradiance = 0.5\n");
    ASSERT_EQ(j["lights"].size(), 1u);
    EXPECT_EQ(j["lights"][0]["to_world"], (Json{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}));
    const Image written = image("out/" + j["lights"][0]["file"].get<std::string>());
    EXPECT_EQ(written.at(0, 0), (Color{2.5f, 2.5f, 3.5f}));
    EXPECT_EQ(written.at(1, 0), (Color{1.5f, 0.5f, 0.5f}));
}

TEST_F(Export, RefusesWhatItHasNoWordsFor)
{
    const std::string ball = std::string(lit) + "[[sphere]]\nmaterial = \"x\"\n[material.x]\n";
    const std::string rest = ", which an exported scene cannot say";
    expect_refused(ball + "bump_texture = { type = \"waves\", waves = [[1, 0, 1, 0]] }\n",
                   "material 'x' has waves" + rest);
    expect_refused(ball + "type = \"glass\"\nabsorption = 1\n", "a material absorbs, scatters or has a priority, or there is fog" + rest);
    expect_refused(std::string(lit) + "[[sphere]]\nmaterial = \"bronze\"\n", "material 'bronze' is of type interface");
    expect_refused("version = 1\n[background]\nsky = \"noon\"\n[[sphere]]\n",
                   "bad.toml:2:1: error: the background is not one colour" + rest);
    expect_refused(std::string(lit) + "[[sphere]]\n[render]\nindirect = false\n", "indirect is off" + rest);
    expect_refused(std::string(lit) +
                       "[[sphere]]\n[animation]\nframes = [0, 4]\nshutter = 1\n[[animation.track]]\n"
                       "key = \"sphere.0.radius\"\nframes = [0, 4]\nvalues = [1, 2]\n",
                   "something moves while the shutter is open (-D animation.shutter=0 closes it)" + rest);
    write("colours.obj", "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 1 1 0 1 0 0\nf 1 2 3\n");
    expect_refused(std::string(lit) + "[[mesh]]\nfile = \"colours.obj\"\n",
                   "bad.toml:5:1: error: a mesh has colours of its vertices" + rest);
}

TEST_F(Export, Errors)
{
    EXPECT_EQ(run({"export", "scene.toml"}).code, 2);
    EXPECT_EQ(run({"export", "none.toml", "-o", "out"}).code, 66);
    EXPECT_EQ(run({"export", "scene.toml", "-o", "quad.obj/out"}).code, 1);
    // A mesh that would be written over itself.
    write("mesh_0.obj", quad);
    write("self.toml", std::string(lit) + "[[mesh]]\nfile = \"mesh_0.obj\"\n");
    const Said said = run({"export", "self.toml", "-o", "."});
    EXPECT_EQ(said.code, 2);
    expect_words(said.err, "would overwrite an input");
    EXPECT_EQ(read_bytes(file("mesh_0.obj")), quad);
}

}  // namespace
}  // namespace lancer
