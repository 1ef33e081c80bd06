// Colours of vertices in OBJ files.
#include "obj_test_support.h"

namespace lancer {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class ObjColors : public ObjTest {};

TEST_F(ObjColors, AreThreeNumbersBehindThePlace)
{
    const auto m = load("v 0 0 0 1 0 .5 # c\nv 1 0 0 0.25 \\\n1 0\n\tv 0 1 0  0 0 1 \nf 1 2 3\n");
    ASSERT_TRUE(m) << errors();
    EXPECT_THAT(m->colors, ElementsAre(Color{1, 0, 0.5f}, Color{0.25f, 1, 0}, Color{0, 0, 1}));
    EXPECT_THAT(m->positions, ElementsAre(Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}));
    EXPECT_THAT(warnings(), IsEmpty());
}

// A single number is a weight, and a comment may hold any.
TEST_F(ObjColors, AreNotThere)
{
    for (const char* rest : {"", " 1", " 1 1", " # 1 0 0", " 1 # 0 0", " 1 1 #1"}) {
        const auto m = load("v 0 0 0" + std::string(rest) + "\nv 1 0 0\nv 0 1 0\nvn 1 0 0 1 1 1\nf 1 2 3\n");
        ASSERT_TRUE(m) << errors();
        EXPECT_THAT(m->colors, IsEmpty()) << rest;
        EXPECT_THAT(warnings(), IsEmpty()) << rest;
    }
}

TEST_F(ObjColors, ThatAreWrongAreWhiteOrCutOff)
{
    const auto m =
        load("v 0 0 0\nv 1 0 0 1 0 0\nv 0 1 0 nan 0 0\nv 1 1 0 0 x 0\nv 2 0 0 1 -1 .5\nv 3 0 0 1\nf 1 2 3\nf 2 4 3\n");
    ASSERT_TRUE(m) << errors();
    EXPECT_THAT(m->colors, ElementsAre(Color{1, 1, 1}, Color{1, 0, 0}, Color{1, 1, 1}, Color{1, 1, 1},
                                       Color{1, 0, 0.5f}, Color{1, 1, 1}));
    EXPECT_THAT(
        warnings(),
        ElementsAre("a.obj:1: warning: vertex without a colour among such that have one: white is taken (2 times)",
                    "a.obj:3: warning: vertex colour is not finite numbers: white is taken (2 times)",
                    "a.obj:5: warning: vertex colour outside of its range cut off"));
}

TEST_F(ObjColors, AboveOneAreBytes)
{
    const auto m = load("v 0 0 0 255 51 0\nv 1 0 0\nv 0 1 0 1 0 300\nf 1 2 3\n");
    ASSERT_TRUE(m) << errors();
    EXPECT_THAT(m->colors, ElementsAre(Color{1, 0.2f, 0}, Color{1, 1, 1}, Color{1 / 255.0f, 0, 1}));
    EXPECT_THAT(warnings(),
                ElementsAre("a.obj:2: warning: vertex without a colour among such that have one: white is taken",
                            "a.obj:1: warning: vertex colour above 1: all colours are divided by 255 (2 times)",
                            "a.obj:3: warning: vertex colour outside of its range cut off"));
}

}  // namespace
}  // namespace lancer
