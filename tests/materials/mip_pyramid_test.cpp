// The bytes of coarser levels, one by one.
#include "materials/textures/mip_pyramid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/srgb.h"
#include "materials/texture_samples.h"

namespace lancer {
namespace {

TEST(MipPyramid, MeansOfAnyTwoBytesBecomeTheNearestByteInLinearLight)
{
    // Columns a and b, for all of both: the next level has their mean.
    const Raster raster =
        byte_raster({512, 512}, 1, [](uint32_t x, uint32_t y, uint32_t) { return x % 2 ? y / 2 : x / 2; });
    for (const Encoding encoding : {Encoding::linear, Encoding::srgb}) {
        const MipPyramid pyramid = build_pyramid(raster, encoding, Channel::red);
        const auto& bytes = std::get<std::vector<uint8_t>>(pyramid.values);
        const auto linear = [&](uint32_t byte) {
            return encoding == Encoding::srgb ? linear_from_srgb(byte / 255.0) : byte / 255.0;
        };
        for (uint32_t a = 0; a < 256; ++a)
            for (uint32_t b = 0; b < 256; ++b) {
                const uint32_t got = bytes[pyramid.levels[1].first + b * 256 + a];
                const double mean = (linear(a) + linear(b)) / 2, off = std::abs(linear(got) - mean);
                const double below = got > 0 ? std::abs(linear(got - 1) - mean) : 1,
                             above = got < 255 ? std::abs(linear(got + 1) - mean) : 1;
                ASSERT_LE(off, std::min(below, above) + 1e-7) << a << " and " << b;
            }
    }
}

TEST(MipPyramid, LevelsLieBehindEachOther)
{
    for (const Size size : odd_and_even_sizes) {
        const MipPyramid pyramid =
            build_pyramid(byte_raster(size, 3, [](auto...) { return 7; }), Encoding::srgb, Channel::color);
        size_t first = 0;
        for (const MipLevel& level : pyramid.levels) {
            EXPECT_EQ(level.first, first);
            first += size_t{level.width} * level.height * 3;
        }
        EXPECT_EQ(pyramid.bytes(), first);
        EXPECT_EQ(pyramid.levels.back().width * pyramid.levels.back().height, 1u);
    }
}

}  // namespace
}  // namespace lancer
