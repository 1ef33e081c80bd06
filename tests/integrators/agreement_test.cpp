// Different ways to estimate the same thing agree: light sampling, BSDF sampling and both weighted, either sampler,
// with and without roulette.
#include <gtest/gtest.h>

#include "support/shoot.h"

namespace lancer {
namespace {

// Light sampling also where it is in vain, beside the ways that there always are.
constexpr DirectLight always{.always = true};

void expect_all_ways_agree(const SceneDescription& d, const std::string& scene, uint32_t spp,
                           std::vector<DirectLight> ways = {{true, true}, {true, false}, {false, false}})
{
    std::vector<TilesOverSeeds> all;
    std::vector<std::string> names;
    uint64_t seed = 0;
    for (const SamplerKind sampler : {SamplerKind::sobol, SamplerKind::independent})
        for (const DirectLight how : ways) {
            Shot shot{.integrator = Path{.max_depth = 6, .roulette_depth = 3, .direct = how},
                      .spp = how.nee ? spp : 2 * spp,
                      .sampler = sampler};
            shot.seed = ++seed;
            all.emplace_back(d, shot);
            names.push_back(std::string(!how.nee     ? "bsdf"
                                        : how.always ? "nee always"
                                        : how.mis    ? "nee and mis"
                                                     : "nee") +
                            (sampler == SamplerKind::sobol ? ", sobol" : ", independent"));
        }
    // With roulette the paths of more than six vertices are the same too.
    Shot never{.integrator = without_roulette({.max_depth = 6}), .spp = spp};
    never.seed = ++seed;
    all.emplace_back(d, never);
    names.emplace_back("no roulette");
    expect_one_mean(std::move(all), {.pictures = 16, .names = names}, scene);

    // The accelerator only says what is hit: the same bits.
    Shot few{.width = 24, .height = 16, .spp = 2};
    const Film embree = shoot(d, few);
    few.accel = AccelKind::list;
    EXPECT_TRUE(same_bits(embree, shoot(d, few))) << scene << ": embree and list";
}

TEST(Agreement, Cornell) { expect_all_ways_agree(cornell_scene(), "cornell", 16); }

// Diffuse surfaces under a sky of one colour: nothing asks for it.
SceneDescription open_scene()
{
    SceneDescription d = lights_scene();
    d.meshes.pop_back();  // the panel
    d.lights = {sky_of({0.5f, 0.7f, 0.9f})};
    return d;
}

TEST(Agreement, ConstantSky)
{
    expect_all_ways_agree(open_scene(), "constant sky", 16, {{true, true}, always, {false, false}});
}

TEST(Agreement, NoShadowRaysUnderAConstantSky)
{
    RenderRequest r;
    r.width = r.height = 16, r.spp = {4};
    const auto shadow_rays = [&](const SceneDescription& d, const Path& path) {
        r.settings.integrator = path;
        return render(d, r).counters.shadow_rays;
    };
    EXPECT_EQ(shadow_rays(open_scene(), {}), 0u);
    EXPECT_GT(shadow_rays(open_scene(), {.direct = always}), 0u);
    // Another light, another density, another BSDF: then there is something to find.
    SceneDescription d = open_scene();
    d.lights.push_back(light_of(LightType::point, {1, 1, 1}, {0, 3, 0}));
    EXPECT_GT(shadow_rays(d, {}), 0u);
    d = open_scene();
    d.lights = {sky_map_of({1, 1, 1})};
    r.images = test_picture;
    EXPECT_GT(shadow_rays(d, {}), 0u);
    d = open_scene();
    d.meshes[0] = make_mesh(make_quad({-2, -0.8, 2}, {2, -0.8, 2}, {2, -0.8, -2}, {-2, -0.8, -2},
                                      make_glossy("coat", MaterialType::plastic, {0.3f, 0.3f, 0.8f}, 0.3f)));
    EXPECT_GT(shadow_rays(d, {}), 0u);
}

TEST(Agreement, SpheresOfGlassAndMirror) { expect_all_ways_agree(spheres_scene(), "spheres", 16); }

TEST(Agreement, SkyPanelAndSphereLight)
{
    SceneDescription d = lights_scene();
    std::erase_if(d.lights, [](const auto& l) { return l.type == LightType::point; });  // no BSDF finds a point
    d.meshes[1].data = make_uv_sphere(10, 20, 0.08, make_lambert("bumpy", {0.3f, 0.5f, 0.7f}));
    // Larger, so that the BSDF alone finds them often enough for a normal distribution of means.
    for (auto& l : d.lights) l.radius = 0.8;
    d.meshes[2].transform = {{-1.2, -0.4, 0}, {}, {2, 2, 2}};
    expect_all_ways_agree(d, "lights", 8);
}

TEST(Agreement, InstancedEmitters)
{
    SceneDescription d = instances_scene();
    d.planes.clear();
    d.meshes.push_back(make_mesh(make_quad({-2, -0.6, 2}, {2, -0.6, 2}, {2, -0.6, -2}, {-2, -0.6, -2})));
    d.instances.back().transform.scale = {1.2, 1, 1};
    d.instances.push_back(instance_of("lamp", {{-2, 0.7, 0}, {0, 0, -60}, {-0.8, 1, 1.2}}));
    d.camera = make_camera({0, 1.5, 3}, {0, -0.3, 0}, 40);
    expect_all_ways_agree(d, "instances", 8);
}

TEST(Agreement, CutOutsAndGauze) { expect_all_ways_agree(holes_scene(), "holes", 8); }

// An emitting mesh that reflects, in a corner of an emitting sphere's inside: light sampling from emitters to
// themselves.
TEST(Agreement, EmittersLightEachOther)
{
    SceneDescription d;
    MaterialDescription dome = make_lambert("dome", {0.6f, 0.5f, 0.4f});
    dome.emission = {0.2f, 0.2f, 0.3f};
    dome.emission_both_sides = true;
    MaterialDescription glow = make_lambert("glow", {0.7f, 0.7f, 0.7f});
    glow.emission = {1, 0.5f, 0.2f};
    d.materials = {dome, glow};
    d.spheres.push_back(sphere_of({0, 0, 0}, 2, "dome"));
    d.spheres.push_back(sphere_of({0.5, -0.4, -0.3}, 0.4, "glow"));
    d.meshes.push_back(make_mesh(make_cube(glow), {{-0.5, -0.3, -0.2}, {10, 20, 30}, {0.3, 0.4, 0.3}}));
    d.camera = make_camera({0, 0.2, 1.6}, {0, -0.2, -0.3}, 60);
    expect_all_ways_agree(d, "emitters", 8);
}

// Normals that are not those of the faces, coarse enough to differ much: what is sampled about the one and seen from
// the other.
TEST(Agreement, ShadingNormals)
{
    SceneDescription d;
    MeshData smooth = *make_uv_sphere(5, 8, 0, make_lambert("smooth", {0.8f, 0.6f, 0.5f}));
    for (const Vec3d& p : smooth.positions) smooth.normals.push_back(to_float(normalize(p + Vec3d{0, 0.4, 0})));
    smooth.normal_triangles = smooth.triangles;
    d.meshes.push_back(make_mesh(std::make_shared<const MeshData>(smooth)));
    d.meshes.push_back(make_mesh(make_quad({-3, -1, 3}, {3, -1, 3}, {3, -1, -3}, {-3, -1, -3})));
    // An open sheet: nothing behind it stops light that its normals alone would let in from below.
    MeshData sheet = *make_quad({-1.9, -0.5, 1}, {-0.9, -0.5, 1.5}, {-0.9, 0.9, 1.5}, {-1.9, 0.9, 1});
    sheet.normals = {normalize(Vec3{1, 0.3f, 0.3f}), normalize(Vec3{-1, 0.3f, 0.3f})};
    sheet.normal_triangles = {{0, 0, 1}, {0, 1, 1}};
    d.meshes.push_back(make_mesh(std::make_shared<const MeshData>(sheet)));
    d.lights = {sky_of({0.5f, 0.6f, 0.8f}), light_of(LightType::sphere, {3, 3, 2}, {2, 2, 1}, 0.9)};
    d.camera = make_camera({0.5, 0.8, 3.5}, {0, -0.1, 0}, 42);
    expect_all_ways_agree(d, "shading normals", 8);
}

TEST(Agreement, RouletteFromTheFirstVertexAndNever)
{
    const SceneDescription d = spheres_scene();
    Path first = without_roulette({.max_depth = 40});
    first.roulette_depth = 1;
    const Path never = without_roulette({.max_depth = 40});
    expect_one_mean(
        {{d, {.integrator = first, .spp = 16, .seed = 1}}, {d, {.integrator = never, .spp = 16, .seed = no_roulette}}},
        {.pictures = 24, .names = {"from the first", "never"}}, "spheres");
}

// A pane of index 1 before the camera: other random numbers, the same picture.
TEST(Agreement, PaneOfIndexOne)
{
    const SceneDescription bare = cornell_scene();
    SceneDescription pane = bare;
    MaterialDescription nothing = make_lambert("nothing", {1, 1, 1});
    nothing.type = MaterialType::glass;
    nothing.ior = 1;
    pane.meshes.push_back(make_mesh(make_cube(nothing), {{0, 0, 2}, {0, 0, 0}, {2, 2, 0.1}}));
    // The pane takes two of the vertices on the way in; light that leaves the box through it would need two more, but
    // there is nothing outside to come back from.
    expect_one_mean({{bare, {.integrator = Path{.max_depth = 2}, .spp = 16}},
                     {pane, {.integrator = Path{.max_depth = 4}, .spp = 16, .seed = 1}}},
                    {.pictures = 16, .names = {"bare", "pane"}}, "cornell");
}

// On diffuse surfaces direct light is the path tracer of one vertex, to the bit.
TEST(Agreement, DirectIsPathOfOneVertex)
{
    for (const auto& [name, d] : all_test_scenes()) {
        // Mirror, glass and smooth coats: direct light follows them.
        if (std::string(name) == "spheres" || std::string(name) == "textured" || std::string(name) == "glossy" ||
            std::string(name) == "media" || std::string(name) == "scattering" || std::string(name) == "fog" ||
            std::string(name) == "shapes")
            continue;
        for (const DirectLight how : {DirectLight{true, true}, DirectLight{true, false}, DirectLight{false, false}}) {
            Path path{.max_depth = 1, .direct = how};
            path.split = path.roulette_by_pixel = path.learned_nee = false;
            EXPECT_TRUE(same_bits(shoot(d, {.integrator = Direct{.direct = how}}), shoot(d, {.integrator = path})))
                << name;
        }
    }
}

}  // namespace
}  // namespace lancer
