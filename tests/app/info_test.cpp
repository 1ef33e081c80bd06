// lancer info: of scenes and of pictures.
#include <gtest/gtest.h>

#include "app/run_program.h"

namespace lancer {
namespace {

using Info = AppTest;

TEST_F(Info, OfAScene)
{
    write("lamp.mtl", "newmtl lamp\nKe 1 1 1\n");
    write("two.obj", "mtllib lamp.mtl\nv 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\nf 1 2 3 4\nusemtl lamp\nf 1 3 2\n");
    write("full.toml",
          "[camera]\nfov = 30\n[camera.close]\nfov = 10\n[[mesh]]\nname = \"two\"\nfile = "
          "\"two.obj\"\n[[instance]]\nmesh = "
          "\"two\"\n[[instance]]\nmesh = \"two\"\ntranslate = [4, 0, 0]\n[[sphere]]\nmaterial = \"g\"\n[[plane]]\n"
          "point = [0, -1, 0]\n[[light]]\ntype = \"point\"\nposition = [0, 5, 0]\nintensity = 3\n[material.g]\ntype = "
          "\"glass\"\nopacity = 0.5\n[material.unused]\n");
    const Said said = run({"info", "full.toml"});
    EXPECT_EQ(said.code, 0) << said.err;
    for (const char* line :
         {"file          full.toml\n", "triangles     3, drawn 6\n", "vertices      4\n",
          "shapes        2 instances, 1 mesh, 1 plane, 1 sphere\n", "bounds        -1 -1 -1 to 6 3 1\n", " glass",
          "lights        2 emitting triangles, 1 point\n", "cameras       the unnamed one, close\n",
          "textures      none\n", "accelerator ",
          "features      spheres, planes, instances, opacity, lambert, glass, point lights, triangle lights, smooth or "
          "instanced "
          "triangle lights\n",
          "kernel        wide\n", "unused        \n  1 unused materials\n", "  1 OpenImageIO module, not loaded\n",
          "warnings      \n  full.toml:24:1: warning: material 'unused' is not used\n"})
        expect_words(said.out, line);
    EXPECT_EQ(run({"info", "none.toml"}).code, 66);
}

// What is made of meshes, spheres and planes is counted as what it was called, and found again by its place.
TEST_F(Info, OfShapesMadeOfOthers)
{
    write("shapes.toml",
          "[camera]\nposition = [0, 0.2, 5]\n[[plane]]\n[[water]]\npoint = [0, -1, 0]\n[[bubble]]\nmaterial = \"g\"\n"
          "center = [0, 0, -9]\nradius = 0.1\n[[triangle]]\na = [-5, -5, 0]\nb = [5, -5, 0]\nc = [0, 9, 0]\n"
          "[[pyramid]]\n[[light]]\ntype = \"environment\"\nradiance = 1\n[material.g]\ntype = \"glass\"\n");
    const Said said = run({"info", "shapes.toml"});
    EXPECT_EQ(said.code, 0) << said.err;
    expect_words(said.out, "shapes        1 bubble, 1 plane, 1 plane of water, 1 pyramid, 1 triangle\n");
    expect_words(said.out, "triangles     5, drawn 5\n");
    expect_words(said.out, "warnings      none\n");
    const Said checked = run({"check", "--strict", "shapes.toml"});
    EXPECT_EQ(checked.code, 0) << checked.out << checked.err;
    expect_words(checked.out, "0 errors, 0 warnings, 0 notes\n");
    const Said pixel = run({"pixel", "shapes.toml", "--size", "9x9", "4", "0"});
    EXPECT_EQ(pixel.code, 0) << pixel.err;
    expect_words(pixel.out, "hit            triangle 0 of the triangle at shapes.toml:10:1\n");
}

// Two lamps with a wall in between: what one side of it is lit by does not light the other.
TEST_F(Info, OfTheSamplingPlan)
{
    write("plan.toml",
          "[camera]\nposition = [0, 3, 9]\ntarget = [0, 0, 0]\n[render]\nsize = [48, 36]\n[[plane]]\n[[sphere]]\n"
          "center = [0, 0, 0]\nradius = 2\n[[light]]\ntype = \"sphere\"\ncenter = [-5, 2, 0]\nradius = 0.3\n"
          "radiance = 9\n[[light]]\ntype = \"sphere\"\ncenter = [5, 2, 0]\nradius = 0.3\nradiance = 9\n");
    const Said plain = run({"info", "plan.toml"});
    EXPECT_EQ(plain.out.find("splitting"), std::string::npos);
    const Said said = run({"info", "plan.toml", "--plan-map", "q.png"});
    EXPECT_EQ(said.code, 0) << said.err;
    for (const char* line :
         {"splitting     ", "roulette      by an importance map", "mirrors       0", "light         sampled "})
        expect_words(said.out, line);
    expect_words(run({"info", "q.png"}).out, "size          48x36\n");
    EXPECT_EQ(run({"info", "plan.toml", "--plan-map", "q.jpg"}).code, 2);
    EXPECT_NE(run({"info", "plan.toml", "--plan-map", "none/q.png"}).code, 0);
    // Integrators without a pilot have no plan.
    for (const char* other : {"render.integrator=\"ao\"", "render.legacy=true"}) {
        EXPECT_EQ(run({"info", "plan.toml", "-D", other}).code, 0) << other;
        const Said refused = run({"info", "plan.toml", "--plan", "-D", other});
        EXPECT_EQ(refused.code, 2) << other;
        expect_words(refused.err, "error: --plan: the integrator of the scene has no pilot");
    }
}

TEST_F(Info, OfPictures)
{
    EXPECT_EQ(render({"-o", "a.exr", "-o", "a.png", "--crop", "2,3,10,9", "--aov", "depth", "--seed", "7"}).code, 0);
    const Said exr = run({"info", "a.exr"});
    EXPECT_EQ(exr.code, 0);
    for (const char* line : {"size          24x16\n", "pixels        8x6 at 2 3\n", "compression   zip\n",
                             "channels      B float, G float, R float, depth.Z float\n", "seed          7\n",
                             "integrator    path\n", "bias          none\n"})
        expect_words(exr.out, line);
    const Said png = run({"info", "a.png"});
    EXPECT_EQ(png.code, 0);
    for (const char* line : {"size          8x6\n", "channels      3 of 8 bits\n", "seed          7\n"})
        expect_words(png.out, line);
    // What is of scenes is refused, rather than left out.
    for (const std::vector<std::string>& of_scenes : std::vector<std::vector<std::string>>{
             {"--plan"}, {"--plan-map", "q.png"}, {"--camera", "close"}, {"-D", "camera.fov=3"}, {"--no-ground"}}) {
        std::vector<std::string> arguments{"info", "a.png", "--threads", "1"};
        arguments.insert(arguments.end(), of_scenes.begin(), of_scenes.end());
        const Said refused = run(arguments);
        EXPECT_EQ(refused.code, 2) << of_scenes[0];
        EXPECT_EQ(refused.out, "");
        expect_words(refused.err,
                     "error: " + of_scenes[0] + ": is for scenes, and 'a.png' does not end in .toml, .obj, .ply, .gltf or .glb");
    }
    EXPECT_EQ(run({"info", "a.png", "--threads", "1", "--memory", "1G"}).code, 0);
    write("broken.png", "\x89PNG\r\n\x1a\nbroken");
    EXPECT_EQ(run({"info", "broken.png"}).code, 65);
    const Said missing = run({"info", "none.exr"});
    EXPECT_EQ(missing.code, 66);
    EXPECT_EQ(missing.out, "");
}

}  // namespace
}  // namespace lancer
