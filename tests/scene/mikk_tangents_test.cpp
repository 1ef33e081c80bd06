// Tangents for maps of normals: those of another implementation of MikkTSpace, those of files, and where none are kept.
#include <gtest/gtest.h>

#include "scene/build/mesh_tables.h"
#include "scene/shading_normal.h"
#include "support/stage.h"

namespace lancer {
namespace {

// Eight smooth triangles over a square, whose texture coordinates are mirrored at x = 0. Corners, normals and tangents
// are those of Blender 3.4.1 (mesh.calc_tangents(), which is MikkTSpace).
constexpr std::array<Vec3d, 9> places{{{-1, -1, 0.3},
                                       {0, -1, -0.2},
                                       {1, -1, 0.1},
                                       {-1, 0, 0},
                                       {0, 0, 0.5},
                                       {1, 0, -0.3},
                                       {-1, 1, 0.2},
                                       {0, 1, -0.1},
                                       {1, 1, 0.4}}};
constexpr std::array<Vec3, 9> normals{{{-0.0100733f, -0.1864107f, 0.9824203f},
                                       {0.0625986f, -0.5723377f, 0.8176253f},
                                       {0.2366440f, -0.1474906f, 0.9603366f},
                                       {-0.4468658f, 0.0394279f, 0.8937317f},
                                       {0.0543343f, -0.0411434f, 0.9976748f},
                                       {0.6228607f, -0.0765789f, 0.7785758f},
                                       {-0.0994444f, 0.1933771f, 0.9760718f},
                                       {-0.0662369f, 0.5133659f, 0.8556098f},
                                       {0.1287482f, -0.0296248f, 0.9912347f}}};
constexpr std::array<std::array<uint32_t, 3>, 8> faces{
    {{0, 1, 4}, {0, 4, 3}, {1, 2, 4}, {2, 5, 4}, {3, 4, 6}, {4, 7, 6}, {4, 5, 8}, {4, 8, 7}}};
constexpr std::array<std::array<MeshTangent, 3>, 8> expected{{{{{{-0.984861f, 0.171878f, 0.022515f}, -1},
                                                                {{-0.900164f, 0.321430f, 0.293919f}, -1},
                                                                {{-0.985204f, 0.160440f, 0.060272f}, -1}}},
                                                              {{{{-0.984861f, 0.171878f, 0.022515f}, -1},
                                                                {{-0.985204f, 0.160440f, 0.060272f}, -1},
                                                                {{-0.882098f, 0.147025f, -0.447535f}, -1}}},
                                                              {{{{0.997530f, 0.009712f, -0.069574f}, 1},
                                                                {{0.953275f, -0.155800f, -0.258832f}, 1},
                                                                {{0.983843f, -0.168491f, -0.060529f}, 1}}},
                                                              {{{{0.953275f, -0.155800f, -0.258832f}, 1},
                                                                {{0.768258f, -0.128056f, -0.627201f}, 1},
                                                                {{0.983843f, -0.168491f, -0.060529f}, 1}}},
                                                              {{{{-0.882098f, 0.147025f, -0.447535f}, -1},
                                                                {{-0.985204f, 0.160440f, 0.060272f}, -1},
                                                                {{-0.978589f, 0.158645f, -0.131131f}, -1}}},
                                                              {{{{-0.985204f, 0.160440f, 0.060272f}, -1},
                                                                {{-0.996974f, 0.000907f, -0.077725f}, -1},
                                                                {{-0.978589f, 0.158645f, -0.131131f}, -1}}},
                                                              {{{{0.983843f, -0.168491f, -0.060529f}, 1},
                                                                {{0.768258f, -0.128056f, -0.627201f}, 1},
                                                                {{0.977778f, -0.162973f, -0.131871f}, 1}}},
                                                              {{{{0.983843f, -0.168491f, -0.060529f}, 1},
                                                                {{0.977778f, -0.162973f, -0.131871f}, 1},
                                                                {{0.913277f, -0.314207f, 0.259226f}, 1}}}}};

MaterialDescription mapped(bool has_map = true)
{
    MaterialDescription m = make_lambert("mapped", {0.8f, 0.8f, 0.8f});
    if (has_map)
        m.normal_map = picture_of("tilted normals", Encoding::linear);
    else
        m.base_color_map = picture_of("colours", Encoding::srgb);
    return m;
}

MeshData bent_square(const MaterialDescription& material)
{
    MeshData data = *make_mesh_data({places.begin(), places.end()}, {faces.begin(), faces.end()}, material);
    data.normals.assign(normals.begin(), normals.end());
    data.normal_triangles = data.uv_triangles = data.triangles;
    // At x = 0 both sides have the same coordinates, as a mirrored picture has.
    for (const Vec3d& p : places) {
        const auto u = 0.25 * std::abs(p.x) + 0.125 * p.y;
        const auto v = 0.375 * p.y + 0.0625 * p.x * p.x + 0.125 * p.x * (p.x < 0 ? 1 : 0);
        data.uvs.push_back({static_cast<float>(u), static_cast<float>(v)});
    }
    return data;
}
MeshDescription mesh_of(MeshData data) { return make_mesh(std::make_shared<const MeshData>(std::move(data))); }

Scene scene_of(const MeshDescription& mesh)
{
    SceneDescription d;
    d.meshes.push_back(mesh);
    return build_scene(d);
}

MeshTangent tangent(const Scene& scene, uint32_t triangle, size_t corner)
{
    const CornerTangents& t = scene.shading[0].tangents;
    return t.values[(*t.triangles.find(triangle))[corner]];
}

TEST(MikkTangents, AreThoseOfAnotherImplementation)
{
    const Scene scene = scene_of(mesh_of(bent_square(mapped())));
    for (uint32_t t = 0; t < faces.size(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            const MeshTangent found = tangent(scene, t, k);
            EXPECT_LT(length(found.along - expected[t][k].along), 1e-5f) << t << " " << k;
            EXPECT_EQ(found.sign, expected[t][k].sign) << t << " " << k;
        }
    // One for each vertex, and two for those at the mirror.
    EXPECT_EQ(scene.shading[0].tangents.values.size(), 12u);
}

TEST(MikkTangents, AreTheSameWhereVerticesAreRepeated)
{
    MeshData apart = bent_square(mapped());
    const MeshData whole = apart;
    apart.positions.clear(), apart.normals.clear(), apart.uvs.clear();
    for (uint32_t t = 0; t < faces.size(); ++t)
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t v = whole.triangles[t][k];
            apart.positions.push_back(whole.positions[v]);
            apart.normals.push_back(whole.normals[v]);
            apart.uvs.push_back(whole.uvs[v]);
            apart.triangles[t][k] = apart.normal_triangles[t][k] = apart.uv_triangles[t][k] = 3 * t + k;
        }
    const Scene a = scene_of(mesh_of(whole)), b = scene_of(mesh_of(apart));
    for (uint32_t t = 0; t < faces.size(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(tangent(a, t, k).along, tangent(b, t, k).along);
            EXPECT_EQ(tangent(a, t, k).sign, tangent(b, t, k).sign);
        }
}

TEST(MikkTangents, AreKeptForMapsOfNormalsAlone)
{
    EXPECT_TRUE(scene_of(mesh_of(bent_square(mapped(false)))).shading[0].tangents.empty());
    MeshData half = bent_square(mapped());
    half.materials.push_back(mapped(false));
    half.face_material = {0, 1, 1, 1, 1, 1, 1, 1};
    const Scene scene = scene_of(mesh_of(half));
    EXPECT_EQ(scene.shading[0].tangents.values.size(), 3u);
    EXPECT_TRUE(scene.shading[0].tangents.triangles.find(0));
    for (uint32_t t = 1; t < faces.size(); ++t) EXPECT_FALSE(scene.shading[0].tangents.triangles.find(t));
    EXPECT_LT(length(tangent(scene, 0, 2).along - expected[0][2].along), 1e-5f) << "neighbours still count";
    // Named as heights, they turn out to be normals.
    MaterialDescription named = make_lambert("named", {0.8f, 0.8f, 0.8f});
    named.bump_map = picture_of("tilted normals", Encoding::linear);
    named.bump_map->may_be_normals = true;
    EXPECT_EQ(scene_of(mesh_of(bent_square(named))).shading[0].tangents.values.size(), 12u);
}

TEST(MikkTangents, OfAFileAreUsedAsTheyAre)
{
    MeshData data = bent_square(mapped());
    for (size_t i = 0; i < places.size(); ++i)
        data.tangents.push_back({normalize(Vec3{1, static_cast<float>(i) * 0.1f, 0}), i % 2 ? 1.0f : -1.0f});
    data.tangents[8] = {};  // computed in the triangles that use it
    const Scene scene = scene_of(mesh_of(data));
    for (uint32_t t = 0; t < 6; ++t)
        for (size_t k = 0; k < 3; ++k) {
            const MeshTangent& file = data.tangents[faces[t][k]];
            EXPECT_LT(length(tangent(scene, t, k).along - file.along), 1e-6f);
            EXPECT_EQ(tangent(scene, t, k).sign, file.sign);
        }
    EXPECT_LT(length(tangent(scene, 7, 1).along - expected[7][1].along), 1e-5f);
}

// What a mirror shows is the mirror image of what is there, by a transform and by an instance.
TEST(MikkTangents, MirroredMeshesHaveMirroredNormals)
{
    for (const bool in_file : {false, true}) {
        MeshData data = bent_square(mapped());
        if (in_file)
            for (size_t i = 0; i < places.size(); ++i)
                data.tangents.push_back({normalize(cross(Vec3{0, 1, 0}, normals[i])), -1});
        SceneDescription plain, mirrored, instanced;
        plain.meshes = mirrored.meshes = instanced.meshes = {mesh_of(data)};
        const TransformDescription mirror{{}, {}, {-1, 1, 1}};
        mirrored.meshes[0].transform = mirror;
        instanced.meshes[0].name = "m";
        instanced.instances.push_back(instance_of("m", mirror));
        const Stage a(plain), b(mirrored), c(instanced);
        for (const Vec3d at : {Vec3d{-0.6, -0.3, 0}, Vec3d{0.7, 0.2, 0}, Vec3d{0.2, -0.7, 0}, Vec3d{-0.2, 0.6, 0}}) {
            const auto look = [&](const Stage& stage, double side) {
                return stage.look(stage.to_scene({side * at.x, at.y, 3}), {0, 0, -1});
            };
            const auto there = look(a, 1), by_transform = look(b, -1), by_instance = look(c, -1);
            ASSERT_TRUE(there && by_transform && by_instance);
            const Vec3 image{-there->ns.x, there->ns.y, there->ns.z};
            EXPECT_LT(length(by_transform->ns - image), 1e-5f) << in_file;
            EXPECT_LT(length(by_instance->ns - image), 1e-5f) << in_file;
        }
    }
}

// The sum of the three vectors is not normalised before the map, as what bakes a map inverts it so.
TEST(MikkTangents, AreInterpolatedWithoutNormalising)
{
    SceneDescription d;
    d.meshes.push_back(mesh_of(bent_square(mapped())));
    const Stage stage(d);
    const Ray ray{.org = stage.to_scene({-0.6, -0.3, 3}), .dir = {0, 0, -1}};
    const Hit hit = stage.list.closest(ray);
    ASSERT_TRUE(hit);
    const Surface s = surface_at(stage.scene, ray, hit);
    const auto& t = faces[hit.primitive];
    const float w[] = {1 - hit.uv.x - hit.uv.y, hit.uv.x, hit.uv.y};
    Vec3 x, z;
    for (size_t k = 0; k < 3; ++k) x = x + expected[hit.primitive][k].along * w[k], z = z + normals[t[k]] * w[k];
    const Vec3 y = cross(z, x) * expected[hit.primitive][0].sign;
    const ShadingPoint p = stage.scene.shading_point(s);
    const Color c = p.eval(stage.scene.traits[s.material].normal_map);
    const Vec3 n = normalize(x * (2 * c.r - 1) + y * (2 * c.g - 1) + z * (2 * c.b - 1));
    EXPECT_LT(length(s.ns_front - n), 2e-5f);
    EXPECT_GT(length(s.ns_front - normalize(z)), 0.05f) << "the map tilts";
}

TEST(MikkTangents, GiveAnOrthonormalFrameAtAHit)
{
    SceneDescription d = textured_scene();
    d.meshes.push_back(mesh_of(bent_square(mapped())));
    const Stage stage(d);
    int found = 0;
    for (int i = 0; i < 400; ++i) {
        const Vec3 to{static_cast<float>(i % 20) * 0.1f - 1, static_cast<float>(i / 20) * 0.1f - 1, -1};
        const Ray ray{.org = stage.to_scene({0, 0.2, 4}), .dir = normalize(to - Vec3{0, 0, 2})};
        const Hit hit = stage.list.closest(ray);
        if (!hit) continue;
        const Surface s = surface_at(stage.scene, ray, hit);
        const auto f = tangent_frame_at(stage.scene, hit, 0, s.ns_front);
        if (!f) continue;
        ++found;
        EXPECT_NEAR(length(f->x), 1, 1e-5f);
        EXPECT_NEAR(length(f->y), 1, 1e-5f);
        EXPECT_NEAR(dot(f->x, f->y), 0, 1e-5f);
        EXPECT_NEAR(dot(f->x, s.ns_front), 0, 1e-5f);
        EXPECT_EQ(f->z, s.ns_front);
    }
    EXPECT_GT(found, 100);
}

}  // namespace
}  // namespace lancer
