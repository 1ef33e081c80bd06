#include "io/obj.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "io/obj_scan.h"

namespace lancer {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Triangle = std::array<uint32_t, 3>;

// A new folder for each test; messages are compared without its path.
class Obj : public testing::Test {
protected:
    void SetUp() override
    {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::path(testing::TempDir()) / ("lancer_obj_" + std::string(info->name()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string write(const std::string& name, const std::string& text)
    {
        fs::remove(folder_ / name);  // overwriting makes some file systems wait for the disk
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return (folder_ / name).string();
    }
    std::shared_ptr<const MeshData> load(const std::string& text)
    {
        diagnostics_ = {};
        return load_obj(write("a.obj", text), diagnostics_);
    }
    std::shared_ptr<const MeshData> load_with(const std::string& mtl, const std::string& uses)
    {
        write("a.mtl", mtl);
        return load("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n" + uses);
    }
    std::string relative(std::string text) const
    {
        const std::string prefix = folder_.string() + "/";
        for (size_t at; (at = text.find(prefix)) != std::string::npos;) text.erase(at, prefix.size());
        return text;
    }
    std::vector<std::string> warnings() const
    {
        std::vector<std::string> all;
        for (const auto& w : diagnostics_.warnings()) all.push_back(relative(to_string(w)));
        return all;
    }
    std::string errors() const
    {
        try {
            diagnostics_.throw_if_errors();
        } catch (const Error& e) {
            return relative(e.what());
        }
        return "";
    }
    std::string error_of(const std::string& text)
    {
        EXPECT_EQ(load(text), nullptr) << text;
        return errors();
    }

    fs::path folder_;
    Diagnostics diagnostics_;
};

const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST_F(Obj, PositionsAreDoubleAndTrianglesKeepTheirOrder)
{
    const auto m = load(
        "# comment\no thing\ng group\ns 1\nv 0.1 0 0\nv 1 .5 -0\nv\t0 1e0 2. # top\n"
        "v 1 1 1 0.5\nv 2 0 1 1 0.5 0.25\n\nf 1 2 3\nf 3 2 4\nf 5 1 2 # last\n");
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
        {"f 1/1 2 3", "a.obj:4: error: face texture index 1 is out of range: the file has 0 texture coordinates"},
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
        {"vn nan 0 0", "a.obj:1: error: 'nan' is not a finite number"},
        {"vn 0 0", "a.obj:1: error: vn needs 3 numbers, has 2"},
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
    for (const char* path : {"/", "/dev/zero"}) {
        diagnostics_ = {};
        EXPECT_EQ(load_obj(path, diagnostics_), nullptr);
        EXPECT_EQ(errors(), std::string(path) + ": error: not a regular file");
    }
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
    EXPECT_THAT(warnings(),
                ElementsAre("a.obj:6: warning: normal of zero length ignored (2 times)",
                            "a.obj:11: warning: face with normals at some corners only: they are ignored there"));

    const auto flat = load(square + "vn 0 0 0\nf 1//1 2//1 3//1\n");
    ASSERT_TRUE(flat) << errors();
    EXPECT_THAT(flat->normals, IsEmpty());
    EXPECT_THAT(flat->normal_triangles, IsEmpty());
}

TEST_F(Obj, OtherStatementsAreIgnored)
{
    const auto m = load("mg 1\nlod 2\n" + corners + "l 1 2\np 1 2\nf 1 2 3\ncurv 0 1 1 2\nend\n");
    ASSERT_TRUE(m) << errors();
    EXPECT_THAT(warnings(), ElementsAre("a.obj:9: warning: statement of an unknown kind ignored (2 times)",
                                        "a.obj:6: warning: line or point ignored (2 times)"));
}

TEST_F(Obj, MaterialsAreAssignedInOrderOfUse)
{
    const auto m = load_with(
        "newmtl red # one\r\nKd 1 0 0 # Red\r\n\nnewmtl unused\nKd 0 0 0\nnewmtl two words\n"
        "\tKd 0.25\n Ke 17 12 4\nnewmtl lamp\nKe 1 2 3\nnewmtl dark\nKe 0 0 0\n",
        "f 1 2 3\nusemtl two words\nf 1 2 3\nusemtl red\nf 1 2 3\nf 1 2 3\nusemtl lamp\nf 1 1 1\n"
        "usemtl two words\nf 1 2 3\nusemtl dark\nf 1 2 3\n");
    ASSERT_TRUE(m) << errors();
    ASSERT_EQ(m->materials.size(), 4u);
    EXPECT_THAT(m->face_material, ElementsAre(0, 1, 2, 2, 1, 3));
    EXPECT_EQ(m->materials[0].name, "default");
    EXPECT_EQ(m->materials[1].name, "two words");
    EXPECT_EQ(relative(to_string(m->materials[1].where)), "a.mtl:6");
    EXPECT_EQ(m->materials[1].base_color, (Color{0.25f, 0.25f, 0.25f}));
    EXPECT_EQ(m->materials[1].emission, (Color{17, 12, 4}));
    EXPECT_EQ(m->materials[2].name, "red");
    EXPECT_EQ(m->materials[2].type, MaterialType::lambert);
    EXPECT_EQ(m->materials[2].base_color, (Color{1, 0, 0}));
    EXPECT_EQ(m->materials[3].base_color, (Color{0.8f, 0.8f, 0.8f}));
    EXPECT_THAT(warnings(), ElementsAre("a.obj:12: warning: zero-area face dropped"));

    const auto lamp = load("mtllib a.mtl\n" + corners + "usemtl lamp\nf 1 2 3\n");
    ASSERT_TRUE(lamp);
    EXPECT_THAT(lamp->face_material, IsEmpty());
    EXPECT_EQ(lamp->materials[0].base_color, Color{});
    EXPECT_EQ(lamp->materials[0].emission, (Color{1, 2, 3}));
}

TEST_F(Obj, MaterialValuesAreChecked)
{
    const auto m = load_with(
        "Kd 1 1 1\nnewmtl a\nKd -1 0.5 2\nKe -1 2 1e39\nnewmtl b\nKd nan 0 0\nKe inf 1 1\n"
        "newmtl c\nKd 1 1\nKe spectral x.rfl 1\nnewmtl d\nKd 0 0 1e400\nnewmtl e\nKd 0 0 1.5\n",
        "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\nusemtl d\nf 1 2 3\n");
    ASSERT_TRUE(m) << errors();
    EXPECT_EQ(m->materials[0].base_color, (Color{0, 0.5f, 1}));
    EXPECT_EQ(m->materials[0].emission, (Color{0, 2, std::numeric_limits<float>::max()}));
    for (size_t i = 1; i < 4; ++i) {
        EXPECT_EQ(m->materials[i].base_color, (Color{0.8f, 0.8f, 0.8f}));
        EXPECT_EQ(m->materials[i].emission, Color{});
    }
    EXPECT_THAT(warnings(), ElementsAre("a.mtl:6: warning: Kd is not three finite numbers; ignored (3 times)",
                                        "a.mtl:7: warning: Ke is not three finite numbers; ignored (2 times)",
                                        "a.mtl:1: warning: statement before the first newmtl ignored",
                                        "a.mtl:4: warning: Ke below 0 or beyond float clamped",
                                        "a.mtl:3: warning: Kd outside [0, 1] clamped (2 times)"));
}

TEST_F(Obj, UnknownAndRepeatedMaterialsAreCounted)
{
    const auto m = load_with("newmtl a\nKd 1 0 0\nnewmtl a\nKd 0 1 0\n",
                             "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl\nf 1 2 3\n");
    ASSERT_TRUE(m) << errors();
    ASSERT_EQ(m->materials.size(), 2u);
    EXPECT_EQ(m->materials[0].base_color, (Color{1, 0, 0}));
    EXPECT_EQ(m->materials[1].name, "default");
    EXPECT_THAT(m->face_material, ElementsAre(0, 1, 1, 1));
    EXPECT_THAT(warnings(), ElementsAre("a.mtl:3: warning: material of this name exists already; the first is used",
                                        "a.obj:7: warning: unknown material 'b'; the default grey is used (2 times)",
                                        "a.obj:11: warning: unknown material ''; the default grey is used"));
    std::string many = corners;
    for (int i = 0; i < 30; ++i) many += "usemtl m" + std::to_string(i) + "\nf 1 2 3\n";
    EXPECT_TRUE(load(many));
    EXPECT_EQ(warnings().size(), 11u);
    EXPECT_EQ(warnings().back(), "a.obj:24: warning: unknown material; the default grey is used (20 times)");
}

TEST_F(Obj, ManyMaterialsKeepTheirOwnValues)
{
    std::string mtl, uses;
    for (int i = 0; i < 2500; ++i) {
        mtl += "newmtl m" + std::to_string(i) + "\nKd " + std::to_string(i / 2500.0) + " 0 0\n";
        uses += "usemtl m" + std::to_string(2499 - i) + "\nf 1 2 3\n";
    }
    const auto m = load_with(mtl, uses);
    ASSERT_TRUE(m) << errors();
    ASSERT_EQ(m->materials.size(), 2500u);
    for (const size_t i : {0u, 1499u, 1500u, 2499u}) {
        EXPECT_EQ(m->face_material[i], i);
        EXPECT_NEAR(m->materials[i].base_color.r, static_cast<double>(2499 - i) / 2500.0, 1e-6);
        EXPECT_EQ(m->materials[i].where.line, 2 * (2499 - i) + 1);
    }
}

TEST_F(Obj, MaterialFilesAreFoundByManyNames)
{
    write("one.mtl", "newmtl one\nKd 1 0 0\n");
    write("my file.mtl", "newmtl spaced\nKd 0 1 0\n");
    write("Upper.MTL", "newmtl upper\nKd 0 0 1\n");
    fs::create_directories(folder_ / "sub");
    write("sub/deep.mtl", "\xEF\xBB\xBFnewmtl deep\nKd 1 1 0\n");
    const std::string uses = corners +
                             "usemtl one\nf 1 2 3\nusemtl spaced\nf 1 2 3\nusemtl upper\nf 1 2 3\n"
                             "usemtl deep\nf 1 2 3\n";
    const std::string other_case = ": warning: material file 'upper.mtl' not found; 'Upper.MTL' is used";
    for (const std::string& libraries :
         {std::string("mtllib my file.mtl\nmtllib upper.mtl\nmtllib sub\\deep.mtl\nmtllib one.mtl # c\n"),
          std::string("mtllib upper.mtl my file.mtl sub/deep.mtl one.mtl one.mtl\n")}) {
        const auto m = load(uses + libraries + libraries);  // after their use, and repeated: no matter
        ASSERT_TRUE(m) << errors();
        ASSERT_EQ(m->materials.size(), 4u);
        EXPECT_EQ(m->materials[1].base_color, (Color{0, 1, 0}));
        EXPECT_EQ(m->materials[2].base_color, (Color{0, 0, 1}));
        EXPECT_EQ(m->materials[3].base_color, (Color{1, 1, 0}));
        ASSERT_EQ(warnings().size(), 1u) << libraries;
        EXPECT_THAT(warnings()[0], HasSubstr(other_case));
    }
    EXPECT_TRUE(load(uses + "mtllib no such.mtl one.mtl sub\nmtllib\n"));
    EXPECT_THAT(warnings(), testing::IsSupersetOf({"a.obj:12: warning: material file 'no such.mtl' not found",
                                                   "a.obj:12: warning: material file 'sub' not found",
                                                   "a.obj:13: warning: mtllib without a file name"}));
    write("binary.mtl", std::string("newmtl one\n\0\n", 13));
    EXPECT_TRUE(load(corners + "mtllib binary.mtl\nf 1 2 3"));
    EXPECT_THAT(warnings(), ElementsAre("binary.mtl: warning: ignored: it holds NUL bytes"));
}

TEST_F(Obj, TheHashIsOfAllBytesRead)
{
    const auto hash = [&](const std::string& mtl, const std::string& obj) {
        const auto m = load_with(mtl, obj);
        EXPECT_TRUE(m);
        return m ? m->content_hash : 0;
    };
    const uint64_t first = hash("newmtl a\n", "f 1 2 3\n");
    EXPECT_NE(first, 0u);
    EXPECT_EQ(first, hash("newmtl a\n", "f 1 2 3\n"));
    EXPECT_NE(first, hash("newmtl b\n", "f 1 2 3\n"));
    EXPECT_NE(first, hash("newmtl a\n", "f 1 2 3\n\n"));
}

// Polygons, as seen by a whole load: the area is that of the outline and every triangle faces its way.
class Polygon : public Obj {
protected:
    struct Result {
        size_t triangles = 0;
        double area = 0, smallest = 0;  // signed, along z
    };
    Result polygon(const std::vector<Vec3d>& outline)
    {
        std::string text;
        char line[200];
        for (const Vec3d& p : outline) {
            std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", p.x, p.y, p.z);
            text += line;
        }
        text += "f";
        for (size_t i = 1; i <= outline.size(); ++i) text += " " + std::to_string(i);
        const auto m = load(text + "\n");
        EXPECT_TRUE(m) << errors();
        Result r;
        if (!m) return r;
        r.triangles = m->triangles.size();
        r.smallest = 1e300;
        for (const Triangle& t : m->triangles) {
            const Vec3d a = m->positions[t[0]], b = m->positions[t[1]], c = m->positions[t[2]];
            const double area = cross(b - a, c - a).z / 2;
            r.area += area;
            r.smallest = std::min(r.smallest, area);
        }
        return r;
    }
    static std::vector<Vec3d> star(size_t n, double inner, Vec3d center = {})
    {
        std::vector<Vec3d> p;
        for (size_t i = 0; i < n; ++i) {
            const double angle = 2 * 3.14159265358979323846 * static_cast<double>(i) / static_cast<double>(n);
            const double r = i % 2 ? inner : 1;
            p.push_back(center + Vec3d{r * std::cos(angle), r * std::sin(angle), 0});
        }
        return p;
    }
    static double shoelace(const std::vector<Vec3d>& p)
    {
        double a = 0;
        for (size_t i = 2; i < p.size(); ++i) a += cross(p[i - 1] - p[0], p[i] - p[0]).z / 2;
        return a;
    }
};

TEST_F(Polygon, QuadsAreSplitAlongTheDiagonalInside)
{
    EXPECT_THAT(load(square + "f 1 2 3 4\n")->triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
    // An arrow with its notch at the second corner, then at the first.
    const std::string arrow = "v 0 0 0\nv 0.2 0.2 0\nv 1 0 0\nv 0 1 0\n";
    EXPECT_THAT(load(arrow + "f 1 2 3 4\n")->triangles, ElementsAre(Triangle{0, 1, 3}, Triangle{1, 2, 3}));
    EXPECT_THAT(load(arrow + "f 2 3 4 1\n")->triangles, ElementsAre(Triangle{1, 2, 3}, Triangle{1, 3, 0}));
    EXPECT_THAT(load(arrow + "f 4 3 2 1\n")->triangles, ElementsAre(Triangle{3, 2, 1}, Triangle{3, 1, 0}));
    // A corner on a straight edge.
    const std::string straight = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 1 1 0\n";
    EXPECT_THAT(load(straight + "f 1 2 3 4\n")->triangles, ElementsAre(Triangle{0, 1, 3}, Triangle{1, 2, 3}));
    EXPECT_THAT(load(square + "f 1 2 2 3\n")->triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST_F(Polygon, ConcavePolygonsKeepTheirArea)
{
    for (const size_t n : {5u, 6u, 16u, 255u, 256u, 257u, 300u, 512u, 10'000u})
        for (const double inner : {1.0, 0.3}) {
            const auto outline = star(n, inner);
            const Result r = polygon(outline);
            EXPECT_EQ(r.triangles, n - 2) << n;
            EXPECT_NEAR(r.area, shoelace(outline), 1e-9) << n;
            EXPECT_GT(r.smallest, 0) << n << ' ' << inner;
        }
    const std::vector<Vec3d> comb{{0, 0, 0}, {9, 0, 0}, {9, 5, 0}, {8, 1, 0}, {7, 5, 0}, {6, 1, 0}, {5, 5, 0},
                                  {4, 1, 0}, {3, 5, 0}, {2, 1, 0}, {1, 5, 0}, {1, 1, 0}, {0, 1, 0}};
    Result r = polygon(comb);
    EXPECT_NEAR(r.area, shoelace(comb), 1e-12);
    EXPECT_GT(r.smallest, 0);
    // A square with a square hole, joined by a bridge that is run along twice.
    const std::vector<Vec3d> hole{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0},
                                  {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}};
    r = polygon(hole);
    EXPECT_NEAR(r.area, 8, 1e-12);
    EXPECT_GT(r.smallest, 0);
    r = polygon(star(50, 0.4, {100000, -50000, 7}));
    EXPECT_NEAR(r.area, shoelace(star(50, 0.4)), 1e-8);
    std::vector<Vec3d> tiny = star(50, 0.4);
    for (Vec3d& p : tiny) p *= 1e-200;
    EXPECT_EQ(polygon(tiny).triangles, 48u);
}

TEST_F(Polygon, HugeAndSelfCrossingPolygonsEnd)
{
    const auto big = star(70'000, 0.5);
    const Result r = polygon(big);
    EXPECT_EQ(r.triangles, big.size() - 2);
    EXPECT_NEAR(r.area, shoelace(big), 1e-6);
    std::vector<Vec3d> teeth{{0, 0, 0}, {0, -25'000, 0}};
    for (int i = 24'999; i > 0; --i) {
        teeth.push_back({100, -i - 0.5, 0});
        teeth.push_back({1, -i * 1.0, 0});
    }
    std::reverse(teeth.begin(), teeth.end());
    const Result comb = polygon(teeth);
    EXPECT_EQ(comb.triangles, teeth.size() - 2);
    EXPECT_NEAR(comb.area / shoelace(teeth), 1, 1e-9);
    std::vector<Vec3d> pentagram, tangle;
    for (int i = 0; i < 5; ++i) pentagram.push_back(star(5, 1)[static_cast<size_t>(2 * i % 5)]);
    EXPECT_LE(polygon(pentagram).triangles, 3u);
    for (size_t i = 0; i < 2000; ++i) tangle.push_back(star(2000, 0.7)[i * 617 % 2000]);
    EXPECT_LE(polygon(tangle).triangles, 1998u);
    EXPECT_EQ(error_of("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 4 0 0\nv 5 0 0\nf 1 2 3 4 5 6\n"),
              "a.obj: error: no face has an area");
}

void expect_valid(const MeshData& m)
{
    EXPECT_FALSE(m.triangles.empty());
    EXPECT_FALSE(m.materials.empty());
    bool right = m.face_material.size() == (m.materials.size() > 1 ? m.triangles.size() : 0);
    right = right && m.normal_triangles.size() == (m.normals.empty() ? 0 : m.triangles.size());
    for (const Vec3d& p : m.positions) right = right && is_finite(p);
    for (const Vec3& n : m.normals) right = right && std::abs(length(n) - 1) < 1e-5f;
    for (const Triangle& t : m.triangles)
        for (const uint32_t i : t) right = right && i < m.positions.size();
    for (const Triangle& t : m.normal_triangles)
        for (const uint32_t i : t) right = right && (i == MeshData::no_normal || i < m.normals.size());
    for (const uint32_t i : m.face_material) right = right && i < m.materials.size();
    for (const MaterialDescription& d : m.materials) {
        right = right && is_finite(d.base_color) && is_finite(d.emission) && max_component(d.base_color) <= 1;
        right = right && std::min({d.base_color.r, d.base_color.g, d.base_color.b, d.emission.r, d.emission.g,
                                   d.emission.b}) >= 0;
    }
    EXPECT_TRUE(right) << m.file;
}

// Real and broken files are not part of the source; the tests pass without them.
fs::path shared_folder()
{
    const char* const named = std::getenv("LANCER_SHARED");
    if (named) return named;
    fs::path up = fs::path(LANCER_SOURCE_DIR);
    for (int i = 0; i < 2; ++i) {
        up = up.parent_path();
        if (fs::is_directory(up / "shared")) return up / "shared";
    }
    return {};
}

TEST(ObjFiles, BrokenFilesGiveAMeshOrAnError)
{
    std::error_code error;
    for (fs::recursive_directory_iterator i(shared_folder() / "malformed", error), end; i != end; ++i) {
        const std::string extension = i->path().extension().string();
        if (!i->is_regular_file() || (extension != ".obj" && extension != ".mtl" && extension != ".off")) continue;
        Diagnostics diagnostics;
        const auto m = load_obj(i->path().string(), diagnostics);
        EXPECT_EQ(m == nullptr, diagnostics.has_errors()) << i->path();
        if (m) expect_valid(*m);
    }
}

TEST_F(Obj, BrokenMaterialFilesGiveAMesh)
{
    std::error_code error;
    for (fs::recursive_directory_iterator i(shared_folder() / "malformed", error), end; i != end; ++i) {
        const std::string extension = i->path().extension().string();
        if (!i->is_regular_file() || (extension != ".obj" && extension != ".mtl")) continue;
        const auto m = load("mtllib " + i->path().string() + "\n" + corners + "usemtl a\nf 1 2 3\n");
        ASSERT_TRUE(m) << i->path() << errors();
        expect_valid(*m);
        for (const std::string& w : warnings()) EXPECT_THAT(w, testing::Not(HasSubstr("not found"))) << w;
    }
}

TEST(ObjFiles, RealFilesHaveTheirCounts)
{
    struct Case {
        const char* file;
        size_t triangles, dropped, materials;
    };
    const Case cases[] = {
        {"meshes/suzanne.obj", 968, 0, 1},
        {"meshes/teapot.obj", 6320, 0, 1},
        {"meshes/stanford-bunny.obj", 69451, 0, 1},
        {"meshes/armadillo.obj", 86482, 0, 1},
        {"meshes/ogre.obj", 124008, 4, 1},
        {"spot/cow.obj", 5856, 0, 1},
        {"spot/spot_quadrangulated.obj", 5856, 0, 1},
        {"cornell/CornellBox-Original.obj", 36, 0, 8},
        {"cornell/CornellBox-Water.obj", 7088, 0, 9},
        {"cornell/cornell_box_specular.obj", 2188, 0, 8},
        {"cornell/cornell_box_glossy.obj", 34, 0, 7},
        {"gopher/gopher.obj", 49792, 0, 7},
        {"anchors/cornell.obj", 32, 0, 4},
    };
    for (const Case& c : cases) {
        const fs::path path = shared_folder() / "scenes" / c.file;
        if (!fs::exists(path)) continue;
        Diagnostics diagnostics;
        const auto m = load_obj(path.string(), diagnostics);
        ASSERT_TRUE(m) << c.file;
        expect_valid(*m);
        uint64_t dropped = 0;
        for (const auto& w : diagnostics.warnings())
            if (w.message == "zero-area face dropped") dropped = w.count;
        EXPECT_EQ(m->triangles.size(), c.triangles - c.dropped) << c.file;
        EXPECT_EQ(dropped, c.dropped) << c.file;
        EXPECT_EQ(m->materials.size(), c.materials) << c.file;
    }
}

TEST_F(Obj, MutatedFilesNeverBreakTheReader)
{
    const std::string obj =
        "mtllib a.mtl\no thing\n" + square +
        "v 0.5 0.5 1e0 1 0 0\nvt 0 0\nvt 1 0.5\nvn 0 0 1\nvn 1 -2 3\n"
        "usemtl red\nf 1/1/1 2/2/2 3//1\nf 1 2 \\\n 3 4 # q\nusemtl lamp\r\nf -1 -2 -3\nf 1 2 3 4 5\n"
        "s off\ng x\nl 1 2\nf 5//2 4//1 1//-1\n";
    const std::string mtl = "newmtl red\nKd 1 0 0 # Red\nNs 10\nmap_Kd a.png\n\nnewmtl lamp\nKe 1 2 3\nillum 2\n";
    const std::string pieces[] = {"0",
                                  "-1",
                                  "99999999999",
                                  "nan",
                                  "1e400",
                                  "/",
                                  "//",
                                  "\\\n",
                                  "\r",
                                  "#",
                                  " ",
                                  "f ",
                                  "v ",
                                  "usemtl ",
                                  "newmtl ",
                                  "Kd ",
                                  "-",
                                  "e",
                                  std::string(1, '\0'),
                                  "\xff"};
    uint64_t state = 12345;
    const auto random = [&](size_t n) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<size_t>(state >> 33) % n;
    };
    const auto mutate = [&](std::string s) {
        for (size_t times = 1 + random(4); times > 0; --times) {
            const size_t at = random(s.size()), kind = random(5);
            if (kind == 0) s[at] = static_cast<char>(random(256));
            if (kind == 1) s.erase(at, 1 + random(8));
            if (kind == 2) s.insert(at, pieces[random(std::size(pieces))]);
            if (kind == 3) s.insert(at, s.substr(random(s.size()), random(30)));
            if (kind == 4 && at > 0) s[at] = "0123456789 -./"[random(14)];
            if (s.empty()) s = "f";
        }
        return s;
    };
    int loaded = 0;
    for (int i = 0; i < 4000; ++i) {
        if (i % 4 == 0) write("a.mtl", mutate(mtl));
        const std::string text = i % 4 == 3 ? obj : mutate(obj);
        const auto m = load(text);
        ASSERT_EQ(m == nullptr, diagnostics_.has_errors()) << text;
        ASSERT_THAT(errors(), testing::Not(HasSubstr("could not be parsed")));
        if (m) expect_valid(*m);
        if (m) ++loaded;
        if (HasFailure()) FAIL() << text;
    }
    EXPECT_GT(loaded, 1000);
}

}  // namespace
}  // namespace lancer
