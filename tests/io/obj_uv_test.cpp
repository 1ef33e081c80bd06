// Texture coordinates of OBJ files.
#include "obj_test_support.h"

namespace lancer {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class ObjUv : public ObjTest {
protected:
    ObjUv() : textured_("mtllib t.mtl\n" + square + "usemtl t\n") {}
    void SetUp() override
    {
        ObjTest::SetUp();
        write("a.png", "");
        write("t.mtl", "newmtl t\nmap_Kd a.png\nnewmtl plain\n");
    }
    const std::string textured_;
    static constexpr uint32_t none = MeshData::no_uv;
};

TEST_F(ObjUv, CornersKeepTheCoordinatesOfTheFile)
{
    const auto m =
        load(textured_ + "vt 0 0\nvt 1 .25 7\nvt -.5 # c\nvt 2 3 \\\n4\nf 1/1 2/2/ 3/4\nf -4/-3 -2/-1 -1/1\n");
    ASSERT_TRUE(m) << errors();
    EXPECT_THAT(m->uvs, ElementsAre(Vec2{0, 0}, Vec2{1, .25f}, Vec2{-.5f, 0}, Vec2{2, 3}));
    EXPECT_THAT(m->uv_triangles, ElementsAre(Triangle{0, 1, 3}, Triangle{1, 3, 0}));
    EXPECT_THAT(warnings(), IsEmpty());
}

TEST_F(ObjUv, PolygonsAreCutWithTheirCoordinates)
{
    const auto m = load(textured_ + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nf 1/4/1 2/3/1 3/2/1 4/1/1\n");
    ASSERT_TRUE(m) << errors();
    ASSERT_EQ(m->triangles.size(), 2u);
    ASSERT_EQ(m->uv_triangles.size(), 2u);
    for (size_t t = 0; t < 2; ++t)
        for (size_t i = 0; i < 3; ++i) EXPECT_EQ(m->uv_triangles[t][i], 3 - m->triangles[t][i]);
}

TEST_F(ObjUv, FacesWithoutUsableCoordinatesHaveNone)
{
    const auto m = load(textured_ +
                        "vt 0 0\nvt nan 0\nvt 1 1e39\nvt\nvt 1 x\nvt 1 1\nvn 0 0 1\n"
                        "f 1/1 2/1 3/6\nf 1/1 2/2 3/1\nf 1/1 2/3 3/1\nf 1/1 2/4 3/1\nf 1/1 2/5 3/1\n"
                        "f 1/1 2 3/1\nf 1//1 2//1 3//1\nf 1 2 3\nusemtl plain\nf 1 2 3\n");
    ASSERT_TRUE(m) << errors();
    EXPECT_THAT(m->uvs, ElementsAre(Vec2{}, Vec2{}, Vec2{}, Vec2{}, Vec2{}, Vec2{1, 1}));
    ASSERT_EQ(m->uv_triangles.size(), 9u);
    EXPECT_EQ(m->uv_triangles[0], (Triangle{0, 0, 5}));
    for (size_t t = 1; t < 9; ++t) EXPECT_EQ(m->uv_triangles[t], (Triangle{none, none, none})) << t;
    EXPECT_THAT(
        warnings(),
        ElementsAre("a.obj:8: warning: vt is not finite numbers; faces that use it get no texture coordinates (4 "
                    "times)",
                    "a.obj:19: warning: face with texture coordinates at some corners only: they are ignored "
                    "there",
                    "a.obj:20: warning: face without texture coordinates has a material with a texture (2 "
                    "times)"));
}

TEST_F(ObjUv, CoordinatesMayFollowTheirFaces)
{
    const auto m =
        load("mtllib t.mtl\nusemtl t\nf 1/1 2/2 3/3\nvt 0 0\nvt 1 0\n" + corners + "f -3/-2 2/1 3/3\nvt 1 1\n");
    ASSERT_TRUE(m) << errors();
    EXPECT_THAT(m->uvs, ElementsAre(Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 1}));
    EXPECT_THAT(m->uv_triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 0, 2}));
}

TEST_F(ObjUv, KeptOnlyWhereSomethingCanLookThemUp)
{
    const std::string plain = "mtllib t.mtl\n" + corners + "vt 0 0\nvt nan\nusemtl plain\nf 1/1 2/1 3/1\n";
    const auto without = load(plain);
    ASSERT_TRUE(without);
    EXPECT_THAT(without->uvs, IsEmpty());
    EXPECT_THAT(without->uv_triangles, IsEmpty());
    EXPECT_THAT(warnings(), IsEmpty());
    Diagnostics diagnostics;
    const auto asked = load_obj(write("b.obj", plain), diagnostics, {.uvs = true});
    ASSERT_TRUE(asked);
    EXPECT_EQ(asked->uvs.size(), 2u);
    EXPECT_THAT(asked->uv_triangles, ElementsAre(Triangle{0, 0, 0}));
    const auto unused = load(textured_ + "vt 0 0\nf 1 2 3\n");
    ASSERT_TRUE(unused);
    EXPECT_THAT(unused->uvs, IsEmpty());
    EXPECT_THAT(unused->uv_triangles, IsEmpty());
    for (const char* line : {"map_Kd", "map_d", "map_bump", "norm", "map_Pr", "map_Pm", "map_Ke"}) {
        write("t.mtl", "newmtl plain\n" + std::string(line) + " a.png\n");
        const auto m = load(plain);
        ASSERT_TRUE(m);
        EXPECT_EQ(m->uvs.size(), 2u) << line;
    }
}

}  // namespace
}  // namespace lancer
