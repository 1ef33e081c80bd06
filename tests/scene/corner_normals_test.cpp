// Shading normals that vertices have, and those that corners of triangles have: the same of each triangle.
#include <gtest/gtest.h>

#include <bit>

#include "scene/surface.h"
#include "scene/triangle_interaction.h"
#include "support/scenes/scenes.h"
#include "support/stage.h"

namespace lancer {
namespace {

constexpr uint32_t none = MeshData::no_normal;

// Two triangles inside of a ball, with corners of their own.
void add_sheet(MeshData& mesh, const std::array<std::array<uint32_t, 3>, 2>& normals)
{
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const Vec3d p : {Vec3d{0, 0, 0}, Vec3d{0.1, 0, 0.3}, Vec3d{0, 0.2, 0}, Vec3d{0.2, 0.2, 0}})
        mesh.positions.push_back(p);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 1, first + 3});
    for (const auto& n : normals) mesh.normal_triangles.push_back(n);
}

MeshData smooth_ball()
{
    MeshData ball = *make_uv_sphere(16, 8, 0, make_lambert("ball", {1, 1, 1}));
    for (const Vec3d& p : ball.positions) ball.normals.push_back(to_float(normalize(p + Vec3d{0, 0.1, 0.2})));
    ball.normal_triangles = ball.triangles;
    return ball;
}

SceneDescription scene_of(const MeshData& mesh, bool mirrored)
{
    SceneDescription d;
    d.meshes.push_back(make_mesh(std::make_shared<const MeshData>(mesh)));
    if (mirrored) d.meshes[0].transform.scale = {-1, 1, 1};
    return d;
}

void expect_same_bits(Vec3 a, Vec3 b, uint32_t triangle)
{
    for (const auto of : {&Vec3::x, &Vec3::y, &Vec3::z})
        EXPECT_EQ(std::bit_cast<uint32_t>(a.*of), std::bit_cast<uint32_t>(b.*of)) << triangle;
}

// A ball and a sheet: with normals of its vertices, the sheet flat, and with those of corners, where one of its
// triangles is flat beside one that is not.
struct Balls {
    MeshData by_vertex = smooth_ball(), by_triangle = by_vertex;
    Balls()
    {
        add_sheet(by_vertex, {{{none, none, none}, {none, none, none}}});
        add_sheet(by_triangle, {{{none, none, none}, {0, 1, 2}}});
    }
};

// Hits of all triangles of the only mesh.
std::vector<Hit> hits_of_all(size_t triangles)
{
    std::vector<Hit> hits;
    for (uint32_t t = 0; t < triangles; ++t) hits.push_back({1, Hit::no_instance, 0, t, {0.25f, 0.4f}, Kind::triangle});
    return hits;
}
std::vector<TriangleInteraction> all_at_once(const Scene& scene, const std::vector<Hit>& hits)
{
    std::vector<TriangleInteraction> places(hits.size());
    triangle_interactions(scene, std::vector<Ray>(hits.size()), hits, places);
    return places;
}

TEST(CornerNormals, OfVerticesAndOfTrianglesAreTheSame)
{
    const auto [by_vertex, by_triangle] = Balls();
    for (const bool mirrored : {false, true}) {
        const Stage a(scene_of(by_vertex, mirrored)), b(scene_of(by_triangle, mirrored));
        ASSERT_TRUE(a.scene.shading[0].normals.are_of_vertices());
        ASSERT_FALSE(b.scene.shading[0].normals.are_of_vertices());
        const auto triangles = static_cast<uint32_t>(by_vertex.triangles.size());
        const std::vector<Hit> hits = hits_of_all(triangles);
        const auto of_a = all_at_once(a.scene, hits), of_b = all_at_once(b.scene, hits);
        uint32_t smooth = 0;
        for (uint32_t t = 0; t + 1 < triangles; ++t) {
            const TriangleInteraction alone = triangle_interaction(a.scene, Hit::no_instance, 0, t, hits[t].uv);
            expect_same_bits(of_a[t].n, of_b[t].n, t);
            expect_same_bits(of_a[t].ns, of_b[t].ns, t);
            expect_same_bits(of_a[t].ns, alone.ns, t);
            smooth += of_a[t].n != of_a[t].ns;
        }
        EXPECT_EQ(smooth, triangles - 2);
        EXPECT_EQ(of_a[triangles - 1].n, of_a[triangles - 1].ns);
        EXPECT_NE(of_b[triangles - 1].n, of_b[triangles - 1].ns);
    }
}

// Of vertices and of corners: turned by little, flat ones not at all, with the same bits for one hit and for eight.
TEST(CornerNormals, AsCodesAreNearlyTheSameInAThirdOfTheMemory)
{
    const auto [by_vertex, by_triangle] = Balls();
    for (const MeshData& mesh : {by_vertex, by_triangle}) {
        SceneDescription d = scene_of(mesh, true);
        const Stage full(d);
        d.render.compact = true;
        const Stage compact(d);
        const CornerNormals &a = full.scene.shading[0].normals, &b = compact.scene.shading[0].normals;
        const Mesh& packed = compact.scene.geometry.meshes[0];
        EXPECT_EQ(packed.rows, 1u);
        EXPECT_TRUE(b.values.empty());
        EXPECT_EQ(a.are_of_vertices(), b.are_of_vertices());
        EXPECT_EQ(b.codes.size(), a.are_of_vertices() ? packed.vertices() : a.values.size() - 1);
        const auto triangles = static_cast<uint32_t>(mesh.triangles.size());
        const std::vector<Hit> hits = hits_of_all(triangles);
        const auto of_full = all_at_once(full.scene, hits), of_compact = all_at_once(compact.scene, hits);
        double largest = 0;
        for (uint32_t t = 0; t < triangles; ++t) {
            const Vec3 ns = of_compact[t].ns;
            expect_same_bits(ns, triangle_interaction(compact.scene, Hit::no_instance, 0, t, hits[t].uv).ns, t);
            expect_same_bits(of_full[t].n, of_compact[t].n, t);
            EXPECT_EQ(of_full[t].n == of_full[t].ns, of_compact[t].n == ns) << t;
            largest = std::max(largest, length(to_double(ns) - to_double(of_full[t].ns)));
        }
        EXPECT_LT(largest, 6e-5);
        EXPECT_GT(largest, 1e-6) << "nothing was packed";
    }
}

// Normals behind the positions change no number that goes with a vertex.
TEST(CornerNormals, OfVerticesLeaveThemTheirColors)
{
    MeshData smooth = smooth_ball();
    for (size_t i = 0; i < smooth.positions.size(); ++i)
        smooth.colors.push_back({static_cast<float>(i) / 256, 1 - static_cast<float>(i) / 256, 0.5f});
    MeshData flat = smooth;
    flat.normals.clear(), flat.normal_triangles.clear();
    const Stage a(scene_of(smooth, false)), b(scene_of(flat, false));
    ASSERT_EQ(a.scene.geometry.meshes[0].rows, 2u);
    ASSERT_EQ(b.scene.geometry.meshes[0].rows, 1u);
    EXPECT_EQ(a.scene.geometry.meshes[0].vertices(), b.scene.geometry.meshes[0].vertices());
    for (uint32_t t = 0; t < smooth.triangles.size(); ++t) {
        const Hit hit{1, Hit::no_instance, 0, t, {0.25f, 0.4f}, Kind::triangle};
        const auto color = [&](const Stage& s) {
            const Color c = shading_point_at(s.scene, hit, true, 0, 0).vertex_color;
            return Vec3{c.r, c.g, c.b};
        };
        expect_same_bits(color(a), color(b), t);
    }
}

TEST(CornerNormals, AreNumberedAsTheVerticesOnlyWhereThatSaysAll)
{
    const auto of_vertices = [](const MeshData& mesh) {
        return build_scene(scene_of(mesh, false)).shading[0].normals.are_of_vertices();
    };
    MeshData ball = smooth_ball();
    EXPECT_TRUE(of_vertices(ball));
    // Other numbers of the same normals.
    const auto count = static_cast<uint32_t>(ball.normals.size());
    ball.normals.insert(ball.normals.end(), ball.normals.begin(), ball.normals.end());
    for (auto& t : ball.normal_triangles) t[0] += count;
    EXPECT_TRUE(of_vertices(ball));
    ball.normals[count + 1] = {1, 0, 0};
    EXPECT_FALSE(of_vertices(ball)) << "a vertex with two normals";
    ball = smooth_ball();
    ball.normal_triangles[0] = {none, none, none};
    EXPECT_FALSE(of_vertices(ball)) << "a flat triangle among others";
    // More bytes than by numbers of their own.
    MeshData wall = smooth_ball();
    for (auto& t : wall.normal_triangles) t = {0, 0, 0};
    wall.normals.resize(1);
    EXPECT_TRUE(of_vertices(wall));
    for (uint32_t i = 0; i < 100; ++i) {
        wall.positions.push_back({0.001 * i, 0.3, 0});
        wall.positions.push_back({0.001 * i, 0, 0.3});
        wall.positions.push_back({0.001 * i, 0, -0.3});
        wall.triangles.push_back({static_cast<uint32_t>(wall.positions.size()) - 3,
                                  static_cast<uint32_t>(wall.positions.size()) - 2,
                                  static_cast<uint32_t>(wall.positions.size()) - 1});
        wall.normal_triangles.push_back({0, 0, 0});
    }
    EXPECT_FALSE(of_vertices(wall));
}

}  // namespace
}  // namespace lancer
