// Divided and displaced meshes: closed ones stay closed, a displaced sphere is the shape that it should be, and what
// decides how finely a mesh is divided.
#include <gtest/gtest.h>

#include <future>
#include <map>

#include "core/parallel.h"
#include "scene/build/displace.h"
#include "scene/build/divide.h"
#include "scene/build/divide_meshes.h"
#include "support/displaced.h"
#include "support/random.h"
#include "support/stage.h"

namespace lancer {
namespace {

// "white", and "smooth", which is 0.5 + 0.25 cos(2 pi u) cos(2 pi v); others of the test pictures.
RasterFuture pictures(const std::string& name)
{
    const bool is_smooth = name == "smooth";
    if (!is_smooth && name != "white") return test_picture(name);
    Raster r;
    r.width = r.height = is_smooth ? 256 : 1;
    r.channels = 1;
    r.is_float = true;
    for (uint32_t y = 0; y < r.height; ++y)
        for (uint32_t x = 0; x < r.width; ++x) {
            const auto wave = [&](uint32_t i) { return std::cos(2 * pi_d * (i + 0.5) / r.width); };
            r.floats.push_back(is_smooth ? static_cast<float>(0.5 + 0.25 * wave(x) * wave(y)) : 1.0f);
        }
    std::promise<std::shared_ptr<const Raster>> promise;
    promise.set_value(std::make_shared<const Raster>(std::move(r)));
    return promise.get_future().share();
}

// How many edges do not have one triangle on each side.
size_t open_edges(const MeshData& data)
{
    using Place = std::array<double, 3>;
    std::map<std::pair<Place, Place>, int> sides;
    const auto place = [&](uint32_t i) { return Place{data.positions[i].x, data.positions[i].y, data.positions[i].z}; };
    for (const auto& t : data.triangles)
        for (size_t k = 0; k < 3; ++k) {
            const Place a = place(t[k]), b = place(t[(k + 1) % 3]);
            if (a < b)
                ++sides[{a, b}];
            else
                sides[{b, a}] += 1000;
        }
    size_t open = 0;
    for (const auto& [edge, count] : sides) open += count == 1001 ? 0 : 1;
    return open;
}

MeshData divided(const SceneDescription& d, const PictureMemory& memory = {})
{
    return divided_mesh(d, pictures, memory);
}

TEST(Displacement, AClosedMeshStaysClosedWhereverItIsDivided)
{
    const MaterialDescription m = displaced_by("waves", 0.4f);
    ASSERT_EQ(open_edges(seamed_cube(m)), 0u);
    for (uint32_t n = 0; n <= 4; ++n) {
        const MeshData made = divided(displaced_scene(seamed_cube(m), m, level(n)));
        EXPECT_EQ(made.triangles.size(), 12u << 2 * n);
        EXPECT_EQ(open_edges(made), 0u) << n;
    }
    // By pixels, from close to a corner: some edges of a triangle are halved more often than others.
    for (const double edge : {60.0, 17.0, 5.0}) {
        SceneDescription d = displaced_scene(seamed_cube(m), m, edges_of(edge));
        d.camera->position = {1.3, 1.4, 1.2};
        const MeshData made = divided(d);
        EXPECT_GT(made.triangles.size(), 100u);
        for (uint32_t n = 0; n < 10; ++n) EXPECT_NE(made.triangles.size(), 12u << 2 * n) << "not everywhere the same";
        EXPECT_EQ(open_edges(made), 0u) << edge;
    }
}

TEST(Displacement, NoRayEscapesFromWithin)
{
    const MaterialDescription m = displaced_by("waves", 0.4f);
    SceneDescription d = displaced_scene(seamed_cube(m), m, edges_of(25));
    d.camera->position = {1.3, 1.4, 1.2};
    const Stage stage(d, pictures);
    Random random(3);
    for (int i = 0; i < 20000; ++i) {
        const Ray ray{.org = stage.to_scene(random.point(-0.5, 0.5)), .dir = random.unit_vector()};
        ASSERT_TRUE(stage.embree->closest(ray)) << i;
        ASSERT_TRUE(i % 10 != 0 || stage.list.closest(ray)) << i;
    }
}

TEST(Displacement, ASphereByAnEvenMapIsALargerSphereAndConverges)
{
    const MaterialDescription m = displaced_by("white", 0.5f);
    for (uint32_t n = 1; n <= 4; ++n) {
        const MeshData made = divided(displaced_scene(displaceable_ball(2, m), m, level(n)));
        double worst_normal = 0, radius = 0;
        for (size_t t = 0; t < made.triangles.size(); ++t)
            for (size_t k = 0; k < 3; ++k) {
                const Vec3d p = made.positions[made.triangles[t][k]];
                radius += length(p) / (3.0 * static_cast<double>(made.triangles.size()));
                worst_normal =
                    std::max(worst_normal, 1 - dot(normalize(p), to_double(made.normals[made.normal_triangles[t][k]])));
            }
        // Middles of edges of the coarse ball lie inside of the unit sphere, so that the radius is a bit below 1.5.
        EXPECT_GT(radius, 1.46);
        EXPECT_LE(radius, 1.5 + 1e-6);
        EXPECT_LT(worst_normal, 0.02);
    }
    // Of finer balls the middles come closer to it, by a quarter each time.
    double before = 1;
    for (uint32_t rounds = 1; rounds <= 4; ++rounds) {
        const MeshData made = divided(displaced_scene(displaceable_ball(rounds, m), m, level(2)));
        double error = 0;
        for (const Vec3d& p : made.positions) error = std::max(error, std::abs(length(p) - 1.5));
        EXPECT_LT(error, 0.45 * before) << rounds;
        before = error;
    }
}

TEST(Displacement, AShapeByAMapConverges)
{
    // A flat square of heights cos: against the surface that they are.
    const MaterialDescription m = displaced_by("smooth", 0.3f);
    MeshData square = *make_mapped_quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 1}, m);
    double before = 1;
    for (uint32_t n = 2; n <= 5; ++n) {
        const SceneDescription d = displaced_scene(square, m, level(n));
        const Stage stage(d, pictures);
        double error = 0;
        for (int i = 0; i < 400; ++i) {
            const double x = (i % 20 + 0.31) / 20, y = (i / 20 + 0.57) / 20;
            const auto s = stage.look(stage.to_scene({x, y, 3}), {0, 0, -1});
            ASSERT_TRUE(s);
            const double height = stage.scene.normalisation.to_file(to_double(s->p)).z;
            error = std::max(error,
                             std::abs(height - 0.3 * (0.5 + 0.25 * std::cos(2 * pi_d * x) * std::cos(2 * pi_d * y))));
        }
        EXPECT_LT(error, 0.45 * before) << n;
        before = error;
    }
    EXPECT_LT(before, 0.003);
}

TEST(Displacement, IsTheSameForAnyNumberOfThreads)
{
    const MaterialDescription m = displaced_by("waves", 0.4f);
    SceneDescription d = displaced_scene(displaceable_ball(3, m), m, edges_of(9));
    MeshData one, four;
    with_threads(1, [&] { one = divided(d); });
    with_threads(4, [&] { four = divided(d); });
    EXPECT_EQ(one.positions, four.positions);
    EXPECT_EQ(one.normals, four.normals);
    EXPECT_EQ(one.triangles, four.triangles);
    EXPECT_EQ(one.normal_triangles, four.normal_triangles);
    EXPECT_EQ(one.uvs, four.uvs);
}

TEST(Displacement, HardEdgesStayHardAndSmoothOnesSmooth)
{
    const MaterialDescription m = displaced_by("white", 0.5f);
    const MeshData cube = divided(displaced_scene(seamed_cube(m), m, level(2)));
    const MeshData round = divided(displaced_scene(displaceable_ball(2, m), m, level(1)));
    const auto most_at_a_place = [](const MeshData& data) {
        std::map<std::array<double, 3>, std::vector<Vec3>> normals;
        size_t most = 0;
        for (size_t t = 0; t < data.triangles.size(); ++t)
            for (size_t k = 0; k < 3; ++k) {
                const Vec3d p = data.positions[data.triangles[t][k]];
                auto& there = normals[{p.x, p.y, p.z}];
                const Vec3 n = data.normals[data.normal_triangles[t][k]];
                if (std::find(there.begin(), there.end(), n) == there.end()) there.push_back(n);
                most = std::max(most, there.size());
            }
        return most;
    };
    EXPECT_EQ(most_at_a_place(cube), 3u);
    EXPECT_EQ(most_at_a_place(round), 1u);
}

TEST(Displacement, TheFirstCameraDecidesHowFinely)
{
    const MaterialDescription m = displaced_by("waves", 0.1f);
    SceneDescription d = displaced_scene(seamed_cube(m), m, edges_of(40));
    const size_t near = divided(d).triangles.size();
    SceneDescription far = d;
    far.camera->position = {0, 0, 24};
    EXPECT_LT(4 * divided(far).triangles.size(), near);
    far.first_camera = d.camera;  // that of the first frame: what the camera of this one is does not count
    EXPECT_EQ(divided(far).triangles.size(), near);
    SceneDescription large = d;
    large.render.size = {d.render.size.width * 4, d.render.size.height * 4};
    EXPECT_GT(divided(large).triangles.size(), 8 * near);
    large.meshes[0].subdivision.level = 2;
    EXPECT_EQ(divided(large).triangles.size(), 12u * 16);
    // An instance that is near counts.
    far.first_camera.reset();
    far.meshes[0].name = "m";
    far.instances = {instance_of("m", {}), instance_of("m", {{0, 0, 18}, {}, {1, 1, 1}})};
    EXPECT_EQ(divided(far).triangles.size(), near);
}

TEST(Displacement, WhatOnlyAFileNamesDoesNotDivide)
{
    SceneDescription d = displaced_scene(seamed_cube({}), displaced_by("waves", 0.1f), {});
    EXPECT_GT(divided(d).triangles.size(), 12u) << "a material of the scene does";
    d.meshes[0].material.clear();
    MeshData data = seamed_cube(displaced_by("waves", 0.1f));
    d.meshes[0].data = std::make_shared<const MeshData>(data);
    std::vector<Scene::Note> notes;
    Diagnostics diagnostics;
    EXPECT_FALSE(divide_meshes(d, d.render, test_picture, {}, notes, diagnostics));
    ASSERT_EQ(diagnostics.warnings().size(), 1u);
    EXPECT_NE(to_string(diagnostics.warnings()[0]).find("'subdivision_edge'"), std::string::npos);
    d.meshes[0].subdivision = level(3);
    const auto made = divide_meshes(d, d.render, test_picture, {}, notes, diagnostics);
    ASSERT_TRUE(made);
    EXPECT_EQ(made->meshes[0].data->triangles.size(), 12u * 64);
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_EQ(notes[0].text, "12 triangles were divided into 768, 3 times at most");
}

TEST(Displacement, ThatTakesTooMuchMemoryIsRefusedBefore)
{
    const MaterialDescription m = displaced_by("waves", 0.1f);
    const SceneDescription d = displaced_scene(seamed_cube(m), m, level(12));
    PictureMemory memory;
    memory.limit = 100'000'000, memory.limit_text = "100 MB";
    try {
        divided(d, memory);
        FAIL() << "not refused";
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::no_memory);
        EXPECT_NE(
            std::string(e.what()).find("201326592 triangles and takes about 52344 MB, and --memory allows 100 MB"),
            std::string::npos)
            << e.what();
    }
}

}  // namespace
}  // namespace lancer
