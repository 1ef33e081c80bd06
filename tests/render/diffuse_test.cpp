// Scenes that are plain enough are traced eight paths at a time; who asks for AOVs gets the loop that there is for all.
// Both have the same bits, whatever is asked of the path tracer.
#include <gtest/gtest.h>

#include "scene/diffuse_scene.h"
#include "support/render.h"
#include "support/shoot.h"

namespace lancer {
namespace {

// Smooth normals, coarse enough to face away from rays, over a floor.
SceneDescription smooth_scene()
{
    SceneDescription d = lights_scene();
    MeshData smooth = *make_uv_sphere(5, 8, 0.08, make_lambert("smooth", {0.8f, 0.6f, 0.5f}));
    for (const Vec3d& p : smooth.positions) smooth.normals.push_back(to_float(normalize(p + Vec3d{0, 0.4, 0})));
    smooth.normal_triangles = smooth.triangles;
    d.meshes[1].data = std::make_shared<const MeshData>(std::move(smooth));
    d.lights.clear();
    return d;
}
SceneDescription sky_scene()
{
    SceneDescription d = smooth_scene();
    d.meshes.pop_back();  // the panel
    d.lights = {sky_of({0.5f, 0.7f, 0.9f})};
    return d;
}
// More lamps than are chosen by one number, and one of them hardly shines. From 33 on a tree chooses.
SceneDescription many_lamps(int count)
{
    SceneDescription d = smooth_scene();
    d.meshes.pop_back();
    for (int i = 0; i < count; ++i) {
        const double x = -1.9 + 4.0 / count * i;
        const float power = i == 7 ? 1e-5f : 2 + 0.1f * static_cast<float>(i);
        d.meshes.push_back(
            make_mesh(make_quad({x, 1.2, -0.3}, {x + 0.05, 1.2, -0.3}, {x + 0.05, 1.2, 0.3}, {x, 1.2, 0.3},
                                make_emitter("lamp" + std::to_string(i), {power, 2, 1}))));
    }
    return d;
}

// What is looked up at places: a picture, heights, a map of normals, colours of vertices, holes - the lamp has some,
// too - and what of it one place has besides another.
SceneDescription looked_up_scene()
{
    SceneDescription d = smooth_scene();
    MaterialDescription wall = make_lambert("wall", {0.8f, 0.8f, 0.8f});
    wall.base_color_map = picture_of("colours", Encoding::srgb);
    wall.bump_map = heights_of("waves");
    wall.bump_scale = 4;
    d.meshes[0] = make_mesh(make_mapped_quad({-2, -0.8, 2}, {2, -0.8, 2}, {2, -0.8, -2}, {-2, -0.8, -2}, {4, 3}, wall));
    MeshData coloured = *d.meshes[1].data;
    for (size_t i = 0; i < coloured.positions.size(); ++i)
        coloured.colors.push_back({0.3f, 0.02f * static_cast<float>(i % 40), 0.9f});
    d.meshes[1].data = std::make_shared<const MeshData>(std::move(coloured));
    MaterialDescription tile = make_gauze("tile", {0.9f, 0.8f, 0.7f}, 0.8f, 5);
    tile.normal_map = picture_of("tilted normals", Encoding::linear);
    d.meshes.push_back(make_mesh(
        make_mapped_quad({-0.5, -0.6, 0.9}, {0.6, -0.6, 0.8}, {0.6, 0.3, 0.8}, {-0.5, 0.3, 0.9}, {1, 1}, tile)));
    return d;
}
SceneDescription looked_up_under_sky()
{
    SceneDescription d = looked_up_scene();
    d.meshes.erase(d.meshes.begin() + 2);
    d.lights = {sky_of({0.5f, 0.7f, 0.9f})};
    return d;
}

struct Case {
    const char* name;
    SceneDescription scene;
};
std::vector<Case> cases()
{
    return {{"smooth", smooth_scene()},      {"sky", sky_scene()},
            {"lamps", many_lamps(20)},       {"tree", many_lamps(50)},
            {"textures", looked_up_scene()}, {"textures, sky", looked_up_under_sky()}};
}

TEST(Diffuse, HasATreeAndEveryFeatureAmongItsCases)
{
    EXPECT_TRUE(build_scene(cases()[3].scene).lights.tree);
    EXPECT_FALSE(build_scene(cases()[2].scene).lights.tree);
    Features all;
    for (const Case& c : cases()) all = all | features_of(build_scene(c.scene));
    EXPECT_TRUE(all.covers(DiffuseScene::features | DiffuseScene::looked_up));
}

void expect_same(const Case& c, const RenderRequest& r, const std::string& how)
{
    ASSERT_TRUE(DiffuseScene::of(build_scene(c.scene))) << c.name;
    RenderRequest with_aovs = r;
    with_aovs.aovs = all_aovs();
    const Rendered eight = render(c.scene, r), one = render(c.scene, with_aovs);
    EXPECT_TRUE(same_bits(eight.film, one.film)) << c.name << ", " << how;
    EXPECT_EQ(eight.counters.bounce_rays, one.counters.bounce_rays) << c.name << ", " << how;
    EXPECT_EQ(eight.counters.shadow_rays, one.counters.shadow_rays) << c.name << ", " << how;
    EXPECT_GT(tally(eight.film).mean, 0) << c.name << ", " << how;
}

TEST(Diffuse, HasTheBitsOfTheLoopForAll)
{
    for (const Case& c : cases()) {
        RenderRequest r;
        r.settings.kernel.batch = 100;  // no multiple of eight
        expect_same(c, r, "plain");
        r.settings.kernel.sampler = SamplerKind::independent;
        expect_same(c, r, "independent numbers");
    }
}

TEST(Diffuse, HasThemWithAnyTechnique)
{
    for (const Case& c : cases())
        for (const bool nee : {true, false})
            for (const bool mis : {true, false})
                for (const bool plan : {true, false})
                    for (const uint32_t depth : {0u, 1u, 3u}) {
                        Path path{.max_depth = depth, .roulette_depth = 2, .direct = {nee, mis}};
                        path.split = path.roulette_by_pixel = plan;
                        RenderRequest r;
                        r.spp = {4};
                        r.settings.integrator = path;
                        expect_same(c, r, std::to_string(nee) + std::to_string(mis) + std::to_string(plan));
                    }
}

TEST(Diffuse, HasThemForEachPartOfTheLight)
{
    for (const Case& c : cases())
        for (const Switch part : {Switch::direct, Switch::indirect, Switch::emitters}) {
            Switches switches;
            switches.set(part, false);
            RenderRequest r;
            r.settings.integrator = make_integrator("path", {.switches = switches});
            expect_same(c, r, std::string(switch_names[static_cast<size_t>(part)]));
        }
}

// What the eight lanes know nothing of is left to the loop for all.
TEST(Diffuse, IsForPlainScenesAlone)
{
    for (const auto& [name, d] : all_test_scenes())
        EXPECT_EQ(DiffuseScene::of(build_scene(d, test_picture)).has_value(), std::string(name) == "cornell") << name;
    SceneDescription d = smooth_scene();
    d.lights.push_back(sky_of({1, 1, 1}));
    EXPECT_FALSE(DiffuseScene::of(build_scene(d))) << "a lamp and a sky";
    d = smooth_scene();
    d.lights.push_back(light_of(LightType::point, {1, 1, 1}, {0, 3, 0}));
    EXPECT_FALSE(DiffuseScene::of(build_scene(d))) << "a point";
    d = smooth_scene();
    MaterialDescription lamp = make_gauze("lamp", {}, 0.8f);
    lamp.emission = {6, 5, 4};
    d.meshes[2].data = make_quad({1.2, 0, -0.3}, {1.2, 0, 0.3}, {1.2, 0.6, 0.3}, {1.2, 0.6, -0.3}, lamp);
    EXPECT_FALSE(DiffuseScene::of(build_scene(d))) << "a lamp with holes";
}

}  // namespace
}  // namespace lancer
