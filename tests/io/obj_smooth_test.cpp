// Vertex normals of smoothing groups.
#include <iomanip>
#include <sstream>

#include "io/obj/smooth.h"
#include "obj_test_support.h"
#include "support/scenes/things.h"

namespace lancer {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class ObjSmooth : public ObjTest {
protected:
    // Vertices and faces of a mesh, with `before` in front of the faces.
    static std::string text_of(const MeshData& mesh, const std::string& before)
    {
        std::ostringstream text;
        // Whole numbers, which every parser reads alike.
        for (const Vec3d& p : mesh.positions)
            text << "v " << std::lround(1e4 * p.x) << " " << std::lround(1e4 * p.y) << " " << std::lround(1e4 * p.z)
                 << "\n";
        text << before;
        for (const auto& t : mesh.triangles) text << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
        return text.str();
    }
};

// Two squares that meet in an edge along y, the second one at an angle of `degrees` to the first.
std::string hinge(double degrees, const std::string& first, const std::string& second)
{
    const double a = degrees * std::numbers::pi / 180;
    std::ostringstream text;
    text << std::fixed << std::setprecision(6);
    text << "v -1 0 0\nv 0 0 0\nv 0 1 0\nv -1 1 0\nv " << std::cos(a) << " 0 " << std::sin(a) << "\nv " << std::cos(a)
         << " 1 " << std::sin(a) << "\n"
         << first << "f 1 2 3 4\n"
         << second << "f 2 5 6 3\n";
    return text.str();
}

TEST_F(ObjSmooth, ABallHasTheNormalsOfItsPlaces)
{
    const auto m = load(text_of(*make_uv_sphere(32, 64), "s 1\n"));
    ASSERT_TRUE(m) << errors();
    ASSERT_EQ(m->normal_triangles.size(), m->triangles.size());
    EXPECT_TRUE(m->made_normals);
    for (size_t t = 0; t < m->triangles.size(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            const Vec3d n = to_double(m->normals.at(m->normal_triangles[t][k]));
            EXPECT_NEAR(length(n), 1, 1e-6);
            EXPECT_GT(dot(n, normalize(m->positions[m->triangles[t][k]])), 0.9995);
        }
    EXPECT_EQ(m->normals.size(), m->positions.size());  // shared
    EXPECT_THAT(warnings(), IsEmpty());
}

TEST_F(ObjSmooth, EdgesStaySharpBetweenGroupsAndAboveTheAngle)
{
    const auto normals = [&](double degrees, const std::string& first, const std::string& second) {
        const auto m = load(hinge(degrees, first, second));
        EXPECT_TRUE(m) << errors();
        return m->normals.size();
    };
    // Six vertices: those of the edge have one normal or two; flat squares share theirs at each vertex alone.
    const double largest_deg = Smoothing{}.largest_deg;
    EXPECT_EQ(normals(largest_deg - 1, "s 1\n", ""), 6u);
    EXPECT_EQ(normals(largest_deg + 1, "s 1\n", ""), 8u);
    EXPECT_EQ(normals(30, "s 1\n", "s 2\n"), 8u);
    EXPECT_EQ(normals(30, "s 1\n", "s off\n"), 4u);
    EXPECT_EQ(normals(30, "s off\n", "s 0\n"), 0u);
    EXPECT_EQ(normals(30, "", ""), 0u);
    EXPECT_EQ(normals(30, "s on\n", ""), 6u);
    const auto cube = load(text_of(*make_cube(), "s 1\n"));
    ASSERT_TRUE(cube) << errors();
    for (size_t t = 0; t < cube->triangles.size(); ++t)
        for (const uint32_t n : cube->normal_triangles[t]) EXPECT_EQ(max_component(abs(cube->normals[n])), 1);
}

TEST_F(ObjSmooth, TheSceneChoosesTheAngleAndTheFaces)
{
    using Faces = Smoothing::Faces;
    for (const size_t parallel_from : {size_t{0}, SIZE_MAX}) {
        const auto normals = [&](Smoothing smoothing, const std::string& first, const std::string& second) {
            const std::string path = write("b.obj", hinge(30, first, second));
            const auto m =
                load_obj(path, diagnostics_, {.parallel_from = parallel_from, .chunk = 10, .smoothing = smoothing});
            EXPECT_TRUE(m) << errors();
            return m->normals.size();
        };
        EXPECT_EQ(normals({Faces::groups, 29}, "s 1\n", ""), 8u);
        EXPECT_EQ(normals({Faces::groups, 31}, "s 1\n", ""), 6u);
        EXPECT_EQ(normals({Faces::none}, "s 1\n", ""), 0u);
        EXPECT_EQ(normals({Faces::all, 31}, "", ""), 6u);
        EXPECT_EQ(normals({Faces::all, 29}, "", ""), 8u);
        EXPECT_EQ(normals({Faces::all}, "s off\n", ""), 6u);
        EXPECT_EQ(normals({Faces::all}, "s 1\n", "s off\n"), 4u);  // where a file names groups, they count
        EXPECT_EQ(normals({Faces::all}, "vn 1 0 0\nvn 0 1 0\nf 1//1 2//1 3//2\n", ""), 2u);
    }
}

TEST_F(ObjSmooth, NormalsOfTheFileHavePrecedence)
{
    const auto m = load("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\ns 1\nf 1//1 2//1 3//1\nf 1 2 4\n");
    ASSERT_TRUE(m) << errors();
    EXPECT_FALSE(m->made_normals);
    constexpr uint32_t no = MeshData::no_normal;
    EXPECT_THAT(m->normal_triangles, ElementsAre(Triangle{0, 0, 0}, Triangle{no, no, no}));
}

// A fan of so many triangles that they are not compared with each other.
TEST_F(ObjSmooth, AFanHasOneNormalAtItsTip)
{
    constexpr int count = 1000;
    std::ostringstream text;
    text << "v 0 0 1\n";
    for (int i = 0; i < count; ++i) {
        const double phi = 2 * std::numbers::pi * i / count;
        text << "v " << std::cos(phi) << " " << std::sin(phi) << " 0\n";
    }
    text << "s 1\n";
    for (int i = 0; i < count; ++i) text << "f 1 " << 2 + i << " " << 2 + (i + 1) % count << "\n";
    const auto m = load(text.str());
    ASSERT_TRUE(m) << errors();
    EXPECT_EQ(m->normals.size(), 1u + count);
    EXPECT_GT(m->normals[m->normal_triangles[0][0]].z, 0.9999f);
}

TEST_F(ObjSmooth, IsTheSameInParts)
{
    const std::string path =
        write("b.obj", text_of(*make_uv_sphere(20, 40), "s 1\n") + "s 2\nf 1 3 9\nf 1 9 200\ns off\nf 5 9 300\n");
    MeshOptions whole, parts;
    whole.parallel_from = SIZE_MAX;
    parts.parallel_from = 0, parts.chunk = 1000;
    const auto a = load_obj(path, diagnostics_, whole), b = load_obj(path, diagnostics_, parts);
    ASSERT_TRUE(a && b) << errors();
    EXPECT_EQ(a->normals, b->normals);
    EXPECT_EQ(a->normal_triangles, b->normal_triangles);
}

}  // namespace
}  // namespace lancer
