#include "render/estimators/pilot.h"

#include <gtest/gtest.h>

#include <set>

#include "support/render.h"
#include "support/salt.h"
#include "support/scenes/lamp_grid.h"
#include "support/scenes/media_scenes.h"

namespace lancer {
namespace {

constexpr uint32_t width = 32, height = 24;

struct Planned {
    SamplingPlan plan;
    // Of the rays that samples 0 to 3 of a pixel sent on from where it splits.
    std::vector<std::set<uint32_t>> numbers;
};

Planned planned(const SceneDescription& d, RendererConfig settings = {})
{
    settings.kernel.seed = salted(settings.kernel.seed);
    Planned out;
    with_threads(1, [&] {
        const Renderer renderer(build_scene(d, test_picture), settings);
        const Camera camera = camera_of(d, renderer.scene(), width, height);
        out.plan = *renderer.plan(camera, width, height);
        for (uint32_t i = 0; i < 4; ++i) {
            auto& numbers = out.numbers.emplace_back();
            PathListener listener{[&](const PathState& s, const Hit&) {
                                      if (s.depth != 1 || s.branch != 0) return;  // else it skipped a surface
                                      EXPECT_TRUE(numbers.insert(s.sample).second);
                                  },
                                  [](const PathState&, const Surface&) {}, [](const PathState&, Color) {},
                                  [](const Ray&, Color, bool) {}};
            renderer.replay(camera, width, height, {width / 2, height / 2, i}, listener);
        }
    });
    return out;
}

RendererConfig with(bool split, bool roulette)
{
    RendererConfig settings;
    Path path;
    path.split = split, path.roulette_by_pixel = roulette;
    settings.integrator = path;
    return settings;
}

TEST(Pilot, PlansNothingThatIsSwitchedOff)
{
    const SamplingPlan none = planned(cornell_scene(), with(false, false)).plan;
    EXPECT_EQ(none.split, 1u);
    EXPECT_TRUE(none.importance.empty());
    const SamplingPlan split = planned(cornell_scene(), with(true, false)).plan;
    EXPECT_GT(split.split, 1u);
    EXPECT_TRUE(split.importance.empty());
    const SamplingPlan roulette = planned(cornell_scene(), with(false, true)).plan;
    EXPECT_EQ(roulette.split, 1u);
    EXPECT_EQ(roulette.importance.size(), 4u * 3u);
}

// Where nothing shines there is nothing to plan for, and no 0 / 0.
TEST(Pilot, LeavesADarkSceneAlone)
{
    SceneDescription d = cornell_scene();
    d.lights.clear();
    for (auto& mesh : d.meshes) {
        MeshData dark = *mesh.data;
        for (auto& m : dark.materials) m.emission = {};
        mesh.data = std::make_shared<const MeshData>(std::move(dark));
    }
    for (auto& m : d.materials) m.emission = {};
    const SamplingPlan plan = planned(d).plan;
    EXPECT_EQ(plan.split, 1u);
    EXPECT_TRUE(plan.importance.empty());
}

// The parts of all samples together have the numbers of one sequence, each once.
TEST(Pilot, DealsEachNumberOnce)
{
    const Planned p = planned(cornell_scene(), with(true, false));
    std::set<uint32_t> all;
    for (const auto& numbers : p.numbers) {
        EXPECT_EQ(numbers.size(), p.plan.split);
        for (const uint32_t n : numbers) EXPECT_TRUE(all.insert(n).second) << n;
    }
    EXPECT_EQ(*all.begin(), 0u);
    EXPECT_EQ(*all.rbegin(), 4 * p.plan.split - 1);
    EXPECT_EQ(all.size(), 4 * p.plan.split);
}

// The box under so many quads of light to a row all over its ceiling.
SceneDescription box_of_lamps(uint32_t row)
{
    SceneDescription d = cornell_scene();
    const double step = 2.0 / row;
    d.meshes[5] = make_mesh(
        make_lamp_grid(row, {step / 2 - 1, 0.99, step / 2 - 1}, step, step / 5, make_emitter("lamps", {12, 10, 8})));
    return d;
}

// Which of many lights is chosen for the first surface cannot be spread well over samples: there more paths pay. An
// order, over many pilots: each by itself is rounded to a power of two, one way or the other.
TEST(Pilot, SplitsLessWhereOneOfManyLightsIsChosen)
{
    const SceneDescription few = box_of_lamps(5), many = box_of_lamps(6);
    ASSERT_FALSE(build_scene(few).lights.tree);
    ASSERT_TRUE(build_scene(many).lights.tree);
    uint32_t of_few = 0, of_many = 0;
    for (uint64_t seed = 0; seed < 8; ++seed) {
        RendererConfig settings;
        settings.kernel.seed = seed;
        const uint32_t a = planned(few, settings).plan.split, b = planned(many, settings).plan.split;
        EXPECT_GE(a, b) << "seed " << seed;
        of_few += a, of_many += b;
    }
    EXPECT_GT(of_few, of_many);
}

// What accelerators disagree on in the last bits must not change all pixels of a picture.
TEST(Pilot, PlansTheSameByAnyAccelerator)
{
    for (const auto& [name, d] : all_test_scenes()) {
        const SamplingPlan embree = planned(d).plan;
        EXPECT_LE(embree.split, 4u) << name;
        RendererConfig settings;
        settings.accel = AccelKind::bvh8;
        const SamplingPlan bvh8 = planned(d, settings).plan;
        EXPECT_EQ(embree.split, bvh8.split) << name;
        EXPECT_TRUE(embree.importance == bvh8.importance) << name;
        EXPECT_TRUE(embree.light_choice.exponents == bvh8.light_choice.exponents) << name;
        EXPECT_TRUE(embree.light_choice.cumulative == bvh8.light_choice.cumulative) << name;
    }
}

}  // namespace
}  // namespace lancer
