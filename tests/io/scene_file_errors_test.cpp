// What a wrong scene file is told: the message and the place of every kind of mistake.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "scene_test_support.h"

namespace lancer {
namespace {

struct Mistake {
    const char* text;
    const char* message;  // without "s.toml:"
};

class SceneMistakes : public SceneFileTest {
protected:
    void check(const std::vector<Mistake>& mistakes)
    {
        write("a.obj", "");
        for (const auto& [text, message] : mistakes)
            EXPECT_EQ(problems(text), "s.toml:" + std::string(message)) << text;
    }
};

TEST_F(SceneMistakes, UnknownKeys)
{
    check(
        {{"[camera]\n  positon = [0, 0, 1]",
          "2:3: error: unknown key 'positon' in [camera]; did you mean 'position'? known: type, position, target, up, "
          "fov, aperture, focus, inside"},
         {"[render]\nthreads = 3",
          "2:1: error: unknown key 'threads' in [render]; known: size, spp, seed, integrator, max_depth, sampler, "
          "filter, accel, isa, nee, mis, direct, indirect, emitters, fresnel, soft_shadows, straight_shadows, "
          "always_nee, mis_compensation, learned_nee and 12 more"},
         {"[[mesh]]\nfile = \"a.obj\"\nscal = 2",
          "3:1: error: unknown key 'scal' in [[mesh]]; did you mean 'scale'? known: name, file, material, "
          "vertex_colors, smooth, catmull_clark, subdivision_edge, subdivision_level, translate, rotate, scale"},
         {"[[sphere]]\ncentre = [0, 0, 0]",
          "2:1: error: unknown key 'centre' in [[sphere]]; did you mean 'center'? known: center, radius, material"},
         {"[[plane]]\npiont = [0, 0, 0]",
          "2:1: error: unknown key 'piont' in [[plane]]; did you mean 'point'? known: point, normal, u, v, material, "
          "band_material, "
          "band_width"},
         {"[material.a]\nalbedo = 1",
          "2:1: error: unknown key 'albedo' in [material.a]; known: preset, type, base_color, texture, "
          "transmittance, transmittance_texture, roughness, roughness_texture, metallic, metallic_texture, ior, thin, "
          "absorption, priority, scattering, scattering_anisotropy, subsurface_color, subsurface_radius, eta, k and 53 "
          "more"},
         {"[[light]]\ntype = \"environment\"\nradiance = 1\nradience = 1",
          "4:1: error: unknown key 'radience' in [[light]]; did you mean 'radiance'? known: type, position, "
          "intensity, direction, irradiance, inner_angle, outer_angle, center, radius, radiance, file, scale, rotate, "
          "group"},
         {"[[mesh]]\nfile = \"a.obj\"\nname = \"a\"\n[[instance]]\nmesh = \"a\"\nname = \"b\"",
          "6:1: error: unknown key 'name' in [[instance]]; known: mesh, translate, rotate, scale"},
         {"verson = 1",
          "1:1: error: unknown key 'verson' at the top level; did you mean 'version'? known: version, render, camera, "
          "mesh, instance, sphere, plane, water, bubble, triangle, pyramid, light, background, fog, material, "
          "material_override, texture, output, animation"},
         {"\n [rendr]",
          "2:3: error: unknown table 'rendr' at the top level; did you mean 'render'? known: version, render, camera, "
          "mesh, instance, sphere, plane, water, bubble, triangle, pyramid, light, background, fog, material, "
          "material_override, texture, output, animation"},
         {"[[spheres]]",
          "1:3: error: unknown table 'spheres' at the top level; did you mean 'sphere'? known: version, render, "
          "camera, mesh, instance, sphere, plane, water, bubble, triangle, pyramid, light, background, fog, material, "
          "material_override, texture, output, animation"}});
}

TEST_F(SceneMistakes, LightsAndCameras)
{
    write("sky.hdr", "");
    check(
        {{"[[light]]\ntype = \"directional\"\ndirection = [0, 0, 0]\nirradiance = 1",
          "3:13: error: 'direction' in [[light]] must not be the zero vector"},
         {"[[light]]\ntype = \"spot\"\nposition = [0, 0, 0]\nintensity = 1\ndirection = [0, 0, 1]\ninner_angle = 30\n"
          "outer_angle = 30",
          "7:15: error: 'outer_angle' in [[light]] must be greater than 'inner_angle'"},
         {"[[light]]\ntype = \"spot\"\nposition = [0, 0, 0]\nintensity = 1\ndirection = [0, 0, 1]\ninner_angle = 3\n"
          "outer_angle = 91",
          "7:15: error: 'outer_angle' in [[light]] must be from 0 to 90, not 91"},
         {"[[light]]\ntype = \"directional\"\ndirection = [0, 0, 1]",
          "1:1: error: [[light]] of type 'directional' needs 'irradiance'"},
         {"[[light]]\ntype = \"environment\"", "1:1: error: [[light]] of type 'environment' needs 'radiance'"},
         {"[[light]]\ntype = \"environment\"\nfile = \"sky.hdr\"\nradiance = 1",
          "4:12: error: 'radiance' in [[light]] cannot stand beside 'file'; 'scale' is a factor on a picture"},
         {"[[light]]\ntype = \"environment\"\nradiance = 1\nrotate = [0, 1, 0]",
          "4:10: error: 'rotate' in [[light]] needs 'file'"},
         {"[[light]]\ntype = \"environment\"\nfile = \"sly.hdr\"", "3:8: error: picture 'sly.hdr' does not exist"},
         {"[[light]]\ntype = \"point\"\nposition = [0, 0, 0]\nintensity = 1\nfile = \"sky.hdr\"",
          "5:8: error: 'file' in [[light]] needs type 'environment', not 'point'"},
         {"[camera]\nfov = 30\n[camera.close]\nfvo = 3",
          "4:1: error: unknown key 'fvo' in [camera.close]; did you mean 'fov'? known: type, position, target, up, "
          "fov, aperture, focus, inside"},
         {"[camera.close]\nposition = [0, 0, 5]\ntarget = [0, 0, 5]",
          "3:10: error: 'position' and 'target' in [camera.close] must be different points"},
         {"[render]\nterminator = 1", "2:14: error: 'terminator' in [render] must be true or false, not an integer"}});
}

TEST_F(SceneMistakes, WrongKindOfTable)
{
    check({{"[[camera]]", "1:1: error: 'camera' at the top level must be one table, written [camera], not an array"},
           {"render = 3", "1:10: error: 'render' at the top level must be one table, written [render], not an integer"},
           {"[sphere]",
            "1:1: error: 'sphere' at the top level must be a list of tables, each written [[sphere]], not a table"},
           {"light = [1]", "1:10: error: [[light]] must be a table, not an integer"},
           {"[material]\ntype = \"glass\"",
            "2:1: error: 'type' in [material] must be a table, written [material.NAME], not a string"},
           {"material = true",
            "1:12: error: 'material' at the top level must be tables, each written [material.NAME], not a boolean"},
           {"[material.\"\"]", "1:11: error: [material.NAME] needs a name that is not empty"}});
}

TEST_F(SceneMistakes, WrongKindOfValue)
{
    check({{"version = 1.0", "1:11: error: 'version' at the top level must be an integer, not a float"},
           {"[render]\nintegrator = 1", "2:14: error: 'integrator' in [render] must be a string, not an integer"},
           {"[render]\nfilter = \"\"", "2:10: error: 'filter' in [render] must not be empty"},
           {"[render]\nsampler = [\"sobol\"]", "2:11: error: 'sampler' in [render] must be a string, not an array"},
           {"[render]\nstop_error = true", "2:14: error: 'stop_error' in [render] must be a number, not a boolean"},
           {"[render]\nspp = 64.5", "2:7: error: 'spp' in [render] must be an integer, not a float"},
           {"[render]\nspp = \"64\"", "2:7: error: 'spp' in [render] must be an integer, not a string"},
           {"[render]\nsize = 640",
            "2:8: error: 'size' in [render] must be two integers, width and height, not an integer"},
           {"[render]\nsize = [640, 480, 3]",
            "2:8: error: 'size' in [render] must be two integers, width and height, not 3"},
           {"[render]\nsize = [640, 480.0]", "2:14: error: 'size' in [render] must be an integer, not a float"},
           {"[camera]\nfov = true", "2:7: error: 'fov' in [camera] must be a number, not a boolean"},
           {"[camera]\nfov = 2020-01-02", "2:7: error: 'fov' in [camera] must be a number, not a date or time"},
           {"[camera]\nposition = 3", "2:12: error: 'position' in [camera] must be three numbers, not an integer"},
           {"[camera]\nposition = [1, 2]", "2:12: error: 'position' in [camera] must be three numbers, not 2"},
           {"[camera]\nposition = [1, \"2\", 3]", "2:16: error: 'position' in [camera] must be a number, not a string"},
           {"[camera]\nup = 1", "2:6: error: 'up' in [camera] must be three numbers, not an integer"},
           {"[[sphere]]\nmaterial = {}", "2:12: error: 'material' in [[sphere]] must be a string, not a table"},
           {"[[mesh]]\nfile = \"a.obj\"\nscale = \"2\"",
            "3:9: error: 'scale' in [[mesh]] must be one number or three, not a string"},
           {"[[mesh]]\nfile = \"a.obj\"\nname = \"\"", "3:8: error: 'name' in [[mesh]] must not be empty"},
           {"[material.a]\nbase_color = [1, 1]",
            "2:14: error: 'base_color' in [material.a] must be three numbers, not 2"},
           {"[material.a]\nbase_color = \"red\"",
            "2:14: error: 'base_color' in [material.a] must be one number or three, not a string"}});
}

TEST_F(SceneMistakes, OutOfRange)
{
    check(
        {{"version = 2", "1:11: error: version 2 of scene files is unknown; known: 1"},
         {"[render]\nspp = 0", "2:7: error: 'spp' in [render] must be from 1 to 2147483647, not 0"},
         {"[render]\nspp = 2147483648", "2:7: error: 'spp' in [render] must be from 1 to 2147483647, not 2147483648"},
         {"[render]\nmax_depth = -1", "2:13: error: 'max_depth' in [render] must be from 0 to 2147483647, not -1"},
         {"[render]\nmax_depth = 2147483648",
          "2:13: error: 'max_depth' in [render] must be from 0 to 2147483647, not 2147483648"},
         {"[render]\nreplicates = 0", "2:14: error: 'replicates' in [render] must be from 1 to 1024, not 0"},
         {"[render]\nstop_error = 0", "2:14: error: 'stop_error' in [render] must be from 1e-09 to 1e+09, not 0"},
         {"[render]\nseed = -1", "2:8: error: 'seed' in [render] must be from 0 to 9223372036854775807, not -1"},
         {"[render]\nsize = [0, 65537]",
          "2:9: error: 'size' in [render] must be from 1 to 65536, not 0\n"
          "s.toml:2:12: error: 'size' in [render] must be from 1 to 65536, not 65537"},
         {"[render]\nsize = [65536, 4097]",
          "2:8: error: 'size' in [render] must make at most 268435456 pixels, not 268500992"},
         {"[camera]\nfov = 0", "2:7: error: 'fov' in [camera] must be greater than 0 and less than 180, not 0"},
         {"[camera]\nfov = 180", "2:7: error: 'fov' in [camera] must be greater than 0 and less than 180, not 180"},
         {"[camera]\ntype = \"thin_lens\"\naperture = -0.5",
          "3:12: error: 'aperture' in [camera] must be 0 or greater, not -0.5"},
         {"[camera]\ntype = \"thin_lens\"\nfocus = 0", "3:9: error: 'focus' in [camera] must be greater than 0, not 0"},
         {"[[mesh]]\nfile = \"a.obj\"\nscale = 0", "3:9: error: 'scale' in [[mesh]] must be other than 0, not 0"},
         {"[[mesh]]\nfile = \"a.obj\"\nscale = [1, -0.0, 1]",
          "3:13: error: 'scale' in [[mesh]] must be other than 0, not -0"},
         {"[[sphere]]\nradius = 0", "2:10: error: 'radius' in [[sphere]] must be greater than 0, not 0"},
         {"[[sphere]]\nradius = -1", "2:10: error: 'radius' in [[sphere]] must be greater than 0, not -1"},
         {"[material.a]\nbase_color = 1.5", "2:14: error: 'base_color' in [material.a] must be from 0 to 1, not 1.5"},
         {"[material.a]\nbase_color = [0, 0, -0.1]",
          "2:21: error: 'base_color' in [material.a] must be from 0 to 1, not -0.1"},
         {"[material.a]\nemission = -1", "2:12: error: 'emission' in [material.a] must be from 0 to 3.4e38, not -1"},
         {"[material.a]\nemission = 1e39",
          "2:12: error: 'emission' in [material.a] must be from 0 to 3.4e38, not 1e+39"},
         {"[material.a]\ntype = \"glass\"\nior = 0",
          "3:7: error: 'ior' in [material.a] must be greater than 0 and at most 3.4e38, not 0"},
         {"[material.a]\ntype = \"glass\"\nior = 1e-60",
          "3:7: error: 'ior' in [material.a] must be greater than 0 and at most 3.4e38, not 1e-60"},
         {"[[light]]\ntype = \"environment\"\nradiance = [0, -1, 0]",
          "3:16: error: 'radiance' in [[light]] must be from 0 to 3.4e38, not -1"}});
}

TEST_F(SceneMistakes, NumbersThatAreNotFinite)
{
    check({{"[camera]\nfov = nan", "2:7: error: 'fov' in [camera] must be finite, not nan"},
           {"[camera]\nposition = [0, inf, 0]", "2:16: error: 'position' in [camera] must be finite, not inf"},
           {"[[sphere]]\nradius = inf", "2:10: error: 'radius' in [[sphere]] must be finite, not inf"},
           {"[[plane]]\npoint = [0, 0, -inf]", "2:16: error: 'point' in [[plane]] must be finite, not -inf"},
           {"[[mesh]]\nfile = \"a.obj\"\nscale = -inf", "3:9: error: 'scale' in [[mesh]] must be finite, not -inf"},
           {"[[mesh]]\nfile = \"a.obj\"\nrotate = [0, nan, 0]",
            "3:14: error: 'rotate' in [[mesh]] must be finite, not nan"},
           {"[material.a]\nemission = inf", "2:12: error: 'emission' in [material.a] must be finite, not inf"},
           {"[material.a]\ntype = \"glass\"\nior = nan", "3:7: error: 'ior' in [material.a] must be finite, not nan"}});
}

TEST_F(SceneMistakes, UnknownChoices)
{
    check({{"[camera]\ntype = \"pinhol\"",
            "2:8: error: unknown type 'pinhol' in [camera]; did you mean 'pinhole'? known: pinhole, thin_lens"},
           {"[camera]\nup = \"x\"", "2:6: error: unknown up 'x' in [camera]; known: y, z"},
           {"[material.a]\ntype = \"galss\"\nior = 2",
            "2:8: error: unknown type 'galss' in [material.a]; did you mean 'glass'? known: lambert, translucent, "
            "mirror, metal, glass, plastic, interface, principled, mix"},
           {"[material.a]\nemission_sides = \"back\"",
            "2:18: error: unknown emission_sides 'back' in [material.a]; known: front, both"},
           {"[[light]]\ntype = \"area\"",
            "2:8: error: unknown type 'area' in [[light]]; known: point, directional, spot, sphere, environment"}});
}

TEST_F(SceneMistakes, KeysOfAnotherType)
{
    check({{"[material.a]\nior = 1.5",
            "2:7: error: 'ior' in [material.a] needs type 'glass' or 'plastic' or 'interface' or 'principled', not "
            "'lambert'"},
           {"[material.a]\ntype = \"mirror\"\nior = 1.5",
            "3:7: error: 'ior' in [material.a] needs type 'glass' or 'plastic' or 'interface' or 'principled', not "
            "'mirror'"},
           {"[camera]\naperture = 0.1", "2:12: error: 'aperture' in [camera] needs type 'thin_lens', not 'pinhole'"},
           {"[camera]\ntype = \"pinhole\"\nfocus = 1",
            "3:9: error: 'focus' in [camera] needs type 'thin_lens', not 'pinhole'"},
           {"[[light]]\ntype = \"point\"\nposition = [0, 0, 0]\nintensity = 1\nradiance = 1",
            "5:12: error: 'radiance' in [[light]] needs type 'sphere' or 'environment', not 'point'"},
           {"[[light]]\ntype = \"environment\"\nradiance = 1\nradius = 1",
            "4:10: error: 'radius' in [[light]] needs type 'sphere', not 'environment'"},
           {"[[light]]\ntype = \"sphere\"\nradiance = 1\nradius = 1\nposition = [0, 0, 0]",
            "1:1: error: [[light]] of type 'sphere' needs 'center'\n"
            "s.toml:5:12: error: 'position' in [[light]] needs type 'point' or 'spot', not 'sphere'"}});
}

TEST_F(SceneMistakes, MissingKeys)
{
    check({{"[[mesh]]\nscale = 2", "1:1: error: [[mesh]] needs 'file'"},
           {"\n[[instance]]\nscale = 2", "2:1: error: [[instance]] needs 'mesh'"},
           {"[[light]]", "1:1: error: [[light]] needs 'type'"},
           {"[[light]]\ntype = \"point\"",
            "1:1: error: [[light]] of type 'point' needs 'position'\n"
            "s.toml:1:1: error: [[light]] of type 'point' needs 'intensity'"},
           {"[[light]]\ntype = \"sphere\"\ncenter = [0, 0, 0]",
            "1:1: error: [[light]] of type 'sphere' needs 'radius'\n"
            "s.toml:1:1: error: [[light]] of type 'sphere' needs 'radiance'"},
           {"[[light]]\ntype = \"environment\"", "1:1: error: [[light]] of type 'environment' needs 'radiance'"}});
}

TEST_F(SceneMistakes, DegenerateCamerasAndPlanes)
{
    const char* same = "error: 'position' and 'target' in [camera] must be different points";
    const char* parallel = "error: 'up' in [camera] must not be parallel to the view, from 'position' to 'target'";
    EXPECT_EQ(problems("[camera]\nposition = [1, 2, 3]\ntarget = [1, 2, 3]"), "s.toml:3:10: " + std::string(same));
    const std::string origin = "[camera]\ntarget = [0, 0, 0]\n";
    EXPECT_EQ(problems(origin + "position = [0, 0, -9]\nup = \"z\""), "s.toml:4:6: " + std::string(parallel));
    EXPECT_EQ(problems(origin + "position = [1, 1, 1]\nup = [1e-200, 1e-200, 1e-200]"),
              "s.toml:4:6: " + std::string(parallel));
    // What is left out is chosen so that it suits the rest.
    EXPECT_EQ(problems("[camera]\nposition = [0, 0, 0]"), "");
    EXPECT_EQ(problems(origin + "position = [0, 9, 0]"), "");
    EXPECT_EQ(problems("[camera]\nposition = [0, 0, -9]\nup = \"z\""), "");
    check({{"[camera]\nup = [0, 0, 0]", "2:6: error: 'up' in [camera] must not be the zero vector"},
           {"[camera]\nposition = [0, 0, 1.7e308]\ntarget = [0, 0, -1.7e308]",
            "3:10: error: 'position' and 'target' in [camera] are too far apart"},
           {"[[plane]]\nnormal = [0, 0, 0]", "2:10: error: 'normal' in [[plane]] must not be the zero vector"},
           {"[[plane]]\nnormal = [0, 1e300, 0]",
            "2:10: error: 'normal' in [[plane]] is too long to be made a unit vector"}});
}

TEST_F(SceneMistakes, AWrongVectorIsNotAlsoBlamedForItsDefault)
{
    check({{"[camera]\nposition = [0, 9, 0, 0]\ntarget = [0, 0, 5]",
            "2:12: error: 'position' in [camera] must be three numbers, not 4"},
           {"[camera]\nposition = [0, 9, 0]\nup = []", "3:6: error: 'up' in [camera] must be three numbers, not 0"}});
}

TEST_F(SceneMistakes, NamesThatNobodyHas)
{
    check({{"[[sphere]]\nmaterial = \"galss\"\n[material.glass]\n[material.gold]",
            "2:12: error: unknown material 'galss'; did you mean 'glass'? known: glass, gold, white_plastic, "
            "red_plastic, bronze, emerald, black_matter, sand, mirror, blue_water, grey_matter, steel, ruby, "
            "grey_metallic"},
           {"[[plane]]\nmaterial = \"wood\"\n[material.glass]",
            "2:12: error: unknown material 'wood'; known: glass, white_plastic, red_plastic, bronze, emerald, "
            "black_matter, sand, mirror, blue_water, grey_matter, steel, ruby, grey_metallic"},
           {"[[mesh]]\nfile = \"a.obj\"\nmaterial = \"wood\"",
            "3:12: error: unknown material 'wood'; known: white_plastic, red_plastic, bronze, emerald, glass, "
            "black_matter, sand, mirror, blue_water, grey_matter, steel, ruby, grey_metallic"},
           {"[[mesh]]\nfile = \"a.obj\"\nname = \"tree\"\n[[instance]]\nmesh = \"tere\"",
            "5:8: error: unknown mesh 'tere'; did you mean 'tree'? known: tree"},
           {"[[mesh]]\nfile = \"a.obj\"\n[[instance]]\nmesh = \"tree\"",
            "4:8: error: unknown mesh 'tree'; the file has no [[mesh]] with a name"}});
}

TEST_F(SceneMistakes, TwoMeshesOfOneName)
{
    check({{"[[mesh]]\nfile = \"a.obj\"\nname = \"a\"\n[[mesh]]\nfile = \"a.obj\"\nname = \"a\"",
            "6:8: error: another [[mesh]] is named 'a' already, in line 3"}});
}

TEST_F(SceneMistakes, SyntaxErrorsHaveAPlace)
{
    check({{"[camera]\nfov = = 3", "2:7: error: invalid TOML in value: could not determine value type"},
           {"a = 1\na = 2", "2:5: error: invalid TOML in key-value pair: cannot redefine existing integer 'a'"},
           {"a = \"\xff\"", "1:5: error: invalid TOML: Encountered invalid utf-8 sequence"}});
    EXPECT_THAT(problems("[render\nspp = 1"), testing::StartsWith("s.toml:1:8: error: invalid TOML in table header"));
    EXPECT_THAT(problems("v 1 2 3"), testing::StartsWith("s.toml:1:3: error: invalid TOML in key-value pair"));
}

TEST_F(SceneMistakes, AllAreReportedFromTopToBottom)
{
    EXPECT_EQ(problems(R"([[sphere]]
radius = -1
material = "galss"
[render]
spp = 0
[[light]]
type = "point"
intensity = nan
[camera]
fov = 200
[material.glass]
type = "lamber"
)"),
              R"(s.toml:2:10: error: 'radius' in [[sphere]] must be greater than 0, not -1
s.toml:3:12: error: unknown material 'galss'; did you mean 'glass'? known: glass, white_plastic, red_plastic, bronze, emerald, black_matter, sand, mirror, blue_water, grey_matter, steel, ruby, grey_metallic
s.toml:5:7: error: 'spp' in [render] must be from 1 to 2147483647, not 0
s.toml:6:1: error: [[light]] of type 'point' needs 'position'
s.toml:8:13: error: 'intensity' in [[light]] must be finite, not nan
s.toml:10:7: error: 'fov' in [camera] must be greater than 0 and less than 180, not 200
s.toml:12:8: error: unknown type 'lamber' in [material.glass]; did you mean 'lambert'? known: lambert, translucent, mirror, metal, glass, plastic, interface, principled, mix)");
}

TEST_F(SceneMistakes, NamesCannotForgeLinesOrColours)
{
    EXPECT_EQ(problems("[[sphere]]\nmaterial = \"a\\n\\u001b[31m\""),
              "s.toml:2:12: error: unknown material 'a??[31m'; known: white_plastic, red_plastic, bronze, emerald, "
              "glass, black_matter, sand, mirror, blue_water, grey_matter, steel, ruby, grey_metallic");
}

TEST_F(SceneMistakes, MissingMeshFile)
{
    Diagnostics diagnostics;
    parse_scene("[[mesh]]\n  file = \"sub/b.obj\"", path("s.toml"), options_, diagnostics);
    EXPECT_EQ(errors(diagnostics), "s.toml:2:10: error: mesh file 'sub/b.obj' does not exist");
    EXPECT_TRUE(loaded_.empty());
    try {
        diagnostics.throw_if_errors();
        FAIL() << "nothing thrown";
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::missing_input);
    }
}

TEST_F(SceneMistakes, MeshFilesThatCannotBe)
{
    std::filesystem::create_directory(folder_ / "sub");
    const std::string long_name(5000, 'a');
    check({{"[[mesh]]\nfile = \"sub\"", "2:8: error: mesh file 'sub' is a folder, not a file"},
           {"[[mesh]]\nfile = \"a.obj\\u0000x\"", "2:8: error: mesh file 'a.obj?x' holds a zero byte"}});
    EXPECT_THAT(problems("[[mesh]]\nfile = \"" + long_name + "\""),
                testing::HasSubstr("cannot be found: File name too"));
    EXPECT_TRUE(loaded_.empty());
}

TEST_F(SceneMistakes, FilesOutsideOfTheFolder)
{
    write("a.obj", "");
    write("scenes/inside.obj", "");
    std::filesystem::create_symlink("../a.obj", folder_ / "scenes/link.obj");
    const std::string text =
        "[[mesh]]\nfile = \"../a.obj\"\n[[mesh]]\nfile = '" + path("a.obj") + "'\n[[mesh]]\nfile = \"link.obj\"\n";
    const auto report = [&] {
        Diagnostics diagnostics;
        parse_scene(text, path("scenes/s.toml"), options_, diagnostics);
        return errors(diagnostics);
    };
    const std::string outside = "lies outside of the folder of the scene; --asset-root FOLDER allows another folder";
    EXPECT_EQ(report(), "scenes/s.toml:2:8: error: mesh file '../a.obj' " + outside +
                            "\nscenes/s.toml:4:8: error: mesh file 'a.obj' " + outside +
                            "\nscenes/s.toml:6:8: error: mesh file 'link.obj' " + outside);
    EXPECT_TRUE(loaded_.empty());
    options_.asset_root = folder_.string();
    EXPECT_EQ(report(), "");
    std::filesystem::create_directory(folder_ / "other");
    options_.asset_root = path("other");
    EXPECT_THAT(report(), testing::HasSubstr("'../a.obj' lies outside of the --asset-root 'other'"));
}

TEST_F(SceneMistakes, AFolderWhoseNameBeginsLikeTheScenesIsOutside)
{
    write("scenes2/a.obj", "");
    write("scenes/s.toml", "[[mesh]]\nfile = \"../scenes2/a.obj\"");
    Diagnostics diagnostics;
    load_scene_file(path("scenes/s.toml"), options_, diagnostics);
    EXPECT_THAT(errors(diagnostics), testing::HasSubstr("lies outside of the folder"));
}

TEST_F(SceneMistakes, AssetRootMustBeAFolder)
{
    options_.asset_root = path("nowhere");
    Diagnostics diagnostics;
    try {
        parse_scene("version = 1", path("s.toml"), options_, diagnostics);
        FAIL() << "nothing thrown";
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::usage);
        EXPECT_EQ(without_folder(e.what()), "error: the asset root 'nowhere' is not a folder");
    }
}

TEST_F(SceneMistakes, FilesThatAreNoText)
{
    EXPECT_EQ(problems(""), "s.toml: error: the file is empty");
    EXPECT_EQ(problems("\xEF\xBB\xBF \r\n\t"), "s.toml: error: the file is empty");
    EXPECT_EQ(problems(std::string("\x7f"
                                   "ELF\0\1",
                                   6)),
              "s.toml: error: is not a text file: it holds a zero byte");
}

TEST_F(SceneMistakes, FilesThatCannotBeRead)
{
    write("locked.toml", "version = 1");
    std::filesystem::permissions(path("locked.toml"), std::filesystem::perms::none);
    const auto thrown = [&](const std::string& name) {
        Diagnostics diagnostics;
        try {
            load_scene_file(path(name), options_, diagnostics);
        } catch (const Error& e) {
            return std::pair(e.kind(), without_folder(e.what()));
        }
        return std::pair(ErrorKind::failed, std::string("nothing thrown"));
    };
    EXPECT_EQ(thrown("none.toml"), std::pair(ErrorKind::missing_input, std::string("none.toml: error: no such file")));
    EXPECT_EQ(thrown("."), std::pair(ErrorKind::invalid_input, std::string(".: error: is a folder, not a file")));
    if (geteuid() == 0) return;  // root can read everything
    EXPECT_EQ(thrown("locked.toml"), std::pair(ErrorKind::missing_input,
                                               std::string("locked.toml: error: cannot be opened: Permission denied")));
}

TEST_F(SceneMistakes, ALoaderThatReturnsNothingIsReported)
{
    write("a.obj", "");
    options_.mesh_loader = [](const std::string&, Diagnostics&, const MeshOptions&) { return nullptr; };
    EXPECT_EQ(problems("[[mesh]]\nfile = \"a.obj\""), "s.toml:2:8: error: mesh file 'a.obj' could not be loaded");
    options_.mesh_loader = [](const std::string& file, Diagnostics& d, const MeshOptions&) {
        d.error({file, 7}, "bad face");
        return nullptr;
    };
    EXPECT_EQ(problems("[[mesh]]\nfile = \"a.obj\""), "a.obj:7: error: bad face");
}

TEST_F(SceneMistakes, EndlessKeysDoNotExhaustTheStack)
{
    std::string key = "a";
    for (int i = 0; i < 200000; ++i) key += ".a";
    const std::string message = "error: a key with more than 9 parts";
    EXPECT_EQ(problems(key + " = 1"), "s.toml:1: " + message);
    EXPECT_EQ(problems("# a.a.a.a.a.a.a.a.a.a.a\nversion = 1\n[" + key + "]"), "s.toml:3: " + message);
    EXPECT_EQ(problems("x = '''\n'''''\ny = \"\"\"\\\"\"\"\"\n\"#\"." + key + " = 1"), "s.toml:4: " + message);
    EXPECT_THAT(problems("a = " + std::string(200000, '[')), testing::HasSubstr("exceeded maximum nested value depth"));
    std::string nested;
    for (int i = 0; i < 250; ++i) nested += "a.a.a.a.a.a.a.a.a = {";
    EXPECT_NE(problems(nested + std::string(250, '}')), "");
}

TEST_F(SceneMistakes, DotsInTextAndNumbersAreNotCounted)
{
    write("a.obj", "");
    scene(
        "# ............................\n[material.\"a.b.c.d.e.f.g.h.i.j.k\"]\nbase_color = [0.1, 0.2, 0.3]\n"
        "[[mesh]]\nfile = \"a.obj\"\nname = '.............'\n[[mesh]]\nfile = \"a.obj\"\nname = \"...\\\"........\"");
    EXPECT_EQ(problems("[camera]\nup = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]"),
              "s.toml:2:6: error: 'up' in [camera] must be three numbers, not 10");
}

// Must not crash, hang or throw anything but an Error, whatever stands in the file.
TEST_F(SceneMistakes, RandomDamageIsReportedOrHarmless)
{
    write("a.obj", "");
    const std::string valid = R"(version = 1
[render]
integrator = "path"
spp = 16
size = [640, 480]
[camera]
type = "thin_lens"
position = [0, 2, 8.5]
up = "y"
aperture = 0.1
[[mesh]]
name = "a"
file = "a.obj"
material = "glass"
scale = [1, -2, 1e-3]
[[instance]]
mesh = "a"
[[light]]
type = "point"
position = [0, 5, 0]
intensity = 10
[material.glass]
type = "glass"
ior = 1.5
)";
    scene(valid);
    const std::string bytes = "[]{}=.,\"'#\n\\-+_ 019einfabz\xff\x80";
    std::mt19937 random(1);
    const auto below = [&random](size_t n) { return static_cast<size_t>(random()) % n; };
    int right = 0, wrong = 0;
    for (int i = 0; i < 10000; ++i) {
        std::string text = valid;
        for (size_t n = 1 + below(4); n > 0; --n) {
            const size_t at = below(text.size());
            switch (below(5)) {
                case 0:
                    text[at] = bytes[below(bytes.size())];
                    break;
                case 1:
                    text.insert(at, 1, bytes[below(bytes.size())]);
                    break;
                case 2:
                    text.erase(at, 1 + below(8));
                    break;
                case 3:
                    text.insert(at, text.substr(below(text.size()), below(40)));
                    break;
                default:
                    text[at] = static_cast<char>(below(256));
                    break;
            }
        }
        if (problems(text).empty()) {
            ++right;
        } else {
            ++wrong;
        }
    }
    EXPECT_GT(right, 20);
    EXPECT_GT(wrong, 5000);
}

}  // namespace
}  // namespace lancer
