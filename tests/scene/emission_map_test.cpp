// Where points are sampled on a triangle that shows a picture.
#include "scene/lights/emission_map.h"

#include <gtest/gtest.h>

#include <array>

#include "core/warp.h"
#include "support/random.h"
#include "support/rasters.h"
#include "support/stage.h"

namespace lancer {
namespace {

TEST(EmissionMap, SamplesCellsByTheirWeights)
{
    const std::vector<double> weights{1, 2, 3, 4, 0.5, 8, 1e-4, 1, 1, 1, 1, 1, 9, 0.1, 5, 7};
    double total = 0;
    for (const double w : weights) total += w;
    const EmissionMap map(weights, 4);
    constexpr uint32_t side = 256;
    std::array<double, 16> found{};
    for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x) {
            const Vec2 u{(static_cast<float>(x) + 0.5f) / side, (static_cast<float>(y) + 0.5f) / side};
            const auto [at, density] = map.sample(u);
            ASSERT_TRUE(at.x >= 0 && at.x < 1 && at.y >= 0 && at.y < 1);
            ASSERT_NEAR(map.density(at) / density, 1, 1e-6);
            found[static_cast<size_t>(at.y * 4) * 4 + static_cast<size_t>(at.x * 4)] += 1.0 / (side * side);
        }
    for (size_t i = 0; i < weights.size(); ++i) {
        EXPECT_NEAR(found[i], weights[i] / total, 0.005) << i;
        const Vec2 middle{(static_cast<float>(i % 4) + 0.5f) / 4, (static_cast<float>(i / 4) + 0.5f) / 4};
        EXPECT_NEAR(map.density(middle), 16 * weights[i] / total, 1e-5) << i;
    }
    for (const float x : {0.0f, 0.25f, 1 - 0x1p-24f, 1.0f})
        for (const float y : {0.0f, 0.5f, 1 - 0x1p-24f, 1.0f}) EXPECT_GT(map.density({x, y}), 0) << x << " " << y;
}

TEST(EmissionMap, WeightsKnowHowMuchTheyVary)
{
    EXPECT_EQ(relative_variance({2, 2, 2, 2}), 0);
    EXPECT_DOUBLE_EQ(relative_variance({0, 2}), 1);
    EXPECT_EQ(relative_variance({0, 0}), 0);
}

TEST(EmissionMap, TrianglesMapBackToTheSquare)
{
    Random random(3);
    for (int i = 0; i < 10000; ++i) {
        const Vec2 u = random.unit2(), back = triangle_to_square(square_to_triangle(u));
        ASSERT_NEAR(back.x, u.x, 1e-6);
        ASSERT_NEAR(back.y, u.y, 1e-6);
    }
}

// A lamp that shows a checker, black in places or everywhere alike.
MeshDescription checkered_lamp(bool has_black)
{
    MeshDescription mesh =
        triangle_mesh({-0.5, 1, -0.3}, {0.6, 1, -0.4}, {0.1, 1, 0.7}, make_emitter("lamp", {3, 2, 1}));
    MeshData data = *mesh.data;
    data.uvs = {{0, 0}, {1, 0}, {0.5f, 1}};
    data.uv_triangles = {{0, 1, 2}};
    data.materials[0].emission_map = TextureDescription{.where = {},
                                                        .type = TextureType::checker,
                                                        .file = {},
                                                        .use = {.scale = {4, 4}},
                                                        .even = {1, 1, 1},
                                                        .odd = has_black ? Color{} : Color{1, 1, 1}};
    mesh.data = std::make_shared<const MeshData>(data);
    return mesh;
}

// Nearly all points are where the picture shines; one of a single colour needs no map.
TEST(EmissionMap, LightsAreSampledWhereTheyShine)
{
    for (const bool has_black : {false, true}) {
        SceneDescription d;
        d.meshes.push_back(checkered_lamp(has_black));
        const Stage stage(d);
        EXPECT_EQ(stage.scene.lights.maps.size(), has_black ? 1u : 0u);
        Random random(5);
        const Surface from = receiver(stage.to_scene({0, 0, 0}), {0, 1, 0});
        int found = 0;
        for (int i = 0; i < 1000; ++i)
            found += sample_light(stage.scene, from, random.unit(), random.unit2()).has_value();
        EXPECT_GT(found, 880);
    }
}

}  // namespace
}  // namespace lancer
