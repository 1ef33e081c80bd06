// A camera that moves while its shutter is open.
#include <gtest/gtest.h>

#include "support/shoot.h"
#include "support/statistics/significance.h"

namespace lancer {
namespace {

// A wall of light left of x = 0, in a picture of 40x20 pixels that is 20 units wide at the wall. The camera goes to the
// right by 2 units: the edge goes to the left by 4 pixels, from the middle.
SceneDescription edge_of_light()
{
    SceneDescription d;
    d.meshes = {
        make_mesh(make_quad({-50, -50, 0}, {0, -50, 0}, {0, 50, 0}, {-50, 50, 0}, make_emitter("wall", {1, 1, 1})))};
    for (const double x : {0.0, 1.0, 2.0}) d.camera_path.push_back(make_camera({x, 0, 5}, {x, 0, 0}, 90));
    d.camera = d.camera_path.front();
    return d;
}

TEST(Shutter, AnEdgeIsSpreadOverItsWay)
{
    stats::Family family;
    const Film film =
        shoot(edge_of_light(), {.width = 40, .height = 20, .spp = 64, .sampler = SamplerKind::independent});
    for (uint32_t y = 0; y < film.height; ++y)
        for (uint32_t x = 0; x < film.width; ++x) {
            // The part of the time, and of the pixel, in which the edge is right of it.
            const double lit = x < 16 ? 1 : x >= 20 ? 0 : (19.5 - x) / 4;
            const stats::Tally seen = tally(film.at(x, y));
            if (lit == 0 || lit == 1)
                EXPECT_EQ(seen.mean, lit) << x;
            else
                family.add(stats::mean_p(seen, lit, 1e-6), "column " + std::to_string(x));
        }
}

// Less noise than by chance: a quarter of it.
TEST(Shutter, TimesAreStratified)
{
    const auto error = [](SamplerKind sampler) {
        const Film film = shoot(edge_of_light(), {.width = 40, .height = 20, .spp = 64, .sampler = sampler});
        double sum = 0;
        for (uint32_t y = 0; y < film.height; ++y)
            for (uint32_t x = 16; x < 20; ++x) sum += std::pow(tally(film.at(x, y)).mean - (19.5 - x) / 4, 2);
        return sum;
    };
    EXPECT_LT(error(SamplerKind::sobol), 0.5 * error(SamplerKind::independent));
}

TEST(Shutter, OneThatStandsStillHasTheBitsOfNoShutter)
{
    SceneDescription d = edge_of_light();
    d.camera_path.assign(3, *d.camera);
    SceneDescription without = d;
    without.camera_path.clear();
    const Film a = shoot(d, {}), b = shoot(without, {});
    for (size_t i = 0; i < a.pixels.size(); ++i) EXPECT_EQ(a.pixels[i].sum, b.pixels[i].sum);
}

}  // namespace
}  // namespace lancer
