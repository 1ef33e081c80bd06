// Every way to render a scene, judged by the reference and by each other.
#include <gtest/gtest.h>

#include "reference/judged_scenes.h"
#include "reference/same_light.h"
#include "reference/shipped.h"
#include "reference/textured_scenes.h"
#include "support/scenes/media_scenes.h"

namespace lancer {
namespace {

struct Case {
    std::string name;
    std::function<SceneDescription()> scene;
    uint32_t max_depth;
    double detectable;      // see SameLight
    bool meets_all = true;  // rays meet every light, so that paths without light sampling find it
    RasterSource images = test_picture;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
std::string name_of(const testing::TestParamInfo<Case>& which)
{
    std::string name = which.param.name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
    return name;
}

constexpr uint32_t samples = 1024;

Way way(const char* name, const Case& c, const SceneDescription& d, uint64_t seed, const AnyIntegrator& integrator)
{
    Shot shot{.integrator = integrator, .width = 16, .height = 12, .spp = samples};
    shot.sampler = SamplerKind::independent;
    shot.seed = seed;
    shot.images = c.images;
    return way_of(name, shoot(d, shot));
}
Way reference_way(const Case& c, const SceneDescription& d, bool indirect)
{
    return way_of(reference::render(
        d, {.spp = samples, .max_depth = c.max_depth, .seed = 4, .threads = 2, .indirect = indirect}, c.images));
}

class Paths : public testing::TestWithParam<Case> {};

TEST_P(Paths, FindTheLightOfTheReference)
{
    const Case& c = GetParam();
    const SceneDescription d = c.scene();
    SameLight same(c.name, c.detectable);
    Path path;
    path.max_depth = c.max_depth;
    same.add(way("path", c, d, 1, path));
    path.direct.mis = false;
    same.add(way("path without mis", c, d, 2, path));
    path.direct.nee = false;
    if (c.meets_all) same.add(way("path without nee", c, d, 3, path));
    same.add(reference_way(c, d, true));
}

// Narrows the view, so that nothing is averaged over the footprint of rays.
SceneDescription through_a_keyhole(SceneDescription d, double factor)
{
    d.camera->fov_deg /= factor;
    return d;
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Paths,
    testing::Values(Case{"room", cornell_scene, 4, 0.07}, Case{"mirrors", mirrors_scene, 4, 0.025},
                    Case{"smooth glass", [] { return glass_scene(0); }, 6, 0.02},
                    Case{"rough glass", [] { return glass_scene(0.6f); }, 5, 0.035},
                    Case{"smooth sheets", [] { return sheets_scene(0); }, 6, 0.03},
                    Case{"rough sheets", [] { return sheets_scene(0.6f); }, 5, 0.035},
                    Case{"translucent sheets", translucent_scene, 5, 0.03}, Case{"metal", metal_scene, 4, 0.04},
                    Case{"plastic", plastic_scene, 4, 0.03}, Case{"principled", principled_scene, 4, 0.04},
                    Case{"interfaces", interfaces_scene, 5, 0.045}, Case{"mixes", mixes_scene, 4, 0.035},
                    Case{"points", points_scene, 4, 0.02, false}, Case{"sky picture", sky_picture_scene, 4, 0.015},
                    Case{"background", background_scene, 5, 0.01, false}, Case{"cut-outs", cut_out_scene, 4, 0.025},
                    Case{"instances", smooth_instances_scene, 4, 0.025}, Case{"emitters", emitters_scene, 4, 0.012},
                    Case{"media", media_scene, 6, 0.03}, Case{"scattering bodies", scattering_scene, 0, 0.03},
                    Case{"fog", fog_scene, 5, 0.03}, Case{"fog between points", fog_between_points, 4, 0.05, false},
                    Case{"without limit", spheres_scene, 0, 0.03},
                    Case{"textures", panels_scene, 1, 0.02, true, small_picture},
                    Case{"relief", relief_scene, 1, 0.02, true, small_picture}, Case{"bands", bands_scene, 1, 0.02}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Shipped, Paths,
    testing::Values(Case{"spheres", [] { return shipped_scene("spheres"); }, 6, 0.06},
                    Case{"cornell", [] { return shipped_scene("cornell"); }, 4, 0.2},
                    Case{"presets", [] { return shipped_scene("seed-a/presets"); }, 4, 0.045, false},
                    Case{"copper", [] { return through_a_keyhole(shipped_scene("seed-a/copper"), 100); }, 5, 0.03,
                         false},
                    Case{"a room of spheres", [] { return shipped_scene("seed-b/three-spheres"); }, 4, 0.12}),
    name_of);

// What classic integrators show of matt surfaces and mirrors is the light that comes straight to the first matt one.
class Classics : public testing::TestWithParam<Case> {};

TEST_P(Classics, FindTheDirectLightOfTheReference)
{
    const Case& c = GetParam();
    const SceneDescription d = c.scene();
    SameLight same("direct light of " + c.name, c.detectable);
    RenderSettings settings{.max_depth = c.max_depth};
    uint64_t seed = 10;
    for (const char* name : {"direct", "whitted", "random-decision"}) {
        settings.integrator = value_of<IntegratorKind>(name).value();
        same.add(way(name, c, d, seed++, make_integrator(settings)));
    }
    same.add(reference_way(c, d, false));
}

// Planes that shine, and what shines within a lamp with holes, are found by paths alone.
SceneDescription findable(SceneDescription d)
{
    for (MaterialDescription& m : d.materials) {
        if (m.name == "wall") m.emission = {};
        if (m.name == "bulb") m.emission_both_sides = false;
    }
    return d;
}
SceneDescription all_matt(SceneDescription d)
{
    for (MaterialDescription& m : d.materials) m.type = MaterialType::lambert;
    return d;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Classics,
                         testing::Values(Case{"the room", cornell_scene, 3, 0.1},
                                         Case{"mirrors", mirrors_scene, 4, 0.05},
                                         Case{"points", [] { return all_matt(points_scene()); }, 3, 0.02},
                                         Case{"a sky picture", [] { return all_matt(sky_picture_scene()); }, 3, 0.03},
                                         Case{"cut-outs", [] { return findable(cut_out_scene()); }, 3, 0.05},
                                         Case{"instances", smooth_instances_scene, 3, 0.05},
                                         Case{"emitters", [] { return findable(emitters_scene()); }, 3, 0.03}),
                         name_of);

}  // namespace
}  // namespace lancer
