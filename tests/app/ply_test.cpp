// PLY files as a user gives them: alone, and in a scene.
#include <gtest/gtest.h>

#include "app/run_program.h"

namespace lancer {
namespace {

class PlyFiles : public AppTest {
protected:
    PlyFiles()
    {
        write("block.obj",
              "v 0 0 0\nv 2 0 0\nv 2 0 1\nv 0 0 1\nv 0 3 0\nv 2 3 0\nv 2 3 1\nv 0 3 1\n"
              "f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n");
        write("block.PLY",
              "ply\r\nformat ascii 1.0\r\nelement vertex 8\r\nproperty float x\r\nproperty float y\r\n"
              "property float z\r\nelement face 6\r\nproperty list uchar int vertex_indices\r\nend_header\r\n"
              "0 0 0\r\n2 0 0\r\n2 0 1\r\n0 0 1\r\n0 3 0\r\n2 3 0\r\n2 3 1\r\n0 3 1\r\n"
              "4 0 1 2 3\r\n4 4 7 6 5\r\n4 0 4 5 1\r\n4 1 5 6 2\r\n4 2 6 7 3\r\n4 3 7 4 0\r\n");
    }
};

TEST_F(PlyFiles, AloneHaveThePixelsOfObjFiles)
{
    for (const std::string mesh : {"block.obj", "block.PLY"}) {
        const Said said = run({"render", mesh, "--size", "32x24", "-s", "4", "-q", "-o", mesh + ".exr"});
        ASSERT_EQ(said.code, 0) << said.err;
    }
    EXPECT_TRUE(same_pixels(image("block.obj.exr"), image("block.PLY.exr")));
    EXPECT_EQ(run({"block.PLY", "--size", "8x6", "-s", "1", "-q", "-o", "a.exr"}).code, 0) << "without a command";
    expect_words(run({"info", "block.PLY"}).out, "12, drawn 12");
    EXPECT_EQ(run({"check", "block.PLY"}).code, 0);
}

TEST_F(PlyFiles, InScenesHaveThePixelsOfObjFiles)
{
    const std::string rest =
        "material = \"red\"\n[material.red]\ntype = \"plastic\"\nbase_color = [0.7, 0.1, 0.1]\n"
        "[[light]]\ntype = \"environment\"\nradiance = 1\n";
    write("obj.toml", "[[mesh]]\nfile = \"block.obj\"\n" + rest);
    write("ply.toml", "[[mesh]]\nfile = \"block.PLY\"\n" + rest);
    for (const std::string scene : {"obj", "ply"})
        ASSERT_EQ(run({"render", scene + ".toml", "--size", "32x24", "-s", "4", "-q", "-o", scene + ".exr"}).code, 0);
    EXPECT_TRUE(same_pixels(image("obj.exr"), image("ply.exr")));
}

TEST_F(PlyFiles, ThatAreBrokenFailClearly)
{
    write("b.ply", "ply\nformat ascii 1.0\nelement vertex 3\n");
    const Said said = run({"render", "b.ply", "-o", "b.exr"});
    EXPECT_EQ(said.code, 65);
    expect_words(said.err, "b.ply:3: error: the header does not end");
    EXPECT_FALSE(exists("b.exr"));
    EXPECT_EQ(run({"render", "none.ply", "-o", "b.exr"}).code, 66);
}

}  // namespace
}  // namespace lancer
