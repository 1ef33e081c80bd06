// The classic integrators find the light that the others find, as far as they look for it; and random decisions have
// the mean of the whole tree, material by material, depth by depth.
#include <gtest/gtest.h>

#include "support/scenes/classic.h"

namespace lancer {
namespace {

void expect_direct_light(const SceneDescription& d, const std::string& name)
{
    std::vector<TilesOverSeeds> ways;
    Shot shot{.integrator = Direct{.max_depth = 20}, .width = 32, .height = 24, .spp = 16, .seed = 1};
    ways.emplace_back(d, shot);
    shot.integrator = of_depth<Whitted>(20), shot.seed = 2;
    ways.emplace_back(d, shot);
    shot.integrator = of_depth<RandomDecision>(20), shot.seed = 3;
    ways.emplace_back(d, shot);
    expect_one_mean(std::move(ways), {.pictures = 12, .detectable = 0.05, .rounding = 1e-5}, name);
}

TEST(Classic, FindsTheDirectLightOfDiffuseSurfaces)
{
    expect_direct_light(cornell_scene(), "cornell");
    expect_direct_light(lights_scene(), "lights");
    expect_direct_light(instances_scene(), "instances");
}

// Of a ball that shines on both sides the far one is found through holes in the near by rays alone.
TEST(Classic, FindsItThroughHoles)
{
    SceneDescription d = holes_scene();
    for (MaterialDescription& m : d.materials) m.emission_both_sides = false;
    expect_direct_light(d, "holes");
}

// Glass only where no lamp shines through it: there the shadow rays of Direct end, and the tinted ones do not.
TEST(Classic, FindsItByMirrorsAndThroughGlass)
{
    SceneDescription spheres = spheres_scene();
    spheres.spheres[1].material = "red";
    expect_direct_light(spheres, "mirror");
    SceneDescription cornell = cornell_scene();
    MaterialDescription glass = make_lambert("glass", {0.9f, 1, 0.95f});
    glass.type = MaterialType::glass;
    MaterialDescription mirror = make_lambert("mirror", {0.9f, 0.9f, 0.9f});
    mirror.type = MaterialType::mirror;
    cornell.materials = {glass, mirror};
    cornell.spheres = {sphere_of({0.2, 0.1, 1.8}, 0.4, "glass"), sphere_of({-0.3, 0.45, -0.2}, 0.25, "mirror")};
    expect_direct_light(cornell, "glass");
}

// The sky in narrow highlights: found by directions of the sky and by those of the surface.
TEST(Classic, FindsTheSkyInHighlights)
{
    SceneDescription d;
    for (CourseMaterial m : course_materials()) {
        if (m.name != "bronze" && m.name != "steel" && m.name != "grey_metallic") continue;
        m.phong.ambient = {};
        d.spheres.push_back(sphere_of({1.2 * (static_cast<double>(d.spheres.size()) - 1), 0, 0}, 0.55, m.name));
        d.materials.push_back(make_interface(m.name, m.phong));
    }
    ASSERT_EQ(d.spheres.size(), 3u);
    d.background.emplace();
    d.background->sky = SkyType::gradient;
    d.lights.push_back(light_of(LightType::sphere, {9, 9, 8}, {-0.5, 2.5, 1.5}, 0.4));
    d.camera = make_camera({0, 0.3, 4}, {0, 0, 0}, 40);
    expect_direct_light(d, "highlights");
}

// Points of light are asked each for itself: no choice, no noise.
TEST(Whitted, OfPointsOfLightHasNoNoise)
{
    SceneDescription d = cornell_scene();
    d.meshes.erase(d.meshes.begin() + 5);
    for (const double x : {-0.5, 0.1, 0.6}) d.lights.push_back(light_of(LightType::point, {1, 2, 3}, {x, 0.7, 0.4}));
    d.lights.push_back(directional_of({0.2f, 0.3f, 0.1f}, {0.1, -0.2, -1}));
    d.camera->fov_deg = 1e-4;
    for (const Vec3d target : {Vec3d{0, -0.9, 0.9}, Vec3d{-0.3, 0.2, 0}}) {
        d.camera->target = target;
        const Film film = shoot(d, {.integrator = Whitted{}, .width = 2, .height = 2, .spp = 64});
        const stats::Tally whitted = tally(film);
        EXPECT_LT(std::sqrt(whitted.variance()), 1e-3 * whitted.mean);
        const Film direct = shoot(
            d, {.integrator = Direct{}, .width = 4, .height = 4, .spp = 4096, .sampler = SamplerKind::independent});
        EXPECT_GT(stats::mean_p(tally(direct), whitted.mean, 1e-4), claim_level);
    }
}

TEST(Whitted, FollowsTwoMirrorsFacingEachOther)
{
    const Color tint{1, 0.999f, 0.9f};
    SceneDescription d;
    MaterialDescription mirror = make_lambert("mirror", tint);
    mirror.type = MaterialType::mirror;
    d.meshes.push_back(make_mesh(make_quad({-1, -5, -5}, {-1, 5, -5}, {-1, 5, 5}, {-1, -5, 5}, mirror)));
    d.meshes.push_back(make_mesh(make_quad({1, -5, 5}, {1, 5, 5}, {1, 5, -5}, {1, -5, -5}, mirror)));
    d.lights.push_back(sky_of({2, 2, 2}));
    d.camera = make_camera({0, 0, 0}, {1, 0.01, 0}, 1e-4);  // heights 0.01, 0.03, ... 4.99: 250 of them
    const auto seen = [](float t) { return 2 * std::pow(t, 250.0f); };
    Shot shot{.integrator = of_depth<Whitted>(250), .width = 2, .height = 2};
    expect_all_equal(shoot(d, shot), {seen(tint.r), seen(tint.g), seen(tint.b)}, gamma(500), "250 mirrors");
    shot.integrator = of_depth<Whitted>(249);
    expect_all_equal(shoot(d, shot), {0, 0, 0}, 0, "one vertex too few");
    d.render.legacy = true;
    Whitted course = of_depth<Whitted>(251);
    course.legacy = true;
    shot.integrator = course;
    expect_all_equal(shoot(d, shot), {seen(tint.r), seen(tint.g), seen(tint.b)}, gamma(500), "the course");
    course.max_depth = 250;
    shot.integrator = course;
    expect_all_equal(shoot(d, shot), {0, 0, 0}, 0, "the course sends no ray on from the last vertex");
}

// A sky behind so many dark panes that little is left of it. Half of what meets a pane is reflected, into the dark.
SceneDescription behind_panes(int panes)
{
    SceneDescription d;
    d.materials = {make_interface("pane", {.diffuse = {0.3f, 0.3f, 0.3f},
                                           .diffusion = 0,
                                           .reflexion = 0.5f,
                                           .refraction = 0.5f,
                                           .inside_ior = 1,
                                           .outside_ior = 1})};
    for (int i = 0; i < panes; ++i) d.planes.push_back(plane_of({0, 0, -1.0 * i}, {0, 0, 1}, "pane"));
    d.lights.push_back(sky_of({1, 1, 1}));
    d.camera = make_camera({0, 0, 3}, {0, 0, 0}, 20);
    return d;
}

// By roulette, for most of them end.
TEST(Whitted, KeepsTheMeanOfFaintBranches)
{
    const double expected = std::pow(0.3, 6);
    ASSERT_LT(expected, 0.003);
    const Shot shot{
        .integrator = Whitted{}, .width = 16, .height = 16, .spp = 256, .sampler = SamplerKind::independent};
    const stats::Tally t = tally(shoot(behind_panes(6), shot));
    EXPECT_LT(t.error(), 0.02 * expected);
    EXPECT_GT(stats::mean_p(t, expected, 1e-5), claim_level);
}

// And so must the one who takes but one of the ways, although nothing of its light is lost on it.
TEST(CourseTree, DropsFaintBranches)
{
    for (const int panes : {2, 4}) {
        const float part = std::pow(0.15f, static_cast<float>(panes)), expected = part < 0.003f ? 0 : part;
        const Film tree = shoot_classic(behind_panes(panes), Whitted{}, true, {.width = 2, .height = 2});
        expect_all_equal(tree, {expected, expected, expected}, 1e-5f, "tree");
        const Film walk = shoot_classic(behind_panes(panes), RandomDecision{}, true,
                                        {.width = 8, .height = 8, .spp = 256, .sampler = SamplerKind::independent});
        EXPECT_GT(stats::mean_p(tally(walk), static_cast<double>(expected)), claim_level) << panes;
    }
}

// Each of the thirteen materials as a ball in a tile of its own, among the others.
SceneDescription gallery()
{
    SceneDescription d;
    d.materials = {make_lambert("floor", {0.4f, 0.5f, 0.6f})};
    const std::vector<CourseMaterial> all = course_materials();
    for (uint32_t i = 0; i < all.size(); ++i) {
        d.materials.push_back(make_interface(all[i].name, all[i].phong));
        d.spheres.push_back(sphere_of({i % 4 - 1.5, 1.5 - i / 4, 0}, 0.45, all[i].name));
    }
    d.spheres.push_back(sphere_of({0.5, -1.5, 0}, 0.25, "mirror"));  // in the tile beside the last
    d.planes.push_back(plane_of({0, 0, -0.6}, {0, 0, 1}, "floor"));
    d.lights = {light_of(LightType::point, {5, 5, 5}, {-1, 1, 3}), directional_of({0.5f, 0.4f, 0.3f}, {-1, 1, -2}),
                sky_of({0.3f, 0.4f, 0.5f})};
    d.camera = make_camera({0, 0, 10}, {0, 0, 0}, 2 * std::atan(0.2) * 180 / pi_d);
    return d;
}

class OfDepth : public testing::TestWithParam<std::tuple<uint32_t, bool>> {};
INSTANTIATE_TEST_SUITE_P(Every, OfDepth, testing::Combine(testing::Range(1u, 8u), testing::Bool()), [](const auto& p) {
    return std::to_string(std::get<0>(p.param)) + (std::get<1>(p.param) ? "_course" : "");
});

TEST_P(OfDepth, RandomDecisionHasTheMeanOfTheTree)
{
    const auto [depth, legacy] = GetParam();
    SceneDescription d = gallery();
    d.render.legacy = legacy;
    Whitted tree = of_depth<Whitted>(depth);
    RandomDecision walk = of_depth<RandomDecision>(depth);
    tree.legacy = walk.legacy = legacy;
    std::vector<TilesOverSeeds> ways;
    ways.emplace_back(d, Shot{.integrator = tree, .spp = 2, .seed = 1});
    ways.emplace_back(d, Shot{.integrator = walk, .spp = 16, .seed = 2});
    expect_one_mean(std::move(ways), {.pictures = 12, .detectable = 0.02, .rounding = 1e-5},
                    "depth " + std::to_string(depth) + (legacy ? ", the course" : ""));
}

}  // namespace
}  // namespace lancer
