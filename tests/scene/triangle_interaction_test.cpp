// Many places at once have the bits of single ones: flat and smooth triangles, placed by instances or not, and needles.
#include "scene/triangle_interaction.h"

#include <gtest/gtest.h>

#include <cstring>

#include "support/random.h"
#include "support/scenes/scenes.h"
#include "support/stage.h"

namespace lancer {
namespace {

void expect_same_bits(const TriangleInteraction& a, const TriangleInteraction& b, const std::string& where)
{
    EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0) << where;
    static_assert(sizeof(TriangleInteraction) == 13 * sizeof(float), "nothing but numbers");
}

TEST(TrianglePlaces, HaveTheBitsOfSingleOnes)
{
    for (const auto& [name, d] : all_test_scenes()) {
        const Stage stage(d, test_picture);
        Random random(31);
        std::vector<Hit> hits;
        int triangles = 0;
        for (int i = 0; i < 500; ++i) {
            const Ray ray{.org = to_float(random.point(-1, 1)), .dir = random.unit_vector()};
            hits.push_back(stage.list.closest(ray));
            if (hits.back().kind != Kind::triangle) continue;
            ++triangles;
            // Of a corner and of an edge as well.
            if (i % 5 == 0) hits.back().uv = {};
            if (i % 5 == 1) hits.back().uv.y = 1 - hits.back().uv.x;
        }
        std::vector<TriangleInteraction> places(hits.size());
        triangle_interactions(stage.scene, std::vector<Ray>(hits.size()), hits, places);
        for (size_t i = 0; i < hits.size(); ++i) {
            const Hit& h = hits[i];
            if (h.kind != Kind::triangle) continue;
            expect_same_bits(places[i], triangle_interaction(stage.scene, h.instance, h.geometry, h.primitive, h.uv),
                             std::string(name) + " " + std::to_string(i));
        }
        if (std::string(name) == "instances") {
            EXPECT_GT(triangles, 20);
        }
    }
}

// Without area, in a line, and with normals that say nothing or face away.
TEST(TrianglePlaces, OfWhatIsHardlyATriangle)
{
    Scene scene;
    Mesh mesh;
    mesh.positions = {{1, 2, 3},     {1, 2, 3},      {1, 2, 3}, {0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {0, 0, 0},
                      {1e18f, 0, 0}, {0, 1e-30f, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}, {9, 10, 11}, {9, 10, 11}};
    MeshShading shading;
    const uint32_t none = CornerNormals::none;
    shading.normals.values = {{0, 0, 1}, {0, 0, -1}, {0, 0, 0}, {}};
    shading.normals.triangles = {{none, none, none}, {0, 0, 0}, {none, none, none}, {1, 1, 1}, {2, 2, 2}, {0, 1, 2}};
    shading.normals.storage = CornerNormals::Storage::corners;
    scene.geometry.meshes = {mesh};
    scene.shading = {shading};
    scene.has_normals = true;
    std::vector<Hit> hits;
    for (uint32_t i = 0; i < mesh.triangles.size(); ++i)
        for (const Vec2 uv : {Vec2{0.25f, 0.25f}, Vec2{0.5f, 0.5f}})
            hits.push_back({1, Hit::no_instance, 0, i, uv, Kind::triangle});
    std::vector<TriangleInteraction> places(hits.size());
    triangle_interactions(scene, std::vector<Ray>(hits.size()), hits, places);
    for (size_t i = 0; i < hits.size(); ++i)
        expect_same_bits(places[i], triangle_interaction(scene, Hit::no_instance, 0, hits[i].primitive, hits[i].uv),
                         std::to_string(i));
    EXPECT_EQ(places[0].n, (Vec3{0, 0, 1}));
    EXPECT_EQ(places[6].n, (Vec3{0, 0, -1}));
}

}  // namespace
}  // namespace lancer
