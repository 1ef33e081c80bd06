// Whatever saves rays leaves the mean alone: pictures with each of it against the plain path tracer, scene by scene,
// and what bias would have shown.
#include <gtest/gtest.h>

#include "support/scenes/media_scenes.h"
#include "support/shoot.h"

namespace lancer {
namespace {

Path path_with(bool split, bool roulette, DirectLight direct = {})
{
    Path path{.max_depth = 8, .direct = direct};
    path.split = split, path.roulette_by_pixel = roulette;
    return path;
}

void expect_estimators_agree(const SceneDescription& d, double detectable, const std::string& name)
{
    std::vector<TilesOverSeeds> ways;
    uint64_t seed = 100;
    for (const Path& path : {path_with(false, false), path_with(true, false), path_with(false, true),
                             path_with(true, true), path_with(false, false, {.always = true})})
        ways.emplace_back(d, Shot{.integrator = path, .spp = 8, .seed = ++seed});
    expect_one_mean(std::move(ways), {.pictures = 16, .detectable = detectable, .rounding = 1e-5}, name);
}

// The sky alone lights it, and what shines there.
SceneDescription under_a_sky()
{
    SceneDescription d = lights_scene();
    d.lights = {sky_of({0.5f, 0.7f, 0.9f})};
    return d;
}

TEST(Estimators, Cornell) { expect_estimators_agree(cornell_scene(), 0.02, "cornell"); }
TEST(Estimators, Spheres) { expect_estimators_agree(spheres_scene(), 0.02, "spheres"); }
TEST(Estimators, Sky) { expect_estimators_agree(under_a_sky(), 0.02, "sky"); }
TEST(Estimators, Textured) { expect_estimators_agree(textured_scene(), 0.02, "textured"); }
TEST(Estimators, AlphaTest) { expect_estimators_agree(holes_scene(), 0.02, "holes"); }
TEST(Estimators, Media) { expect_estimators_agree(media_scene(), 0.02, "media"); }
TEST(Estimators, Fog) { expect_estimators_agree(fog_scene(), 0.02, "fog"); }
TEST(Estimators, Scattering) { expect_estimators_agree(scattering_scene(), 0.03, "bodies"); }

}  // namespace
}  // namespace lancer
