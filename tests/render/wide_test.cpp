// Scenes without media are traced eight paths at a time, with the bits of the loop that there is for all, whatever is
// asked of the path tracer.
#include <gtest/gtest.h>

#include "scene/wide_scene.h"
#include "support/render.h"
#include "support/scenes/dark_rooms.h"
#include "support/scenes/wide_cases.h"

namespace lancer {
namespace {

TEST(Wide, HasATreeAndEveryFeatureAmongItsCases)
{
    EXPECT_TRUE(build_scene(wide_cases()[3].scene).lights.tree);
    EXPECT_FALSE(build_scene(wide_cases()[2].scene).lights.tree);
    EXPECT_FALSE(build_scene(all_lights()).lights.tree);
    EXPECT_TRUE(build_scene(balls_of_light()).lights.pick.can_remap());
    EXPECT_FALSE(build_scene(a_dim_ball_more()).lights.pick.can_remap());
    EXPECT_FALSE(build_scene(a_dim_ball_more()).lights.tree);
    EXPECT_TRUE(build_scene(many_balls()).lights.tree);
    EXPECT_FALSE(build_scene(many_balls()).lights.far.empty());
    EXPECT_FALSE(WideScene::of(build_scene(flat_scene(5, 8)))->flat.empty());
    EXPECT_TRUE(WideScene::of(build_scene(flat_scene(30, 40)))->flat.empty());
    const std::vector<WideScene::LightKind> light_kinds = WideScene::of(build_scene(balls_of_light()))->light_kinds;
    for (const auto lamp : {WideScene::LightKind::triangle, WideScene::LightKind::sphere,
                            WideScene::LightKind::constant_environment, WideScene::LightKind::other})
        EXPECT_TRUE(std::find(light_kinds.begin(), light_kinds.end(), lamp) != light_kinds.end())
            << static_cast<int>(lamp);
    EXPECT_TRUE(build_scene(many_lights()).lights.tree);
    EXPECT_FALSE(build_scene(many_lights()).lights.far.empty());
    Features all;
    for (const WideCase& c : wide_cases()) all = all | features_of(build_scene(c.scene));
    EXPECT_TRUE(all.covers(WideScene::plain | WideScene::textured | WideScene::any));
}

// A case with its scene, which is built once for all that is drawn of it.
struct Built {
    explicit Built(const WideCase& of) : name(of.name), description(of.scene), scene(build_scene(of.scene)) {}
    std::string name;
    SceneDescription description;
    Scene scene;
};
std::vector<Built> built_cases()
{
    const std::vector<WideCase> cases = wide_cases();
    return {cases.begin(), cases.end()};
}

// Among the cases of each shading is one where light is sampled by place, and one where lights are chosen so.
TEST(Wide, HasLearnedChoicesAmongItsCases)
{
    std::array<uint32_t, 3> learned{}, chosen{};
    with_threads(1, [&] {
        for (const Built& c : built_cases()) {
            const auto shading = static_cast<size_t>(WideScene::of(c.scene)->shading);
            const Renderer renderer(build_scene(c.description), {});
            const auto plan = renderer.plan(camera_of(c.description, renderer.scene(), 32, 24), 32, 24);
            learned[shading] += !plan->light_choice.empty();
            chosen[shading] += plan->light_choice.chooses();
        }
    });
    for (size_t shading = 0; shading < 3; ++shading) {
        EXPECT_GT(learned[shading], 0u) << shading;
        EXPECT_GT(chosen[shading], 0u) << shading;
    }
}

void expect_same(const Built& c, const RenderRequest& r, const std::string& how)
{
    ASSERT_TRUE(WideScene::of(c.scene)) << c.name;
    RenderRequest by_one = r;
    by_one.settings.kernel.profile = Profile::all;
    const Rendered eight = render(c.scene, c.description, r), one = render(c.scene, c.description, by_one);
    EXPECT_TRUE(same_bits(eight.film, one.film)) << c.name << ", " << how;
    EXPECT_EQ(eight.counters.bounce_rays, one.counters.bounce_rays) << c.name << ", " << how;
    EXPECT_EQ(eight.counters.shadow_rays, one.counters.shadow_rays) << c.name << ", " << how;
    EXPECT_GT(tally(eight.film).mean, 0) << c.name << ", " << how;
}

// A picture so large that the pilot chooses tiles of the sky, by all shadings that can sample them.
TEST(Wide, HasThemWithTilesOfTheSky)
{
    for (const NamedRoom& room : rooms_with_window()) {
        const Built c({room.name, room.description});
        RenderRequest r;
        r.width = 256, r.height = 192, r.spp = {1};
        with_threads(1, [&] {
            const Renderer renderer(build_scene(c.description), {});
            const auto plan =
                renderer.plan(camera_of(c.description, renderer.scene(), r.width, r.height), r.width, r.height);
            EXPECT_TRUE(plan->light_choice.has_tiles) << c.name;
        });
        expect_same(c, r, "tiles");
    }
}

TEST(Wide, HasTheBitsOfTheLoopForAll)
{
    for (const Built& c : built_cases()) {
        RenderRequest r;
        r.settings.kernel.batch = 100;  // no multiple of eight
        expect_same(c, r, "plain");
        r.settings.kernel.sampler = SamplerKind::independent;
        expect_same(c, r, "independent numbers");
    }
}

// Where both ask an accelerator that begins on the triangle where a ray starts.
TEST(Wide, HasThemWithATreeOfOurOwn)
{
    for (const Built& c : built_cases()) {
        RenderRequest r;
        r.spp = {4};
        r.settings.accel = AccelKind::bvh8;
        expect_same(c, r, "bvh8");
    }
}

TEST(Wide, HasThemWithAnyTechnique)
{
    for (const Built& c : built_cases())
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

TEST(Wide, HasThemForEachPartOfTheLight)
{
    for (const Built& c : built_cases())
        for (const auto part : {&RenderSettings::direct, &RenderSettings::indirect, &RenderSettings::emitters}) {
            RenderSettings settings;
            settings.*part = false;
            RenderRequest r;
            r.settings.integrator = make_integrator(settings);
            expect_same(c, r, !settings.direct ? "direct" : !settings.indirect ? "indirect" : "emitters");
        }
}

TEST(Wide, HasThemThroughALensAndAnyFilter)
{
    for (WideCase c : wide_cases()) {
        c.scene.camera->type = CameraType::thin_lens;
        c.scene.camera->aperture = 0.05;
        const Built built(c);
        for (const FilterKind filter : {FilterKind::box, FilterKind::blackman_harris}) {
            RenderRequest r;
            r.spp = {2};
            r.settings.kernel.filter = Filter(filter);
            expect_same(built, r, "lens");
        }
    }
}

// The least of three ways is taken, and what the eight lanes know nothing of is left to the loop for all.
TEST(Wide, IsForScenesWithoutMedia)
{
    const auto way = [](const SceneDescription& d) { return WideScene::of(build_scene(d))->shading; };
    EXPECT_EQ(way(smooth_scene()), Shading::plain);
    EXPECT_EQ(way(looked_up_scene()), Shading::textured);
    EXPECT_EQ(way(glossy_scene()), Shading::any);
    EXPECT_FALSE(WideScene::of(build_scene(media_scene())));
    for (const MaterialType type : {MaterialType::plastic, MaterialType::metal, MaterialType::mirror,
                                    MaterialType::glass, MaterialType::interface}) {
        MaterialDescription m = make_lambert("floor", {0.8f, 0.8f, 0.8f});
        m.type = type;
        SceneDescription d = smooth_scene();
        d.meshes[0].data = make_quad({-2, -0.8, 2}, {2, -0.8, 2}, {2, -0.8, -2}, {-2, -0.8, -2}, std::move(m));
        EXPECT_EQ(way(d), Shading::any) << static_cast<int>(type);
    }
}

}  // namespace
}  // namespace lancer
