// What a line of memory says of each triangle has the bits of what is gathered for it; and scenes that hold anything
// else have no such lines.
#include "scene/flat_table.h"

#include <gtest/gtest.h>

#include <cstring>

#include "materials/material.h"
#include "support/random.h"
#include "support/scenes/wide_cases.h"
#include "support/stage.h"

namespace lancer {
namespace {

TEST(FlatTable, HasTheBitsOfSingleTriangles)
{
    int scenes = 0, shining = 0;
    std::vector<NamedScene> all = all_test_scenes();
    all.push_back({"few", flat_scene(5, 8)}), all.push_back({"many", flat_scene(30, 40)});
    for (const auto& [name, d] : all) {
        const Stage stage(d, test_picture);
        const Geometry& g = stage.scene.geometry;
        const FlatTable table = FlatTable::of(stage.scene);
        const bool is_flat = g.instances.empty() && g.spheres.empty() && g.planes.empty() && !stage.scene.has_normals &&
                             g.meshes.size() <= float_lanes;
        size_t triangles = 0;
        for (const Mesh& mesh : g.meshes) triangles += mesh.triangles.size();
        EXPECT_EQ(table.empty(), !is_flat || triangles == 0 || triangles > 2048) << name;
        if (table.empty()) continue;
        ++scenes;
        Random random(32);
        for (int round = 0; round < 100; ++round) {
            std::array<Hit, float_lanes> hits;
            for (Hit& hit : hits)
                hit = stage.list.closest({.org = to_float(random.point(-1, 1)), .dir = random.unit_vector()});
            const FlatTable::Found found = table.at(HitLanes(hits.data()));
            for (uint32_t i = 0; i < float_lanes; ++i) {
                const Hit& h = hits[i];
                if (!h) continue;
                const TriangleInteraction one =
                    triangle_interaction(stage.scene, h.instance, h.geometry, h.primitive, h.uv);
                const TriangleInteraction of_eight = found.place.of(i);
                EXPECT_EQ(std::memcmp(&one, &of_eight, sizeof one), 0) << name << " " << round << " " << i;
                const uint32_t material = stage.scene.material_of(h);
                EXPECT_EQ(found.material[i], material);
                const bool shines = !stage.scene.emission[material].is_dark();
                EXPECT_EQ(found.shines[i], shines ? -1 : 0);
                shining += shines ? 1 : 0;
            }
        }
    }
    EXPECT_EQ(scenes, 2);
    EXPECT_GT(shining, 0);
}

TEST(FlatTable, IsOfFewTriangles)
{
    Scene scene;
    scene.materials.resize(1), scene.emission.resize(1);
    for (const size_t n : {size_t{1}, size_t{2048}, size_t{2049}}) {
        Mesh mesh;
        mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {}};
        mesh.triangles.assign(n, {0, 1, 2});
        scene.geometry.meshes = {mesh}, scene.shading = {MeshShading{}};
        EXPECT_EQ(FlatTable::of(scene).empty(), n > 2048) << n;
    }
}

}  // namespace
}  // namespace lancer
