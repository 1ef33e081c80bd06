// Subdivision by Catmull and Clark: known places, closed surfaces, seams of texture coordinates.
#include "io/subdivide/catmull_clark.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "support/scenes/scenes.h"

namespace lancer {
namespace {

// A cube from -1 to 1 of six quads, each side with vertices and texture coordinates of its own.
MeshData cube()
{
    MeshData data;
    data.materials = {make_lambert("a", {0.5f, 0.5f, 0.5f}), make_lambert("b", {0.5f, 0.5f, 0.5f})};
    const Vec3d axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (size_t axis = 0; axis < 3; ++axis)
        for (const double side : {1.0, -1.0}) {
            const Vec3d n = axes[axis] * side, x = axes[(axis + 1) % 3], y = cross(n, x);
            const auto first = static_cast<uint32_t>(data.positions.size());
            for (const auto& [a, b] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
                data.positions.push_back(n + x * a + y * b);
                data.uvs.push_back({static_cast<float>(a), static_cast<float>(b)});
                data.colors.push_back({1, static_cast<float>(n.x > 0), 0});
            }
            data.triangles.push_back({first, first + 1, first + 2});
            data.triangles.push_back({first, first + 2, first + 3});
            data.face_material.insert(data.face_material.end(), 2, n.z > 0 ? 1u : 0u);
        }
    data.uv_triangles = data.triangles;
    return data;
}

// Nothing where lancer was built without OpenSubdiv.
std::optional<MeshData> subdivided(const MeshData& data, uint32_t levels)
{
    try {
        return catmull_clark(data, levels, {});
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("which subdivides by Catmull and Clark, is missing"), std::string::npos)
            << e.what();
        return {};
    }
}

TEST(CatmullClark, OfACubeHasItsKnownPlaces)
{
    const auto made = subdivided(cube(), 1);
    if (!made) GTEST_SKIP();
    EXPECT_EQ(made->triangles.size(), 48u);
    ASSERT_EQ(made->positions.size(), 26u) << "vertices in the same place are one";
    std::map<std::array<int, 3>, int> found;  // in ninths of a quarter, without signs
    for (const Vec3d& p : made->positions) {
        std::array<int, 3> at{};
        for (size_t k = 0; k < 3; ++k) {
            const double x = 36 * std::abs(k == 0 ? p.x : k == 1 ? p.y : p.z);
            at[k] = static_cast<int>(std::lround(x));
            EXPECT_NEAR(x, at[k], 1e-9);
        }
        std::sort(at.begin(), at.end());
        ++found[at];
    }
    // Middles of faces, of edges at 3/4, corners at 5/9.
    EXPECT_EQ(found, (std::map<std::array<int, 3>, int>{{{0, 0, 36}, 6}, {{0, 27, 27}, 12}, {{20, 20, 20}, 8}}));
    EXPECT_EQ(std::count(made->face_material.begin(), made->face_material.end(), 1u), 8);
    for (size_t t = 0; t < made->triangles.size(); ++t) {
        if (made->face_material[t] != 1) continue;
        for (const uint32_t i : made->uv_triangles[t]) EXPECT_LE(std::abs(made->uvs[i].x), 1);
    }
    // Seams stay where they are: each side still goes from -1 to 1.
    float least = 0, most = 0;
    for (const Vec2 uv : made->uvs) least = std::min(least, uv.x), most = std::max(most, uv.x);
    EXPECT_EQ(least, -1);
    EXPECT_EQ(most, 1);
}

TEST(CatmullClark, StaysClosedAndIsSmooth)
{
    const auto made = subdivided(cube(), 4);
    if (!made) GTEST_SKIP();
    EXPECT_EQ(made->triangles.size(), 6u * 256 * 2);
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (const auto& t : made->triangles)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = t[k], b = t[(k + 1) % 3];
            edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : 1000;
        }
    for (const auto& [edge, sides] : edges) ASSERT_EQ(sides, 1001);
    EXPECT_TRUE(made->made_normals);
    for (size_t t = 0; t < made->triangles.size(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            const Vec3d p = made->positions[made->triangles[t][k]];
            ASSERT_GT(dot(normalize(p), to_double(made->normals[made->normal_triangles[t][k]])), 0.85);
        }
}

TEST(CatmullClark, TrianglesThatAreNoQuadsCountAsThemselves)
{
    MeshData pyramid = *make_mesh_data({{0, 0, 1}, {1, 0, 0}, {-0.5, 0.8, 0}, {-0.5, -0.8, 0}},
                                       {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}, {});
    const auto made = subdivided(pyramid, 1);
    if (!made) GTEST_SKIP();
    EXPECT_EQ(made->triangles.size(), 4u * 3 * 2);
    EXPECT_EQ(made->positions.size(), 4u + 6 + 4);
}

}  // namespace
}  // namespace lancer
