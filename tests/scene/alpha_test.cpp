// Opacity as a probability: which rays surfaces of a scene stop, and how many.
#include "scene/alpha_test.h"

#include <gtest/gtest.h>

#include "geometry/accel.h"
#include "scene/build/scene_builder.h"
#include "support/stage.h"
#include "support/statistics/chi_square.h"
#include "support/statistics/significance.h"

namespace lancer {
namespace {

constexpr uint32_t sheets = 6;
constexpr double spacing = 0.2;

// Surfaces of one opacity behind each other, at z = 0.5, 0.3, ... -0.5.
SceneDescription stack(const std::string& of, float opacity)
{
    SceneDescription d;
    d.lights.push_back(sky_of({1, 1, 1}));
    const MaterialDescription gauze = make_gauze("gauze", {0.5f, 0.5f, 0.5f}, opacity);
    d.materials = {gauze};
    const auto z = [](uint32_t i) { return 0.5 - spacing * i; };
    const auto quad = [&](double at) { return make_quad({-1, -1, at}, {1, -1, at}, {1, 1, at}, {-1, 1, at}, gauze); };
    d.meshes.push_back(make_mesh(make_cube(gauze), {{0, 5, 0}, {}, {1, 1, 1}}));  // aside; scenes of planes need one
    if (of == "triangles of a mesh") {
        MeshData all = *quad(z(0));
        for (uint32_t i = 1; i < sheets; ++i) {
            const auto more = quad(z(i));
            for (const auto& t : more->triangles) all.triangles.push_back({t[0] + 4 * i, t[1] + 4 * i, t[2] + 4 * i});
            all.positions.insert(all.positions.end(), more->positions.begin(), more->positions.end());
        }
        d.meshes.push_back(make_mesh(std::make_shared<const MeshData>(all)));
    }
    if (of == "instances") {
        d.meshes.push_back(make_mesh(quad(0)));
        d.meshes.back().name = "sheet";
    }
    for (uint32_t i = 0; i < sheets; ++i) {
        if (of == "meshes") d.meshes.push_back(make_mesh(quad(z(i))));
        if (of == "instances")
            d.instances.push_back(instance_of("sheet", {{0, 0, z(i)}, {0, 0, 10.0 * i}, {1, 1 + 0.1 * i, 1}}));
        if (of == "planes") d.planes.push_back(plane_of({0, 0, z(i)}, {0, 0, 1}, "gauze"));
        // Each is passed twice.
        if (of == "spheres" && i < sheets / 2) d.spheres.push_back(sphere_of({0, 0, 0}, z(i), "gauze"));
    }
    return d;
}

class Stack : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Of, Stack, testing::Values("triangles of a mesh", "meshes", "instances", "planes", "spheres"),
                         [](const testing::TestParamInfo<const char*>& of) {
                             std::string name = of.param;
                             std::replace(name.begin(), name.end(), ' ', '_');
                             return name;
                         });

// Each sheet stops a of what comes there, whatever those before it did: (1 - a)^k get through k of them.
TEST_P(Stack, LetsThroughWhatItsOpacityLeaves)
{
    constexpr uint32_t n = 20000;
    stats::Family family;
    for (const float opacity : {0.1f, 0.5f, 0.9f}) {
        const Stage stage(stack(GetParam(), opacity));
        Ray ray{.org = stage.to_scene({0.013, 0.029, 1}), .dir = {0, 0, -1}};
        std::vector<uint64_t> stopped(sheets + 1), seen(2);
        for (uint32_t i = 0; i < n; ++i) {
            ray.key = i;
            const Hit hit = stage.embree->closest(ray);
            const double z = 1 - static_cast<double>(hit.t) / stage.scene.normalisation.scale;
            ++stopped[hit ? static_cast<size_t>(std::lround((0.5 - z) / spacing)) : sheets];
            ray.key = n + i;
            ++seen[stage.embree->any(ray) ? 0 : 1];
            if (i % 10) continue;
            ASSERT_EQ(stage.list.any(ray), stage.embree->any(ray));
        }
        std::vector<double> expected;
        double left = n;
        for (uint32_t i = 0; i < sheets; ++i) {
            expected.push_back(left * static_cast<double>(opacity));
            left -= expected.back();
        }
        expected.push_back(left);
        const std::string what = std::string(GetParam()) + " of " + std::to_string(opacity);
        family.add(chi_square_test(stopped, expected).p, what + ", stopped at");
        family.add(chi_square_test(seen, {n - left, left}).p, what + ", passed all");
    }
}

// Sheet for sheet: whether one stops a ray tells nothing about the next.
TEST_P(Stack, DrawsANumberForEachSurface)
{
    constexpr uint32_t n = 20000;
    const Stage stage(stack(GetParam(), 0.5f));
    const Ray ray{.org = stage.to_scene({0.013, 0.029, 1}), .dir = {0, 0, -1}};
    const double scale = stage.scene.normalisation.scale;
    stats::Family family;
    for (uint32_t a = 0; a < sheets; ++a)
        for (uint32_t b = a + 1; b < sheets; ++b) {
            std::vector<uint64_t> both(4);
            for (uint32_t key = 0; key < n; ++key) {
                const auto stops = [&](uint32_t sheet) {
                    Ray part = ray;
                    part.key = key;
                    part.t_min = static_cast<float>(scale * (0.4 + spacing * sheet));
                    part.t_max = static_cast<float>(scale * (0.6 + spacing * sheet));
                    return stage.embree->any(part) ? 1u : 0u;
                };
                ++both[2 * stops(a) + stops(b)];
            }
            family.add(chi_square_uniform(both).p, std::to_string(a) + " and " + std::to_string(b));
        }
}

TEST(Opacity, OfOneOrNoneDoesNotLookAtTheKey)
{
    for (const auto& [opacity, stops] : {std::pair{0.0f, false}, {1.0f, true}}) {
        // One face of the stack keeps a hole of its own, so that rays are asked about in both cases.
        SceneDescription d = stack("meshes", opacity);
        MeshData data = *d.meshes[2].data;
        data.materials.push_back(make_gauze("half", {}, 0.5f));
        data.positions.insert(data.positions.end(), {{5, 5, 5}, {6, 5, 5}, {5, 6, 5}});
        data.triangles.push_back({4, 5, 6});
        data.face_material = {0, 0, 1};
        d.meshes[2].data = std::make_shared<const MeshData>(data);
        const Stage stage(d);
        ASSERT_TRUE(stage.scene.geometry.alpha_test.passes_through);
        for (uint32_t key = 0; key < 3000; ++key) {
            const Ray ray{.org = stage.to_scene({0.013, 0.029, 0.4}), .dir = {0, 0, -1}, .key = key};
            EXPECT_EQ(stage.embree->any(ray), stops);
            EXPECT_EQ(stage.list.any(ray), stops);
        }
    }
}

TEST(Opacity, IsAskedForOnlyWhereItMatters)
{
    for (const auto& [name, d] : all_test_scenes()) {
        const Stage stage(d);
        const AlphaTest& holes = stage.scene.geometry.alpha_test;
        EXPECT_EQ(holes.passes_through != nullptr, std::string(name) == "holes") << name;
        if (!holes.passes_through) continue;
        EXPECT_TRUE(holes.spheres && holes.planes);
        ASSERT_EQ(holes.meshes.size(), 5u);
        EXPECT_TRUE(holes.meshes[0].empty());
        EXPECT_EQ(holes.meshes[1], (std::vector<uint8_t>{1, 1}));
        EXPECT_EQ(holes.meshes[2], (std::vector<uint8_t>{0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1}));
    }
}

// Texel by texel, in an instance that is turned and mirrored; the picture arrives when the accelerator stands already.
TEST(Opacity, OfAPictureCutsCrispHoles)
{
    constexpr uint32_t side = 8;
    Raster raster{.width = side, .height = side, .channels = 1, .bytes = {}, .floats = {}};
    for (uint32_t i = 0; i < side * side; ++i) raster.bytes.push_back(i * 37 % 5 < 2 ? 255 : 0);
    MaterialDescription leaf = make_lambert("leaf", {0.5f, 0.5f, 0.5f});
    TextureDescription picture;
    picture.file = "leaf";
    picture.use.encoding = Encoding::linear;
    picture.use.channel = Channel::red;
    leaf.opacity_map = picture;
    SceneDescription d;
    d.lights.push_back(sky_of({1, 1, 1}));
    d.meshes.push_back(make_mesh(make_mapped_quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 1}, leaf)));
    d.meshes[0].name = "leaf";
    const TransformDescription placed{{0.3, -0.2, 0.1}, {20, 30, 40}, {-1.5, 0.7, 1}};
    d.instances.push_back(instance_of("leaf", placed));

    std::promise<std::shared_ptr<const Raster>> reading;
    Diagnostics diagnostics;
    SceneBuilder builder =
        Scene::begin(d, d.render, diagnostics, [&](const std::string&) { return reading.get_future().share(); });
    const auto embree = make_accelerator(AccelKind::embree, builder.geometry(), "avx2");
    reading.set_value(std::make_shared<const Raster>(raster));
    const std::unique_ptr<const Scene> finished = builder.finish(diagnostics);
    const Scene& scene = *finished;
    EXPECT_TRUE(diagnostics.warnings().empty());

    const Transform to_world = compose(to_transform(scene.normalisation), to_transform(placed));
    int stopped = 0;
    for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x) {
            const Vec3d at = to_world.point({(x + 0.5) / side, (y + 0.5) / side, 0});
            const Vec3d from = to_world.point({0.4, 0.6, 1});
            const Ray ray{.org = to_float(from), .dir = to_float(normalize(at - from)), .key = 7};
            const bool opaque = raster.bytes[(side - 1 - y) * side + x];  // rows from the top
            EXPECT_EQ(embree->any(ray), opaque) << x << " " << y;
            EXPECT_EQ(static_cast<bool>(embree->closest(ray)), opaque) << x << " " << y;
            stopped += opaque ? 1 : 0;
        }
    EXPECT_GT(stopped, 10);
    EXPECT_LT(stopped, 50);
}

// An emitter of which a part is missing sends that part less; what a light sample says must have it.
TEST(Opacity, OfALightIsInItsSamples)
{
    for (const float opacity : {0.25f, 1.0f}) {
        MaterialDescription glow = make_gauze("glow", {}, opacity);
        glow.emission = {8, 8, 8};
        SceneDescription ball, panel;
        ball.materials = {glow};
        ball.spheres.push_back(sphere_of({0, 1, 0}, 0.3, "glow"));
        panel.meshes.push_back(make_mesh(make_quad({-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}, glow)));
        for (const SceneDescription& d : {ball, panel}) {
            const Stage stage(d);
            const auto s =
                sample_light(stage.scene, receiver(stage.to_scene({0, 0, 0}), {0, 1, 0}), 0.3f, {0.2f, 0.6f});
            ASSERT_TRUE(s);
            EXPECT_EQ(s->radiance.r, 8 * opacity);
        }
    }
}

}  // namespace
}  // namespace lancer
