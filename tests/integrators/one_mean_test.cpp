// The claim that pictures have one mean: a bias that it says would show does show, and it takes as many pictures as
// that needs.
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include "support/shoot.h"

namespace lancer {
namespace {

SceneDescription floor_under_a_ball(float radiance)
{
    SceneDescription d;
    d.meshes.push_back(make_mesh(make_quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1})));
    d.lights.push_back(light_of(LightType::sphere, {radiance, radiance, radiance}, {0, 1, 0}, 0.5));
    d.camera = make_camera({0, 0.5, 2.5}, {0, 0, 0}, 30);
    return d;
}

std::vector<TilesOverSeeds> two_ways(float radiance)
{
    Shot shot{.integrator = Path{.max_depth = 1, .direct = {false, false}}, .width = 16, .height = 16};
    std::vector<TilesOverSeeds> ways{{floor_under_a_ball(1), shot}};
    shot.seed = 1;
    ways.emplace_back(floor_under_a_ball(radiance), shot);
    return ways;
}

TEST(OneMean, ABiasShowsAndIsFoundAgain)
{
    const OneMean claim{.pictures = 8, .detectable = 0.1, .names = {"as it is", "brighter"}};
    expect_one_mean(two_ways(1), claim, "the same");
    testing::TestPartResultArray failures;
    {
        using Reporter = testing::ScopedFakeTestPartResultReporter;
        const Reporter reporter(Reporter::INTERCEPT_ONLY_CURRENT_THREAD, &failures);
        expect_one_mean(two_ways(1.06f), claim, "another");
    }
    ASSERT_GT(failures.size(), 0);  // of a tile, of the whole, or of both
    EXPECT_NE(std::string(failures.GetTestPartResult(0).message()).find("brighter"), std::string::npos);
}

TEST(OneMean, TakesPicturesUntilItCanTell)
{
    std::vector<TilesOverSeeds> ways = two_ways(1);
    const double by_eight = add_until_detectable(ways, {.pictures = 8});
    ASSERT_EQ(ways[0].whole().n, 8);
    ways = two_ways(1);
    EXPECT_LT(add_until_detectable(ways, {.pictures = 8, .detectable = by_eight / 2}), by_eight / 2);
    EXPECT_GT(ways[0].whole().n, 16);
    EXPECT_LE(ways[0].whole().n, 64);
    // What it cannot tell it says.
    EXPECT_NONFATAL_FAILURE(expect_one_mean(two_ways(1), {.pictures = 2, .detectable = 1e-6}, "hopeless"), "too noisy");
}

}  // namespace
}  // namespace lancer
