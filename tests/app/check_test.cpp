// lancer check: what it says, on stdout, and its exit codes.
#include <gtest/gtest.h>

#include "app/run_program.h"

namespace lancer {
namespace {

class Check : public AppTest {
protected:
    // A room of one floor and a lamp right below it that shines up or down.
    void write_lamp(bool up) const
    {
        write("lamp.mtl", "newmtl lamp\nKe 5 5 5\nKd 0 0 0\nnewmtl wall\nKd 0.5 0.5 0.5\n");
        write("lamp.obj", std::string("mtllib lamp.mtl\nv 0 0 0\nv 4 0 0\nv 4 0 4\nv 0 0 4\nv 1 -0.01 1\nv 3 -0.01 1\n"
                                      "v 3 -0.01 3\nv 1 -0.01 3\nusemtl wall\nf 1 2 3 4\nusemtl lamp\n") +
                              (up ? "f 8 7 6 5\n" : "f 5 6 7 8\n"));
    }
};

TEST_F(Check, ACleanSceneHasNoProblems)
{
    const Said said = run({"check", "scene.toml", "--strict"});
    EXPECT_EQ(said.code, 0);
    EXPECT_EQ(said.out, "0 errors, 0 warnings, 0 notes\n");
    EXPECT_EQ(said.err, "");
}

TEST_F(Check, EveryProblemHasItsPlace)
{
    write("bad.mtl", "newmtl a\nKd 2 0 0\nnewmtl a\n");
    write("bad.obj",
          "mtllib bad.mtl\nmtllib bad.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 2 0\nvn 0 0 -1\nusemtl a\n"
          "f 1 2 3 5 4\nf 1//1 2//1 3//1\nf 1 1 2\nusemtl b\nf 2 3 4\n");
    write("bad.toml", "[[mesh]]\nfile = \"bad.obj\"\n[material.unused]\n");
    const Said said = run({"check", "bad.toml"});
    EXPECT_EQ(said.code, 0);
    for (const char* line :
         {"bad.mtl:2: warning: Kd outside [0, 1] clamped\n",
          "bad.mtl:3: warning: material 'a' exists already; the first is used\n",
          "bad.obj:12: warning: zero-area face dropped\n", "bad.obj:13: warning: unknown material 'b'",
          "bad.obj: warning: vertex normals point away from the side that the winding shows in 1 of 5 triangles",
          "bad.toml:3:1: warning: material 'unused' is not used\n", "warning: nothing emits light",
          "bad.obj: note: the corners of another triangle in 1 of 5 triangles\n",
          "bad.obj:10: note: polygon of more than 4 corners, cut into triangles\n",
          "bad.obj:2: note: the material library 'bad.mtl' is named again\n",
          "bad.obj: note: no vertex normals in 4 of 5 triangles: they are flat\n", "bad.toml: note: no camera",
          "0 errors, "})
        expect_words(said.out, line);
    EXPECT_EQ(run({"check", "bad.toml", "--strict"}).code, 65);
}

TEST_F(Check, OpaqueMaterialsThatIllumCallsGlassAreNoted)
{
    write("m.mtl", "newmtl a\nKd .5 .5 .5\nTf 1 1 1\nNi 1.00\nillum 4\nnewmtl b\nKd .5 .5 .5\nd .5\nNi 1.5\nillum 4\n");
    write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 2\n");
    const Said checked = run({"check", "m.obj"});
    expect_words(checked.out, "m.mtl:1: note: lambert, by Kd alone; illum 4 says glass, but Ni is 1\n");
    EXPECT_EQ(checked.out.find("m.mtl:6"), std::string::npos);
    const Said told = run({"info", "m.obj"});
    expect_words(told.out, "a: lambert, by Kd alone; illum 4 says glass, but Ni is 1\n");
    expect_words(told.out, "b: glass, by illum 4 and d 0.5\n");
}

TEST_F(Check, ThinSheetsAreNotedAndTold)
{
    write("g.mtl", "newmtl pane\nKd 0 0 0\nNi 1.5\nillum 7\n");
    write("g.obj", "mtllib g.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl pane\nf 1 2 3 4\nf 2 1 4 3\n");
    write("g.toml", "[[mesh]]\nfile = \"g.obj\"\n[[light]]\ntype = \"environment\"\nradiance = 1\n");
    const char* const found = "1 sheet of glass 'pane': given more than once in the same place: one thin sheet\n";
    expect_words(run({"check", "g.toml"}).out, std::string("g.obj: note: ") + found);
    expect_words(run({"info", "g.toml"}).out, std::string("sheets        ") + found);
    write("solid.toml",
          "[[mesh]]\nfile = \"g.obj\"\n[[light]]\ntype = \"environment\"\nradiance = 1\n[[material_override]]\n"
          "match = \"pane\"\nthin = false\n");
    EXPECT_EQ(run({"check", "solid.toml"}).out.find("thin sheet"), std::string::npos);
}

TEST_F(Check, LightsBehindGlassAreFound)
{
    write("bulb.toml",
          "[camera]\nposition = [0, 2, 6]\n[[plane]]\n[[sphere]]\ncenter = [0, 2, 0]\nradius = 0.5\nmaterial = "
          "\"g\"\n[material.g]\ntype = \"glass\"\n[[light]]\ntype = \"point\"\nposition = [0, 2, 0]\nintensity = "
          "10\n");
    const char* const said = "bulb.toml:10:1: warning: this point light does not reach the picture";
    expect_words(run({"check", "bulb.toml"}).out, said);
    const Said drawn = run({"render", "bulb.toml", "--size", "16x16", "--spp", "1", "-o", "bulb.png"});
    expect_words(drawn.err, said);
    expect_words(drawn.err, "1 light does not reach the picture");
    const Said whitted =
        run({"render", "bulb.toml", "--size", "16x16", "--spp", "1", "-o", "bulb.png", "--integrator", "whitted"});
    EXPECT_EQ(whitted.err.find("does not reach"), std::string::npos);
    EXPECT_EQ(run({"check", "bulb.toml", "-D", "light.0.position=[0,4,0]"}).out.find("does not reach"),
              std::string::npos);
}

TEST_F(Check, TexturesWithoutTextureCoordinatesAreFound)
{
    const auto check = [&](const char* faces) {
        write("t.obj", std::string("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n") + faces);
        write("t.toml",
              "[[mesh]]\nfile = \"t.obj\"\nmaterial = \"m\"\n[material.m]\ntexture = \"c\"\n"
              "[texture.c]\ntype = \"checker\"\n");
        return run({"check", "t.toml"}).out;
    };
    expect_words(check("f 1 2 3\nf 1 3 4\n"), "t.obj: warning: no texture coordinates in 2 of 2 triangles");
    expect_words(check("f 1/1 2/2 3/3\nf 1 3 4\n"), "t.obj: warning: no texture coordinates in 1 of 2 triangles");
    EXPECT_EQ(check("f 1/1 2/2 3/3\nf 1/1 3/2 4/3\n").find("texture coordinates"), std::string::npos);
}

TEST_F(Check, ErrorsAreCountedAndEndIt)
{
    write("bad.toml", "[camera]\nfvo = 1\n[[sphere]]\nradius = -1\n");
    const Said said = run({"check", "bad.toml"});
    EXPECT_EQ(said.code, 65);
    expect_words(said.out, "bad.toml:2:1: error: unknown key 'fvo'");
    expect_words(said.out, "\n2 errors, 0 warnings, 0 notes\n");
    write("missing.toml", "[[mesh]]\nfile = \"none.obj\"\n");
    EXPECT_EQ(run({"check", "missing.toml"}).code, 66);
    EXPECT_EQ(run({"check", "none.toml"}).code, 66);
    EXPECT_EQ(run({"check"}).code, 2);
}

TEST_F(Check, ALampThatFacesTheWallItHangsFromIsFound)
{
    write_lamp(true);
    expect_words(run({"check", "lamp.obj"}).out,
                 "lamp.mtl:1: warning: emitter 'lamp' faces only a wall at its back; turn its faces round");
    write_lamp(false);
    EXPECT_EQ(run({"check", "lamp.obj"}).out.find("emitter"), std::string::npos);
}

TEST_F(Check, ALampTurnedInsideOutIsFound)
{
    const auto cube = [&](bool inwards) {
        std::string text = "mtllib lamp.mtl\nusemtl lamp\n";
        for (int i = 0; i < 8; ++i)
            text +=
                "v " + std::to_string(i & 1) + " " + std::to_string(i >> 1 & 1) + " " + std::to_string(i >> 2) + "\n";
        for (const std::array<int, 4>& f : {std::array{1, 3, 4, 2}, std::array{5, 6, 8, 7}, std::array{1, 2, 6, 5},
                                            std::array{3, 7, 8, 4}, std::array{1, 5, 7, 3}, std::array{2, 4, 8, 6}}) {
            text += "f";
            for (int i = 0; i < 4; ++i) text += " " + std::to_string(f[static_cast<size_t>(inwards ? 3 - i : i)]);
            text += "\n";
        }
        write("lamp.obj", text);
        return run({"check", "lamp.obj"}).out;
    };
    write("lamp.mtl", "newmtl lamp\nKe 5 5 5\n");
    expect_words(cube(true), "emitter 'lamp' lights only its own inside");
    EXPECT_EQ(cube(false).find("emitter"), std::string::npos);
}

}  // namespace
}  // namespace lancer
