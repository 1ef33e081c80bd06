// Every way to render a scene, judged by the reference and by each other.
#include <gtest/gtest.h>

#include "reference/judged_scenes.h"
#include "reference/same_light.h"

namespace lancer {
namespace {

struct Case {
    const char* name;
    SceneDescription (*scene)();
    uint32_t max_depth;
    double detectable;      // see SameLight
    bool meets_all = true;  // rays meet every light, so that paths without light sampling find it
};

Shot shot_of(uint32_t spp, uint64_t seed, const AnyIntegrator& integrator)
{
    Shot shot;
    shot.width = 16, shot.height = 12, shot.spp = spp;
    shot.sampler = SamplerKind::independent;
    shot.seed = seed;
    shot.integrator = integrator;
    return shot;
}

constexpr uint32_t samples = 512;

class Agreement : public testing::TestWithParam<Case> {};

TEST_P(Agreement, OfPathsAndTheReference)
{
    const Case& c = GetParam();
    const SceneDescription d = c.scene();
    SameLight same(c.name, c.detectable);
    Path path;
    path.max_depth = c.max_depth;
    same.add(way_of("path", shoot(d, shot_of(samples, 1, path))));
    path.direct.mis = false;
    same.add(way_of("path without mis", shoot(d, shot_of(samples, 2, path))));
    path.direct.nee = false;
    if (c.meets_all) same.add(way_of("path without nee", shoot(d, shot_of(samples, 3, path))));
    same.add(way_of(
        reference::render(d, {.spp = samples, .max_depth = c.max_depth, .seed = 4, .threads = 2}, test_picture)));
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Agreement,
    testing::Values(Case{"room", cornell_scene, 4, 0.1}, Case{"mirrors", mirrors_scene, 4, 0.1},
                    Case{"smooth glass", [] { return glass_scene(0); }, 6, 0.1},
                    Case{"rough glass", [] { return glass_scene(0.6f); }, 5, 0.1}, Case{"metal", metal_scene, 4, 0.1},
                    Case{"plastic", plastic_scene, 4, 0.1}, Case{"interfaces", interfaces_scene, 5, 0.1},
                    Case{"mixes", mixes_scene, 4, 0.1}, Case{"points", points_scene, 4, 0.1, false},
                    Case{"sky picture", sky_picture_scene, 4, 0.1}, Case{"background", background_scene, 5, 0.1, false},
                    Case{"cut-outs", cut_out_scene, 4, 0.1}, Case{"instances", smooth_instances_scene, 4, 0.1},
                    Case{"emitters", emitters_scene, 4, 0.1}, Case{"media", media_scene, 6, 0.1},
                    Case{"balls", spheres_scene, 0, 0.1}),
    [](const testing::TestParamInfo<Case>& which) {
        std::string name = which.param.name;
        for (char& c : name)
            if (c == ' ' || c == '-') c = '_';
        return name;
    });

}  // namespace
}  // namespace lancer
