// Light by way of large flat mirrors: against closed forms, BSDF sampling, and the same bits whatever traces it.
#include <gtest/gtest.h>

#include <cmath>

#include "support/render.h"
#include "support/shoot.h"

namespace lancer {
namespace {

MaterialDescription mirror() { return make_glossy("mirror", MaterialType::mirror, {0.9f, 0.8f, 0.5f}, 0); }
// A floor at y = 0 and a mirror at x = 2, from z = -4 to 4 and up to y = 4; the camera sees the floor near the origin.
// The shade keeps direct light away.
SceneDescription floor_beside_mirror(const LightDescription& light, bool shaded = true)
{
    SceneDescription d;
    d.meshes.push_back(make_mesh(
        make_quad({-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}, make_lambert("floor", {0.5f, 0.5f, 0.5f}))));
    d.meshes.push_back(make_mesh(make_quad({2, 0, -4}, {2, 0, 4}, {2, 4, 4}, {2, 4, -4}, mirror())));
    if (shaded)
        d.meshes.push_back(make_mesh(
            make_quad({-0.5, 1, -2}, {0.5, 1, -2}, {0.5, 1, 2}, {-0.5, 1, 2}, make_lambert("shade", {0, 0, 0}))));
    d.lights = {light};
    d.camera = make_camera({-2, 0.8, 0}, {0, 0, 0}, 2);
    return d;
}
constexpr Vec3d lamp{0, 2, 0}, image{4, 2, 0};

// The same mirror as an instance of a square, whose other instance is too small to be one.
SceneDescription with_instanced_mirror(SceneDescription d)
{
    d.meshes[1] =
        make_mesh(make_quad({-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}, mirror()), {{}, {}, {1.0 / 3, 1.0 / 3, 1}});
    d.meshes[1].name = "square";
    d.instances = {instance_of("square", {{-7, 0.1, 7}, {0, 20, 0}, {0.05, 0.05, 1}}),
                   instance_of("square", {{2, 2, 0}, {0, -90, 0}, {4, 2, 1}})};
    return d;
}

// The floor at the origin by a point or a direction, without noise.
TEST(MirroredLight, IsThatOfTheImageBehindTheMirror)
{
    const double d2 = dot(image, image), cos = image.y / std::sqrt(d2);
    const Vec3d from =
        normalize(Vec3d{-1, 1, 0.2});  // a sun that is seen beside the shade, and its image on the other side
    for (const AccelKind accel : {AccelKind::embree, AccelKind::bvh8, AccelKind::list})
        for (const bool by_one : {false, true}) {
            RenderRequest request;
            request.width = request.height = 4;
            request.settings.integrator = Path{.max_depth = 2};
            request.settings.accel = accel;
            if (by_one) request.settings.kernel.profile = Profile::all;
            for (const bool instanced : {false, true}) {
                const auto seen = [&](const LightDescription& light) {
                    SceneDescription d = floor_beside_mirror(light);
                    if (instanced) d = with_instanced_mirror(d);
                    d.camera->fov_deg = 0.01;
                    return render(d, request).film.at(2, 2).mean();
                };
                const Color point = seen(light_of(LightType::point, {60, 60, 60}, lamp));
                const double expected = 0.5 / pi_d * 60 * cos / d2;
                EXPECT_NEAR(point.r, 0.9 * expected, 1e-3 * expected) << instanced;
                EXPECT_NEAR(point.g, 0.8 * expected, 1e-3 * expected) << instanced;
                EXPECT_NEAR(point.b, 0.5 * expected, 1e-3 * expected) << instanced;
                const Color sun = seen(directional_of({3, 3, 3}, -from));
                EXPECT_NEAR(sun.g, (1 + 0.8) * 0.5 / pi_d * 3 * from.y, 1e-4) << instanced;
            }
        }
}

TEST(MirroredLight, CountsTheMirrorAsAVertex)
{
    SceneDescription d = floor_beside_mirror(light_of(LightType::point, {60, 60, 60}, lamp));
    RenderRequest request;
    const auto seen = [&] { return render(d, request).film.at(16, 12).mean().g; };
    const auto parts = [](bool direct, bool indirect) {
        LightParts p;
        p.direct = direct, p.indirect = indirect;
        return p;
    };
    request.settings.integrator = Path{.max_depth = 1};
    EXPECT_EQ(seen(), 0);
    request.settings.integrator = Path{.max_depth = 2};
    EXPECT_GT(seen(), 0);
    request.settings.integrator = Path{.max_depth = 2, .parts = parts(true, false)};
    EXPECT_EQ(seen(), 0) << "it is indirect light";
    request.settings.integrator = Path{.max_depth = 2, .parts = parts(false, true)};
    EXPECT_GT(seen(), 0);
    request.settings.integrator = Path{.max_depth = 2, .direct = {.mirrors = false}};
    EXPECT_EQ(seen(), 0);
}

SceneDescription lit_by(const std::string& lamp_kind)
{
    if (lamp_kind == "ball beside an instance") return with_instanced_mirror(lit_by("ball"));
    if (lamp_kind == "ball") return floor_beside_mirror(light_of(LightType::sphere, {20, 20, 20}, lamp, 0.3), false);
    SceneDescription d = floor_beside_mirror(sky_of({0.3f, 0.3f, 0.4f}), false);
    if (lamp_kind == "sky") return d;
    MaterialDescription glow = make_emitter("glow", {20, 15, 10});
    d.meshes.push_back(make_mesh(make_quad({-0.3, 2, -0.3}, {0.3, 2, -0.3}, {0.3, 2, 0.3}, {-0.3, 2, 0.3}, glow)));
    if (lamp_kind == "quads and sky") {
        d.meshes.push_back(make_mesh(make_quad({1, 3, -0.3}, {1.3, 3, -0.3}, {1.3, 3, 0.3}, {1, 3, 0.3}, glow)));
        return d;
    }
    // Many lights are chosen by a tree.
    for (int i = 0; i < 80; ++i)
        d.lights.push_back(light_of(LightType::sphere, {8, 8, 8}, {-1 + 0.02 * i, 1.5, 0.03 * (i % 9)}, 0.02));
    return d;
}
std::vector<MaterialDescription> floors()
{
    return {make_lambert("floor", {0.5f, 0.5f, 0.5f}),
            make_glossy("floor", MaterialType::plastic, {0.4f, 0.4f, 0.4f}, 0.3f),
            make_glossy("floor", MaterialType::metal, {0.8f, 0.7f, 0.6f}, 0.4f)};
}

// BSDF sampling finds the same light, and so do both, weighed or not.
TEST(MirroredLight, IsWhatBsdfSamplingFinds)
{
    for (const char* kind : {"ball", "ball beside an instance", "quads and sky", "many"})
        for (const MaterialDescription& floor : floors()) {
            SceneDescription d = lit_by(kind);
            d.materials.push_back(floor);
            d.meshes[0].material = "floor";
            d.camera->fov_deg = 40;
            std::vector<TilesOverSeeds> found;
            std::vector<std::string> names;
            const auto add = [&](const std::string& name, const DirectLight& how, uint32_t spp) {
                found.emplace_back(
                    d, Shot{.integrator = Path{.max_depth = 4, .direct = how}, .spp = spp, .seed = found.size() + 1});
                names.push_back(name);
            };
            add("mirrors", {}, 4);
            add("mirrors without mis", {.mis = false}, 4);
            add("without mirrors", {.mirrors = false}, 16);
            add("bsdf sampling", {.nee = false, .mis = false}, 64);
            expect_one_mean(std::move(found), {.pictures = 8, .detectable = 0.03, .names = names},
                            std::string(kind) + " above " + std::string(name_of(floor.type)));
        }
}

TEST(MirroredLight, HasLessNoise)
{
    SceneDescription d = lit_by("ball");
    d.lights[0].radius = 0.05;
    const auto error = [&](bool mirrors) {
        return tally(shoot(d, {.integrator = Path{.max_depth = 2, .direct = {.mirrors = mirrors}},
                               .spp = 256,
                               .sampler = SamplerKind::independent}))
            .error();
    };
    EXPECT_LT(error(true), 0.3 * error(false));
}

// Kernels, accelerators, passes and tiles.
TEST(MirroredLight, HasTheSameBitsHoweverItIsTraced)
{
    for (const char* kind : {"ball", "ball beside an instance", "quads and sky", "many"})
        for (const MaterialDescription& floor : floors()) {
            SceneDescription d = lit_by(kind);
            d.materials.push_back(floor);
            d.meshes[0].material = "floor";
            d.camera->fov_deg = 60;
            RenderRequest request;
            request.spp = {32};
            const Film film = render(d, request).film;
            RenderRequest other = request;
            other.settings.kernel.profile = Profile::all;
            EXPECT_TRUE(same_bits(film, render(d, other).film)) << kind << ", one by one";
            other = request;
            other.tile = 7, other.spp = {16, 16}, other.threads = 2;
            EXPECT_TRUE(same_bits(film, render(d, other).film)) << kind << ", in parts";
            other = request;
            other.settings.accel = AccelKind::bvh8;
            EXPECT_TRUE(same_bits(film, render(d, other).film)) << kind << ", bvh8";
        }
}

// What is small, curved, rough or sees no lamp is not taken for a mirror.
TEST(MirroredLight, IsLookedForInLargeFlatMirrors)
{
    const auto count = [](const SceneDescription& d) { return build_scene(d).mirrors.size(); };
    SceneDescription d = lit_by("ball");
    EXPECT_EQ(count(d), 1u);
    d.materials = {make_glossy("chrome", MaterialType::metal, {1, 1, 1}, 0.0f)};
    d.meshes[1].material = "chrome";
    EXPECT_EQ(count(d), 1u);
    d.materials[0].roughness = 0.2f;
    EXPECT_EQ(count(d), 0u);
    EXPECT_EQ(count(lit_by("sky")), 0u);
    d = lit_by("ball");
    d.meshes[1] = make_mesh(make_quad({2, 0, -0.1}, {2, 0, 0.1}, {2, 0.2, 0.1}, {2, 0.2, -0.1}, mirror()));
    EXPECT_EQ(count(d), 0u);
    // Normals of vertices: those of the face, and others.
    d = lit_by("ball");
    MeshData panel = *d.meshes[1].data;
    panel.normals = {{-1, 0, 0}};
    panel.normal_triangles.assign(panel.triangles.size(), {0, 0, 0});
    d.meshes[1].data = std::make_shared<const MeshData>(panel);
    EXPECT_EQ(count(d), 1u);
    panel.normals = {normalize(Vec3{-1, 0.01f, 0})};
    d.meshes[1].data = std::make_shared<const MeshData>(panel);
    EXPECT_EQ(count(d), 0u);
    d = lit_by("ball");
    d.meshes.push_back(make_mesh(make_cube(mirror()), {{-4, 2, 0}, {20, 30, 40}, {1, 1, 1}}));
    EXPECT_EQ(count(d), 4u);
    // Each instance is looked at as it is placed.
    d = lit_by("ball beside an instance");
    EXPECT_EQ(count(d), 1u);
    d.instances.push_back(instance_of("square", {{-6, 3, 0}, {0, 70, 10}, {3, 3, 2}}));
    EXPECT_EQ(count(d), 2u);
    d.instances.erase(d.instances.begin() + 1, d.instances.end());
    EXPECT_EQ(count(d), 0u);
}

}  // namespace
}  // namespace lancer
