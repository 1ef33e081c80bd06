#include "scene/environment/sky_tiles.h"

#include <gtest/gtest.h>

#include <array>

#include "support/random.h"

namespace lancer {
namespace {

// Samples lie in their tile, but for those that rounding moves across a border.
TEST(SkyTiles, ContainTheirSamples)
{
    Random random(1);
    for (uint32_t tile = 0; tile < SkyTiles::count; ++tile) {
        constexpr uint32_t n = 1000;
        uint32_t inside = 0;
        for (uint32_t i = 0; i < n; ++i) {
            const Vec3 d = SkyTiles::sample(tile, random.unit2());
            EXPECT_NEAR(length(d), 1, 1e-6f);
            inside += SkyTiles::tile_of(d) == tile;
        }
        EXPECT_GE(inside, n - 2) << tile;
        EXPECT_EQ(SkyTiles::tile_of(SkyTiles::sample(tile, {0.5f, 0.5f})), tile);
    }
}

// Of n uniform directions each tile has n / count, within six standard deviations.
TEST(SkyTiles, HaveEqualSolidAngles)
{
    Random random(2);
    constexpr uint32_t per_tile = 10000;
    std::array<uint32_t, SkyTiles::count> found{};
    for (uint32_t i = 0; i < per_tile * SkyTiles::count; ++i) ++found[SkyTiles::tile_of(random.unit_vector())];
    for (uint32_t tile = 0; tile < SkyTiles::count; ++tile) EXPECT_NEAR(found[tile], per_tile, 600) << tile;
    EXPECT_NEAR(double{SkyTiles::pdf} * 4 * std::numbers::pi, SkyTiles::count, 1e-4);
}

// The mean of a smooth function over all tiles is that over the sphere.
TEST(SkyTiles, AreSampledUniformly)
{
    Random random(3);
    const Vec3 axis = normalize(Vec3{1, 2, -3});
    const auto f = [&](Vec3 d) { return double{dot(d, axis) * dot(d, axis)} + double{d.x * d.y}; };
    double sum = 0, squares = 0;
    constexpr uint32_t n = 4000;
    for (uint32_t tile = 0; tile < SkyTiles::count; ++tile)
        for (uint32_t i = 0; i < n; ++i) {
            const double value = f(SkyTiles::sample(tile, random.unit2()));
            sum += value, squares += value * value;
        }
    constexpr double count = double{n} * SkyTiles::count;
    const double mean = sum / count, deviation = std::sqrt((squares / count - mean * mean) / count);
    EXPECT_NEAR(mean, 1.0 / 3, 5 * deviation);
}

TEST(SkyTiles, KnowDirectionsAlongAxesAndBeyond)
{
    for (const Vec3 d : {Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, -1}, Vec3{0, 1.0001f, 0},
                         Vec3{0, -1.0001f, 0}, Vec3{-1, 0, -1}})
        EXPECT_LT(SkyTiles::tile_of(d), SkyTiles::count);
}

}  // namespace
}  // namespace lancer
