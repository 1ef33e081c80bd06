// Colours of vertices: interpolated over triangles wherever these stand, a factor of the base colour of every material
// and of nothing else.
#include <gtest/gtest.h>

#include "core/srgb.h"
#include "scene/build/material_builder.h"
#include "support/random.h"
#include "support/stage.h"

namespace lancer {
namespace {

constexpr std::array corner_colors{Color{1, 0, 0}, Color{0, 0.5f, 0}, Color{0.25f, 0, 1}};

MeshDescription coloured_triangle(VertexColors meaning, const MaterialDescription& material = {})
{
    MeshData data = *make_mesh_data({{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}}, {{0, 1, 2}}, material);
    data.colors.assign(corner_colors.begin(), corner_colors.end());
    MeshDescription m = make_mesh(std::make_shared<const MeshData>(data));
    m.vertex_colors = meaning;
    return m;
}

Color mixed(const std::array<Color, 3>& c, double u, double v)
{
    const auto f = [](double x) { return static_cast<float>(x); };
    return c[0] * f(1 - u - v) + c[1] * f(u) + c[2] * f(v);
}
void expect_near(Color a, Color b)
{
    EXPECT_NEAR(a.r, b.r, 1e-5);
    EXPECT_NEAR(a.g, b.g, 1e-5);
    EXPECT_NEAR(a.b, b.b, 1e-5);
}

TEST(VertexColors, AreInterpolatedWhereverTheTriangleStands)
{
    Random random(5);
    for (const bool instanced : {false, true})
        for (const double mirrored : {1.0, -1.0}) {
            SceneDescription d;
            d.meshes.push_back(coloured_triangle(VertexColors::linear));
            const TransformDescription place{{0.3, 0.1, -0.2}, {0, 0, 20}, {0.7 * mirrored, 1.3, 1}};
            if (instanced) {
                d.meshes[0].name = "m";
                d.instances.push_back(instance_of("m", place));
            } else {
                d.meshes[0].transform = place;
            }
            const Stage stage(d);
            const Transform to_world = to_transform(place);
            for (int i = 0; i < 50; ++i) {
                const double u = random.uniform(0.01, 0.5), v = random.uniform(0.01, 0.48);
                const Vec3d p = to_world.point(Vec3d{-1, -1, 0} + Vec3d{2, 0, 0} * u + Vec3d{0, 2, 0} * v);
                const auto s = stage.look(stage.to_scene(p + Vec3d{0, 0, 2}), {0, 0, -1});
                ASSERT_TRUE(s);
                expect_near(s->vertex_color, mixed(corner_colors, u, v));
            }
        }
}

// The numbers of a file are those that the eye sees unless said otherwise; decoded at the corners, and then mixed.
TEST(VertexColors, AreDecoded)
{
    const auto at_corner = [](VertexColors meaning) {
        SceneDescription d;
        d.meshes.push_back(coloured_triangle(meaning));
        const Stage stage(d);
        return stage.look(stage.to_scene({0.9999, -0.9999, 2}), {0, 0, -1})->vertex_color.g;
    };
    EXPECT_EQ(MeshDescription{}.vertex_colors, VertexColors::srgb);
    EXPECT_NEAR(at_corner(VertexColors::srgb), linear_from_srgb(0.5), 1e-4);
    EXPECT_NEAR(at_corner(VertexColors::linear), 0.5, 1e-4);
    EXPECT_EQ(at_corner(VertexColors::none), 1);
}

TEST(VertexColors, CostNothingWhereThereAreNone)
{
    SceneDescription d = cornell_scene();
    d.meshes.push_back(coloured_triangle(VertexColors::none));
    for (const MeshShading& m : build_scene(d).shading) EXPECT_TRUE(m.colors.empty());
}

// What a BSDF of the place reflects is that of a material whose base colour is the product.
TEST(VertexColors, AreAFactorOfEveryBaseColour)
{
    const Color base{0.8f, 0.6f, 0.4f}, factor{0.5f, 0.25f, 1};
    for (const MaterialType type : {MaterialType::lambert, MaterialType::mirror, MaterialType::metal,
                                    MaterialType::glass, MaterialType::plastic}) {
        MaterialDescription plain = make_lambert("m", base), product = make_lambert("m", base * factor);
        plain.type = product.type = type;
        plain.emission = product.emission = {1, 2, 3};
        MaterialBuilder builder{{}};
        const auto id_of = [](const TextureUse&) { return no_texture; };
        const Material a = builder.make(plain, id_of), b = builder.make(product, id_of);
        const auto reflectance = [](const Material& m, const ShadingPoint& p) {
            return std::visit([&](const auto& some) { return some.at(p).reflectance(); }, m);
        };
        const auto diffuse = [](const Material& m, const ShadingPoint& p) {
            return std::visit(
                [&](const auto& some) {
                    const Phong phong = some.phong(p);
                    return phong.diffuse + phong.specular;
                },
                m);
        };
        const ShadingPoint coloured{.vertex_color = factor};
        EXPECT_EQ(reflectance(a, coloured), reflectance(b, {})) << static_cast<int>(type);
        EXPECT_EQ(diffuse(a, coloured), diffuse(b, {})) << static_cast<int>(type);
        EXPECT_NE(reflectance(a, coloured), reflectance(a, {})) << static_cast<int>(type);
    }
    Emission lamp{{1, 2, 3}};
    EXPECT_EQ(lamp.towards(true, {.vertex_color = factor}), (Color{1, 2, 3}));
}

}  // namespace
}  // namespace lancer
