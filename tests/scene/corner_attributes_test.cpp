// A second set of texture coordinates, and the alpha of vertex colours.
#include <gtest/gtest.h>

#include "support/stage.h"

namespace lancer {
namespace {

// Two triangles over (-1, -1) to (1, 1); the second set of texture coordinates is the first one turned round.
MeshData square(const MaterialDescription& material)
{
    MeshData data = *make_mapped_quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {1, 1}, material);
    for (const Vec2 uv : data.uvs) data.second_uvs.push_back({1 - uv.x, 0.5f * uv.y});
    return data;
}
SceneDescription scene_of(MeshData data)
{
    SceneDescription d;
    d.meshes.push_back(make_mesh(std::make_shared<const MeshData>(std::move(data))));
    d.lights.push_back(sky_of({1, 1, 1}));
    return d;
}
Color color_at(const Stage& stage, const Surface& s)
{
    const ShadingPoint p = stage.scene.shading_point(s);
    return p.base(std::get<Lambert>(stage.scene.materials[s.material]).albedo);
}

TEST(CornerAttributes, ATextureIsLookedUpByItsSet)
{
    for (const bool instanced : {false, true}) {
        MaterialDescription first = make_lambert("first", {1, 1, 1}), second = first;
        first.base_color_map = second.base_color_map = picture_of("colours", Encoding::srgb);
        second.base_color_map->use.by_second_uv = true;
        SceneDescription a = scene_of(square(first)), b = scene_of(square(second));
        if (instanced)
            for (SceneDescription* d : {&a, &b}) {
                d->meshes[0].name = "m";
                d->instances.push_back(instance_of("m", {{0, 0, 0.5}, {}, {1, 1, 1}}));
            }
        const Stage one(a), two(b);
        EXPECT_TRUE(one.scene.shading[0].second_uvs.empty()) << "what no texture uses is not kept";
        EXPECT_EQ(two.scene.shading[0].second_uvs.size(), two.scene.shading[0].uvs.size());
        for (const auto& [u, v] : {std::pair{0.2, 0.3}, {0.7, 0.9}, {0.55, 0.1}}) {
            const auto look = [&](const Stage& stage, double at_u, double at_v) {
                return stage.look(stage.to_scene({2 * at_u - 1, 2 * at_v - 1, 3}), {0, 0, -1});
            };
            const auto there = look(two, u, v), same = look(one, 1 - u, 0.5 * v);
            ASSERT_TRUE(there && same);
            const Color found = color_at(two, *there), expected = color_at(one, *same);
            EXPECT_NEAR(found.r, expected.r, 2e-3f);
            EXPECT_NEAR(found.g, expected.g, 2e-3f);
            EXPECT_NEAR(found.b, expected.b, 2e-3f);
        }
    }
}

TEST(CornerAttributes, AMeshWithOneSetUsesItAndSaysSo)
{
    MaterialDescription m = make_lambert("m", {1, 1, 1});
    m.base_color_map = picture_of("colours", Encoding::srgb);
    m.base_color_map->use.by_second_uv = true;
    MeshData data = square(m);
    data.second_uvs.clear();
    Diagnostics diagnostics;
    const SceneDescription d = scene_of(data);
    const Scene scene = Scene::build(d, d.render, diagnostics, test_picture);
    ASSERT_EQ(diagnostics.warnings().size(), 1u);
    EXPECT_NE(to_string(diagnostics.warnings()[0]).find("'uv_set = 1'"), std::string::npos);
    const UvSets uvs = texture_uvs(scene.shading[0], 0, {0.25f, 0.5f});
    EXPECT_EQ(uvs.first, uvs.second);
}

TEST(CornerAttributes, BumpsAndNormalsAlongTheSecondSetAreThoseOfAMeshThatHasItAlone)
{
    for (const bool bumps : {false, true}) {
        MaterialDescription m = make_lambert("m", {1, 1, 1});
        TextureUse& use = bumps ? m.bump_map : m.normal_map;
        use = bumps ? heights_of("waves") : picture_of("tilted normals", Encoding::linear);
        MeshData plain = square(m);
        plain.uvs = std::exchange(plain.second_uvs, {});
        use->use.by_second_uv = true;
        const Stage alone(scene_of(plain)), second(scene_of(square(m)));
        for (const auto& [x, y] : {std::pair{-0.4, 0.1}, {0.3, -0.7}, {0.9, 0.2}}) {
            const auto a = alone.look(alone.to_scene({x, y, 3}), {0, 0, -1});
            const auto b = second.look(second.to_scene({x, y, 3}), {0, 0, -1});
            ASSERT_TRUE(a && b);
            EXPECT_EQ(a->ns, b->ns) << bumps;
            EXPECT_NE(a->ns, a->n) << bumps;
        }
    }
}

// Each ray has a number of its own, by its key.
double stopped_part(const Stage& stage, Vec3d at)
{
    constexpr uint32_t rays = 4000;
    uint32_t stopped = 0;
    for (uint32_t i = 0; i < rays; ++i) {
        Ray ray{.org = stage.to_scene({at.x, at.y, 3}), .dir = {0, 0, -1}};
        ray.key = i * 2654435761u;
        stopped += stage.list.closest(ray) ? 1 : 0;
        EXPECT_EQ(static_cast<bool>(stage.embree->closest(ray)), static_cast<bool>(stage.list.closest(ray)));
    }
    return static_cast<double>(stopped) / rays;
}

TEST(CornerAttributes, AlphaMultipliesTheOpacity)
{
    for (const float opacity : {1.0f, 0.5f}) {
        MeshData data = square(make_gauze("m", {0.5f, 0.5f, 0.5f}, opacity));
        data.alphas = {0, 1, 1, 0};  // from left to right
        data.colors.assign(4, {1, 1, 1});
        const Stage stage(scene_of(data));
        // Six standard deviations of 4000 rays.
        for (const double x : {-0.8, 0.0, 0.6})
            EXPECT_NEAR(stopped_part(stage, {x, 0.1, 0}), double{opacity} * (x + 1) / 2, 0.05) << x;
    }
    MeshData data = square(make_lambert("m", {0.5f, 0.5f, 0.5f}));
    data.alphas = {0, 0, 0, 0};
    SceneDescription d = scene_of(data);
    d.meshes[0].vertex_colors = VertexColors::none;
    const Stage opaque(d);
    EXPECT_TRUE(opaque.scene.shading[0].alphas.empty());
    EXPECT_EQ(stopped_part(opaque, {}), 1);
}

// What a light sends where it is sampled is what is seen of it on the mean.
TEST(CornerAttributes, AlphaDimsWhatALightSends)
{
    MeshData data = square(make_emitter("lamp", {2, 2, 2}));
    data.alphas = {0.25f, 0.25f, 0.25f, 0.25f};
    const Stage stage(scene_of(data));
    for (uint32_t id = 0; id < stage.scene.lights.lights.size(); ++id) {
        if (!std::holds_alternative<TriangleLight>(stage.scene.lights.lights[id])) continue;
        const Vec3 from = stage.to_scene({0.1, 0.2, 2});
        const auto s = sample_given_light(stage.scene, receiver(from, {0, 0, -1}), id, {0.3f, 0.6f});
        ASSERT_TRUE(s);
        EXPECT_FLOAT_EQ(s->radiance.g, 0.5f);
    }
}

}  // namespace
}  // namespace lancer
