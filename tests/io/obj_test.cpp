#include "io/obj/obj.h"

#include "io/obj/scan.h"
#include "obj_test_support.h"

namespace lancer {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using Obj = ObjTest;

TEST_F(Obj, PositionsAreDoubleAndTrianglesKeepTheirOrder)
{
    const auto m = load(
        "# comment\no thing\ng group\ns off\nv 0.1 0 0\nv 1 .5 -0\nv\t0 1e0 2. # top\n"
        "v 1 1 1 0.5\nv 2 0 1 1 0.5\n\nf 1 2 3\nf 3 2 4\nf 5 1 2 # last\n");
    ASSERT_TRUE(m) << errors();
    ASSERT_EQ(m->positions.size(), 5u);
    EXPECT_EQ(m->positions[0].x, 0.1);  // not 0.1f
    EXPECT_EQ(m->positions[1], (Vec3d{1, 0.5, 0}));
    EXPECT_EQ(m->positions[2], (Vec3d{0, 1, 2}));
    EXPECT_EQ(m->positions[4], (Vec3d{2, 0, 1}));
    EXPECT_THAT(m->triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 3}, Triangle{4, 0, 1}));
    EXPECT_THAT(m->normals, IsEmpty());
    EXPECT_THAT(m->normal_triangles, IsEmpty());
    EXPECT_THAT(m->face_material, IsEmpty());
    ASSERT_EQ(m->materials.size(), 1u);
    EXPECT_EQ(m->materials[0].name, "default");
    EXPECT_EQ(m->materials[0].base_color, (Color{0.8f, 0.8f, 0.8f}));
    EXPECT_THAT(warnings(), IsEmpty());
}

TEST_F(Obj, EveryFormOfCornerIsRead)
{
    const std::string all = square + "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 2\nvn 0 1 0\n";
    for (const char* face :
         {"f 1//1 2//2 3//1", "f 1/1/1 2/2/2 3/3/1", "f -4//-2 -3//-1 -2//1", "f 1//-2 2/3/-1 -2//1"}) {
        const auto m = load(all + face + "\n");
        ASSERT_TRUE(m) << errors();
        EXPECT_THAT(m->triangles, ElementsAre(Triangle{0, 1, 2})) << face;
        EXPECT_THAT(m->normals, ElementsAre(Vec3{0, 0, 1}, Vec3{0, 1, 0}));
        EXPECT_THAT(m->normal_triangles, ElementsAre(Triangle{0, 1, 0})) << face;
    }
    for (const char* face : {"f 1 2 3", "f 1/1 2/2 3/3", "f 1// 2// 3//", "f 1/ 2/ 3/", "f 1/1/ 2/2/ 3/3/"}) {
        const auto m = load(all + face + "\n");
        ASSERT_TRUE(m) << errors();
        EXPECT_THAT(m->triangles, ElementsAre(Triangle{0, 1, 2})) << face;
        EXPECT_THAT(m->normals, IsEmpty()) << face;
        EXPECT_THAT(m->normal_triangles, IsEmpty()) << face;
    }
}

TEST_F(Obj, AnIndexLeftOutIsNotThatOfTheNextCorner)
{
    const auto m = load(square + "vn 0 0 1\nvn 0 1 0\nvn 1 0 0\nf 1//1 2//1 3//1\nf 1// 2// 3//\nf 1//1 2// 3//2\n");
    ASSERT_TRUE(m) << errors();
    constexpr uint32_t no = MeshData::no_normal;
    EXPECT_THAT(m->normal_triangles, ElementsAre(Triangle{0, 0, 0}, Triangle{no, no, no}, Triangle{no, no, no}));
    EXPECT_THAT(warnings(),
                ElementsAre("a.obj:10: warning: face with normals at some corners only: they are ignored there"));
}

TEST_F(Obj, LineEndsByteOrderMarkAndContinuations)
{
    const std::vector<std::string> texts{
        "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n",
        "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3",
        "\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3",
        "v 0 \\\n0 0\nv 1 0 0\nv 0 1 0\nf 1 \\\r\n 2\\\n3\n",
        "# a folder C:\\dir\\\nv 0 0 0\n  v 1 0 0  \n\tv 0 1 0\t\nf  1\t2  3 \\",
    };
    for (const std::string& text : texts) {
        const auto m = load(text);
        ASSERT_TRUE(m) << text << errors();
        EXPECT_EQ(m->positions, (std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})) << text;
        EXPECT_THAT(m->triangles, ElementsAre(Triangle{0, 1, 2})) << text;
    }
    EXPECT_EQ(error_of("v 0 \\\n0 0\r\nv 1 0 0\nv 0 1 0\r\n\r\nf 1 2 \\\n9"),
              "a.obj:6: error: face index 9 is out of range: the file has 3 vertices");
}

TEST_F(Obj, IndicesOutOfRangeAreErrorsWithTheirLine)
{
    const std::pair<const char*, const char*> cases[] = {
        {"f 1 2 99", "a.obj:4: error: face index 99 is out of range: the file has 3 vertices"},
        {"f 1 2 4", "a.obj:4: error: face index 4 is out of range: the file has 3 vertices"},
        {"f 1 2 -4", "a.obj:4: error: face index -4 is out of range: 3 vertices come before it"},
        {"f 1 2 0", "a.obj:4: error: face index 0: indices start at 1"},
        {"f 1 2 2147483648", "a.obj:4: error: face index 2147483648 is out of range: the file has 3 vertices"},
        {"f 1 2 4294967299", "a.obj:4: error: face index 4294967299 is out of range: the file has 3 vertices"},
        {"f 1 2 -4294967295", "a.obj:4: error: face index -4294967295 is out of range: 3 vertices come before it"},
        {"f 1 2 18446744073709551617",
         "a.obj:4: error: face index 18446744073709551617 is out of range: the file has 3 vertices"},
        {"vt 0 0\nf 1/2 2 3",
         "a.obj:5: error: face texture index 2 is out of range: the file has 1 texture coordinate"},
        {"f 1//2 2 3\nvn 0 0 1", "a.obj:4: error: face normal index 2 is out of range: the file has 1 normal"},
        {"vn 0 0 1\nf 1//-2 2 3", "a.obj:5: error: face normal index -2 is out of range: 1 normal comes before it"},
        {"f 1 2 x", "a.obj:4: error: face index 'x' is not an integer"},
        {"f 1 2 3.5", "a.obj:4: error: face index '3.5' is not an integer"},
        {"f 1 2 /3", "a.obj:4: error: face corner '/3' is not an index like 1, 1/2, 1//3 or 1/2/3"},
        {"f 1 2 3///", "a.obj:4: error: face corner '3///' is not an index like 1, 1/2, 1//3 or 1/2/3"},
        {"f 1 9", "a.obj:4: error: face index 9 is out of range: the file has 3 vertices"},
    };
    for (const auto& [face, message] : cases) EXPECT_EQ(error_of(corners + face + "\n"), message);
    EXPECT_EQ(error_of("f -1 1 2\n" + corners + "f 1 2 3\nf 4 5 1\n"),
              "a.obj:1: error: face index -1 is out of range: 0 vertices come before it\n"
              "a.obj:6: error: face index 4 is out of range: the file has 3 vertices");
}

TEST_F(Obj, IndicesMayReferForward)
{
    const auto m = load(
        "f 1 2 3\nf 1//1 2//1 3//1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 1 1 0\nvn 0 0 1\n"
        "f -3//-1 -1//-1 -2//-1\n");
    ASSERT_TRUE(m) << errors();
    EXPECT_EQ(m->positions.size(), 4u);
    EXPECT_THAT(m->triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 1, 2}, Triangle{0, 1, 2}, Triangle{1, 3, 2}));
    constexpr uint32_t no = MeshData::no_normal;
    EXPECT_THAT(m->normal_triangles,
                ElementsAre(Triangle{no, no, no}, Triangle{0, 0, 0}, Triangle{no, no, no}, Triangle{0, 0, 0}));
}

TEST_F(Obj, NumbersAreChecked)
{
    const std::pair<const char*, const char*> cases[] = {
        {"v 0 0 nan", "a.obj:1: error: 'nan' is not a finite number"},
        {"v -inf 0 0", "a.obj:1: error: '-inf' is not a finite number"},
        {"v 1.#QNAN 0 0", "a.obj:1: error: '1.#QNAN' is not a finite number"},
        {"v 0 1e400 0", "a.obj:1: error: '1e400' is not a finite number"},
        {"v 0 0e999 0", "a.obj:1: error: '0e999' is not a finite number"},
        {"v 0 1e99999999999999999999 0", "a.obj:1: error: '1e99999999999999999999' is not a finite number"},
        {"v 0 0 1,5", "a.obj:1: error: '1,5' is not a number"},
        {"v 0 0 1.5e", "a.obj:1: error: '1.5e' is not a number"},
        {"v 0 0 .", "a.obj:1: error: '.' is not a number"},
        {"v 0 0 0x10", "a.obj:1: error: '0x10' is not a number"},
        {"v 0 0 \x01z", "a.obj:1: error: '?z' is not a number"},
        {"v 0 0", "a.obj:1: error: v needs 3 numbers, has 2"},
        {"v 0 # 0 0", "a.obj:1: error: v needs 3 numbers, has 1"},
    };
    for (const auto& [line, message] : cases) EXPECT_EQ(error_of(line + ("\n" + corners) + "f 1 2 3\n"), message);
    EXPECT_EQ(error_of("v " + std::string(400, '9') + " 0 0\nf 1 1 1"),
              "a.obj:1: error: '" + std::string(200, '9') + "...' is not a finite number");

    const auto m = load("v 1e-400 -1e-99999999999 1e300\nv +1 2.e1 -.5E+1\nv 0." + std::string(400, '1') +
                        " 1 0 nan nan nan\nv 3 0 0\nf 1 2 3\nf 2 3 4\n");
    ASSERT_TRUE(m) << errors();
    EXPECT_EQ(m->positions[0], (Vec3d{0, 0, m->positions[0].z}));
    EXPECT_NEAR(m->positions[0].z / 1e300, 1, 1e-14);
    EXPECT_EQ(m->positions[1], (Vec3d{1, 20, -5}));
    EXPECT_NEAR(m->positions[2].x, 1.0 / 9, 1e-15);
}

TEST_F(Obj, AFileWithoutAFaceIsAnError)
{
    EXPECT_EQ(error_of(""), "a.obj: error: the file is empty");
    EXPECT_EQ(error_of("\n\n"), "a.obj: error: the file has no face");
    EXPECT_EQ(error_of(corners), "a.obj: error: the file has no face");
    EXPECT_EQ(error_of(corners + "f 1 2\nf\n"), "a.obj: error: the file has no face");
    EXPECT_EQ(error_of(corners + "f 1 1 2\n"), "a.obj: error: no face has an area");
    EXPECT_EQ(error_of(corners + "l 1 2\np 1\n"), "a.obj: error: the file has no face");
    EXPECT_EQ(error_of(std::string("v 0 0 0\nf 1 1 1\0\n", 17)), "a.obj: error: not an OBJ file: it holds NUL bytes");
    EXPECT_EQ(error_of("\x89PNG\r\n\x1a\n\xff\xfe\xfd"), "a.obj: error: the file has no face");
}

TEST_F(Obj, FilesThatCannotBeRead)
{
    EXPECT_EQ(load_obj((folder_ / "none.obj").string(), diagnostics_), nullptr);
    EXPECT_EQ(errors(), "none.obj: error: no such file");
    try {
        diagnostics_.throw_if_errors();
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::missing_input);
    }
    diagnostics_ = {};
    EXPECT_EQ(load_obj("/", diagnostics_), nullptr);
    EXPECT_EQ(errors(), "/: error: is a folder, not a file");
    diagnostics_ = {};
    EXPECT_EQ(load_obj("/dev/zero", diagnostics_), nullptr);
    EXPECT_EQ(errors(), "/dev/zero: error: not a regular file");
}

TEST_F(Obj, LimitsAreErrors)
{
    const auto scan_error = [&](const std::string& text, const ObjLimits& limits) {
        diagnostics_ = {};
        EXPECT_FALSE(scan_obj(text, "a.obj", diagnostics_, limits));
        return errors();
    };
    EXPECT_EQ(scan_error(corners + "f 1 2 3\n", {.vertices = 2}),
              "a.obj: error: more than 2 vertices, normals or texture coordinates");
    EXPECT_EQ(scan_error(square + "f 1 2 3 4\n", {.triangles = 1}), "a.obj: error: more than 1 triangles");
    EXPECT_EQ(scan_error(square + "f 1 2 3 4\n", {.corners_of_face = 3}),
              "a.obj:5: error: a face with 4 corners; at most 3 are supported");
    EXPECT_EQ(scan_error("mtllib a\nmtllib a\nmtllib b\n" + corners + "f 1 2 3\n", {.libraries = 1}),
              "a.obj:3: error: more than 1 mtllib files");
}

TEST_F(Obj, FacesWithoutAreaAreDroppedAndCounted)
{
    // Repeated, collinear on axes, collinear with rounding far from the origin, too short.
    const auto m = load(
        "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1000.1 0.1 3\nv 1000.2 0.2 3\nv 1000.4 0.4 3\n"
        "f 1 1 2\nf 1 2 3\nf 5 6 7\nf 1 2\nf 1 2 4\nf 1 2 3 2\nf 2\n");
    ASSERT_TRUE(m) << errors();
    EXPECT_THAT(m->triangles, ElementsAre(Triangle{0, 1, 3}));
    EXPECT_THAT(warnings(), ElementsAre("a.obj:11: warning: face with fewer than 3 corners dropped (2 times)",
                                        "a.obj:8: warning: zero-area face dropped (4 times)"));
    const auto tiny = load("v 1000 0 0\nv 1000.000000001 0 0\nv 1000 0.000000001 0\nf 1 2 3\n");
    ASSERT_TRUE(tiny) << errors();
    EXPECT_EQ(tiny->triangles.size(), 1u);
}

TEST_F(Obj, NormalsAreUnitOrAbsent)
{
    const auto m = load(square +
                        "vn 0 0 1e-200\nvn 0 0 0\nvn 3e200 4e200 0\nvn -0 0 0\n"
                        "f 1//1 2//1 3//3\nf 1//1 2//2 3//1\nf 1//1 2 3//1\nf 1 2 3\n");
    ASSERT_TRUE(m) << errors();
    EXPECT_EQ(m->normals[0], (Vec3{0, 0, 1}));
    EXPECT_EQ(m->normals[2], (Vec3{0.6f, 0.8f, 0}));
    for (const Vec3& n : m->normals) EXPECT_NEAR(length(n), 1, 1e-6);
    constexpr uint32_t no = MeshData::no_normal;
    EXPECT_THAT(m->normal_triangles,
                ElementsAre(Triangle{0, 0, 2}, Triangle{no, no, no}, Triangle{no, no, no}, Triangle{no, no, no}));
    EXPECT_THAT(
        warnings(),
        ElementsAre(
            "a.obj:6: warning: vn of zero length or not of three finite numbers; faces that use it are flat (2 times)",
            "a.obj:11: warning: face with normals at some corners only: they are ignored there"));

    const auto flat = load(square + "vn 0 0 0\nf 1//1 2//1 3//1\n");
    ASSERT_TRUE(flat) << errors();
    EXPECT_THAT(flat->normals, IsEmpty());
    EXPECT_THAT(flat->normal_triangles, IsEmpty());
}

// Cinema 4D writes 0 for none, others write indices of attributes that they did not export.
TEST_F(Obj, AttributesThatAreNotThereAreIgnored)
{
    constexpr uint32_t no = MeshData::no_normal;
    const auto m = load(square + "vn 0 0 1\nf 1/1/1 2/2/1 3/3/1\nf 1/1/0 3/3/0 4/4/0\nf 1/0/1 3/0/1 4/0/1\n");
    ASSERT_TRUE(m) << errors();
    EXPECT_THAT(m->normal_triangles, ElementsAre(Triangle{0, 0, 0}, Triangle{no, no, no}, Triangle{0, 0, 0}));
    EXPECT_THAT(warnings(),
                ElementsAre("a.obj:6: warning: texture index ignored: the file has no vt (6 times)",
                            "a.obj:7: warning: index 0 of a texture coordinate or normal ignored (6 times)"));
    const auto no_normals = load(square + "f 1//1 2//2 3//99\nf 1//-1 3//0 4\n");
    ASSERT_TRUE(no_normals) << errors();
    EXPECT_EQ(no_normals->triangles.size(), 2u);
    EXPECT_THAT(no_normals->normals, IsEmpty());
    EXPECT_THAT(warnings(), ElementsAre("a.obj:5: warning: normal index ignored: the file has no vn (4 times)",
                                        "a.obj:6: warning: index 0 of a texture coordinate or normal ignored"));
}

TEST_F(Obj, NormalsThatAreNoNumbersAreDropped)
{
    constexpr uint32_t no = MeshData::no_normal;
    const auto m = load(square +
                        "vn 0 0 1\nvn nan nan nan\nvn -nan(ind) 0 0\nvn 0 0\nvn\nvn 1 0 0\n"
                        "f 1//1 2//2 3//1\nf 1//6 3//6 4//6\nf 1//3 2//3 3//3\n");
    ASSERT_TRUE(m) << errors();
    EXPECT_EQ(m->normals[5], (Vec3{1, 0, 0}));
    EXPECT_THAT(m->normal_triangles, ElementsAre(Triangle{no, no, no}, Triangle{5, 5, 5}, Triangle{no, no, no}));
    EXPECT_THAT(warnings(), ElementsAre("a.obj:6: warning: vn of zero length or not of three finite numbers; faces "
                                        "that use it are flat (4 times)"));
}

TEST_F(Obj, MayBeWrittenInUtf16)
{
    const std::string text = corners + "usemtl \xC3\xA9\nf 1 2 3\n";
    for (const bool little : {true, false})
        for (const bool marked : {true, false}) {
            std::string wide;
            const auto add = [&](uint32_t unit) {
                const char low = static_cast<char>(unit & 0xFF), high = static_cast<char>(unit >> 8);
                wide += little ? low : high;
                wide += little ? high : low;
            };
            if (marked) add(0xFEFF);
            for (const char c : corners + "usemtl ") add(static_cast<uint8_t>(c));
            add(0xE9);
            for (const char c : std::string("\nf 1 2 3\n")) add(static_cast<uint8_t>(c));
            const auto m = load(wide);
            ASSERT_TRUE(m) << errors();
            EXPECT_EQ(m->positions.size(), 3u);
            EXPECT_THAT(warnings(),
                        ElementsAre("a.obj:4: warning: unknown material '\xC3\xA9'; the default grey is used"));
        }
}

TEST_F(Obj, OtherStatementsAreIgnored)
{
    const auto m = load("mg 1\nlod 2\n" + corners + "l 1 2\np 1 2\nf 1 2 3\ncurv 0 1 1 2\nend\n");
    ASSERT_TRUE(m) << errors();
    EXPECT_THAT(warnings(), ElementsAre("a.obj:9: warning: statement of an unknown kind ignored (2 times)",
                                        "a.obj:6: warning: line or point ignored (2 times)"));
}

}  // namespace
}  // namespace lancer
