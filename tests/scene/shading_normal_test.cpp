// Bump and normal maps on every shape, the side that geometry decides, and the terminator fix.
#include "scene/shading_normal.h"

#include <gtest/gtest.h>

#include "core/frame.h"
#include "support/random.h"
#include "support/shoot.h"
#include "support/stage.h"

namespace lancer {
namespace {

void expect_near(Vec3 a, Vec3 b, float tolerance, const std::string& what = {})
{
    EXPECT_LT(length(a - b), tolerance) << what << ": " << a.x << ' ' << a.y << ' ' << a.z << " against " << b.x << ' '
                                        << b.y << ' ' << b.z;
}

MaterialDescription lambert_with_normals(const char* picture)
{
    MaterialDescription m = make_lambert("tile", {1, 1, 1});
    m.normal_map = picture_of(picture, Encoding::linear);
    return m;
}

Vec3 shading_normal(const SceneDescription& d, Vec3d from, Vec3d to)
{
    const Stage stage(d);
    const Vec3 org = stage.to_scene(from);
    const auto s = stage.look(org, stage.to_scene(to) - org);
    EXPECT_TRUE(s.has_value());
    return s ? s->ns : Vec3{};
}

// Texture directions along x and y on a quad that faces +z.
SceneDescription facing_quad(MaterialDescription m, Vec2 uv = {1, 1})
{
    SceneDescription d;
    d.meshes.push_back(make_mesh(make_mapped_quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, uv, std::move(m))));
    return d;
}

// Along u of the texture coordinates, seen from either side; only where a material asks for it.
TEST(Tangent, IsAlongU)
{
    MaterialDescription brushed = default_description(MaterialType::principled);
    brushed.name = "brushed", brushed.metallic = 1.0f;
    for (const float anisotropy : {0.0f, 0.5f})
        for (const Vec2 uv : {Vec2{1, 1}, Vec2{-2, 3}})
            for (const double side : {3.0, -3.0}) {
                brushed.anisotropy = anisotropy;
                const Stage stage(facing_quad(brushed, uv));
                const Vec3 org = stage.to_scene({0.3, 0.2, side});
                const auto s = stage.look(org, stage.to_scene({0.3, 0.2, 0}) - org);
                ASSERT_TRUE(s);
                if (anisotropy == 0) {
                    EXPECT_EQ(s->tangent, (Vec2{1, 0}));
                    continue;
                }
                const Vec3 along = Frame(s->ns).to_world({s->tangent.x, s->tangent.y, 0});
                expect_near(along, {uv.x < 0 ? -1.0f : 1.0f, 0, 0}, 1e-5f);
            }
}

TEST(NormalMap, FlatOneLeavesTheNormal)
{
    const SceneDescription d = facing_quad(lambert_with_normals("flat normals"));
    expect_near(shading_normal(d, {0.3, 0.2, 3}, {0.3, 0.2, 0}), {0, 0, 1}, 0.01f);
}

TEST(NormalMap, TiltsAlongTheTextureOnEveryShape)
{
    const MaterialDescription m = lambert_with_normals("tilted normals");
    const Vec3 tilted = normalize(Vec3{-1, 0.5f, 1});
    expect_near(shading_normal(facing_quad(m), {0.3, 0.2, 3}, {0.3, 0.2, 0}), tilted, 0.02f, "quad");
    // A texture that is mirrored turns its own x round, and nothing else.
    expect_near(shading_normal(facing_quad(m, {-1, 1}), {0.3, 0.2, 3}, {0.3, 0.2, 0}), normalize(Vec3{1, 0.5f, 1}),
                0.02f, "mirrored texture");
    expect_near(shading_normal(facing_quad(m, {3, 7}), {0.3, 0.2, 3}, {0.3, 0.2, 0}), tilted, 0.02f, "repeated");

    SceneDescription instanced = facing_quad(m);
    instanced.meshes[0].name = "tile";
    instanced.instances.push_back(instance_of("tile", {{0, 0, 0}, {0, 90, 0}, {2, 2, 2}}));
    // Turned about y: x goes to -z, z to x.
    expect_near(shading_normal(instanced, {3, 0.2, 0.3}, {0, 0.2, 0.3}), normalize(Vec3{1, 0.5f, 1}), 0.02f,
                "instance");
    instanced.instances[0].transform = {{0, 0, 0}, {0, 0, 0}, {-1, 1, 1}};
    expect_near(shading_normal(instanced, {0.3, 0.2, 3}, {0.3, 0.2, 0}), normalize(Vec3{1, 0.5f, 1}), 0.02f,
                "mirrored instance");

    SceneDescription round;
    round.materials = {m};
    round.spheres.push_back(sphere_of({0, 0, 0}, 1, "tile"));
    expect_near(shading_normal(round, {0, 0, 3}, {0, 0, 0}), tilted, 0.02f, "sphere from +z");
    expect_near(shading_normal(round, {3, 0, 0}, {0, 0, 0}), normalize(Vec3{1, 0.5f, 1}), 0.02f, "sphere from +x");

    SceneDescription flat;
    flat.materials = {m};
    flat.planes.push_back(plane_of({0, 0, 0}, {0, 0, 1}, "tile"));
    expect_near(shading_normal(flat, {0.3, 0.2, 3}, {0.3, 0.2, 0}), tilted, 0.02f, "wall");
    flat.planes[0].normal = {0, 1, 0};
    // On a floor u is x and v is -z.
    expect_near(shading_normal(flat, {0.3, 3, 0.2}, {0.3, 0, 0.2}), normalize(Vec3{-1, 1, -0.5f}), 0.02f, "floor");
}

TEST(NormalMap, FromTheBackTheSameBumpIsADent)
{
    const SceneDescription d = facing_quad(lambert_with_normals("tilted normals"));
    expect_near(shading_normal(d, {0.3, 0.2, -3}, {0.3, 0.2, 0}), -normalize(Vec3{-1, 0.5f, 1}), 0.02f);
}

// Heights that rise by one 255th a texel give this slope whatever the size of quad and picture.
TEST(BumpMap, SlopeIsPerTexel)
{
    for (const float scale : {0.0f, 51.0f, 255.0f, -255.0f})
        for (const double size : {1e-3, 1.0, 1e3}) {
            MaterialDescription m = make_lambert("ramp", {1, 1, 1});
            m.bump_map = heights_of("ramp");
            m.bump_scale = scale;
            SceneDescription d = facing_quad(m);
            d.meshes[0].transform.scale = {size, size, size};
            expect_near(shading_normal(d, {0.3 * size, 0.2 * size, 3 * size}, {0.3 * size, 0.2 * size, 0}),
                        normalize(Vec3{-scale / 255, 0, 1}), 0.01f, std::to_string(scale));
        }
}

TEST(ShadingNormal, MirrorImageStaysOutside)
{
    Random random(5);
    uint32_t bent = 0;
    for (int i = 0; i < 100000; ++i) {
        const Vec3 n{0, 0, 1};
        Vec3 ns = random.unit_vector(), wo = random.unit_vector();
        wo.z = std::abs(wo.z);
        ns.z = std::abs(ns.z);
        if (dot(ns, wo) < 0 || wo.z == 0) continue;
        const Vec3 kept = keep_reflection_outside(n, ns, wo);
        const float before = 2 * dot(ns, wo) * ns.z - wo.z, after = 2 * dot(kept, wo) * kept.z - wo.z;
        const float least = std::min(0.9f * wo.z, 0.01f);
        ASSERT_GT(after, least - 1e-5f);
        ASSERT_GT(dot(kept, wo), 0);
        if (before >= least) {
            ASSERT_EQ(kept, ns);
        } else {
            ++bent;
        }
    }
    EXPECT_GT(bent, 1000u);
}

// What a steep bump map mirrors is never black: in a furnace the mirror is not seen at all.
TEST(ShadingNormal, NoBlackSpecklesOnABumpedMirror)
{
    SceneDescription d;
    MaterialDescription m{.name = "ball", .where = {}, .type = MaterialType::mirror, .base_color = {1, 1, 1}};
    m.bump_map = heights_of("waves");
    m.bump_scale = 60;
    d.materials = {m};
    d.spheres.push_back(sphere_of({0, 0, 0}, 1, "ball"));
    d.lights.push_back(sky_of({1, 1, 1}));
    d.camera = make_camera({0, 0, 4}, {0, 0, 0}, 35);
    expect_all_equal(shoot(d, {}), {1, 1, 1}, 1e-4f, "sphere");

    // The same of normals that are only interpolated, over triangles coarse enough to miss the silhouette.
    SceneDescription coarse;
    MeshData ball =
        *make_uv_sphere(6, 8, 0, {.name = "ball", .where = {}, .type = MaterialType::mirror, .base_color = {1, 1, 1}});
    for (const Vec3d& p : ball.positions) ball.normals.push_back(to_float(p));
    ball.normal_triangles = ball.triangles;
    coarse.meshes.push_back(make_mesh(std::make_shared<const MeshData>(ball)));
    coarse.lights = d.lights;
    coarse.camera = d.camera;
    expect_all_equal(shoot(coarse, {}), {1, 1, 1}, 1e-4f, "mesh");
}

// A wall between the eye and the only light, as bumpy as can be: nothing comes through.
TEST(ShadingNormal, NothingLeaksThroughAWall)
{
    for (const MaterialType type :
         {MaterialType::lambert, MaterialType::mirror, MaterialType::metal, MaterialType::plastic})
        for (const DirectLight how : {DirectLight{true, true}, DirectLight{false, false}}) {
            MaterialDescription m = make_lambert("wall", {1, 1, 1});
            m.type = type;
            m.roughness = 0.5f;
            m.bump_map = heights_of("waves");
            m.bump_scale = 60;
            SceneDescription d = facing_quad(m);
            d.lights.push_back(light_of(LightType::sphere, {50, 50, 50}, {0.3, 0, -2}, 1));
            d.camera = make_camera({0, 0, 2}, {0, 0, 0}, 40);
            const Film film = shoot(d, {.integrator = Path{.direct = how}});
            for (const Pixel& p : film.pixels) ASSERT_EQ(p.mean(), Color{});
        }
}

// Light on a coarse sphere with the normals of a round one, against the round one: the band where the light just
// grazes. The fix takes away at least half of the error; without it nothing changes by a bit.
TEST(TerminatorFix, HalvesTheErrorWhereLightGrazes)
{
    SceneDescription round;
    round.materials = {make_lambert("ball", {1, 1, 1})};
    round.spheres.push_back(sphere_of({0, 0, 0}, 1, "ball"));
    round.lights.push_back(light_of(LightType::point, {1000, 1000, 1000}, {20, 0, 4}));
    round.camera = make_camera({0, 0, 6}, {0, 0, 0}, 24);
    SceneDescription coarse = round;
    coarse.spheres.clear();
    coarse.materials.clear();
    MeshData ball = *make_uv_sphere(16, 8, 0, make_lambert("ball", {1, 1, 1}));
    for (const Vec3d& p : ball.positions) ball.normals.push_back(to_float(p));
    ball.normal_triangles = ball.triangles;
    coarse.meshes.push_back(make_mesh(std::make_shared<const MeshData>(ball)));
    SceneDescription fixed = coarse;
    fixed.render.terminator = true;

    const Shot shot{.integrator = Path{.max_depth = 1}, .width = 96, .height = 96, .spp = 4};
    const Film truth = shoot(round, shot), without = shoot(coarse, shot), with = shoot(fixed, shot);
    const Stage stage(round);
    const Camera camera = camera_of(round, stage.scene, shot.width, shot.height);
    const Vec3 light = normalize(Vec3{20, 0, 4});
    double before = 0, after = 0;
    uint32_t pixels = 0;
    for (uint32_t y = 0; y < shot.height; ++y)
        for (uint32_t x = 0; x < shot.width; ++x) {
            const Ray ray = camera.ray({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f}, {});
            const Hit hit = stage.list.closest(ray);
            if (!hit) continue;
            const float c = dot(surface_at(stage.scene, ray, hit).n, light);
            if (c < 0 || c > 0.2f) continue;
            const auto error = [&](const Film& film) {
                return std::abs(static_cast<double>(film.at(x, y).mean().g) -
                                static_cast<double>(truth.at(x, y).mean().g));
            };
            before += error(without);
            after += error(with);
            ++pixels;
        }
    ASSERT_GT(pixels, 100u);
    EXPECT_LT(after, 0.5 * before) << "mean error " << before / pixels << " becomes " << after / pixels;
}

}  // namespace
}  // namespace lancer
