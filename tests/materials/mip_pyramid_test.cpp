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

// What a limit leaves is what was there, to the bit, and all of it is what the header foretells.
TEST(MipPyramid, ALimitDropsTheLevelsAboveItAndNothingElse)
{
    const auto bytes_of_test = [](uint32_t x, uint32_t y, uint32_t c) { return (x * 7 + y * 13 + c * 29) % 256; };
    for (const Size size : odd_and_even_sizes)
        for (const uint32_t channels : {1u, 3u, 4u})
            for (const bool as_floats : {false, true})
                for (const Channel channel : {Channel::color, Channel::luminance, Channel::alpha}) {
                    Raster raster = byte_raster(size, channels, bytes_of_test);
                    if (as_floats) {
                        raster.is_float = true;
                        for (const uint8_t b : raster.bytes) raster.floats.push_back(static_cast<float>(b) / 3 + 0.1f);
                        raster.bytes.clear();
                    }
                    if (channel == Channel::alpha && !raster.has_alpha()) continue;
                    const RasterHeader header{
                        .width = raster.width,
                        .height = raster.height,
                        .channels = channels,
                        .values = as_floats ? RasterHeader::Values::floats : RasterHeader::Values::bytes};
                    const MipPyramid whole = build_pyramid(raster, Encoding::of_file, channel);
                    EXPECT_EQ(cost_of_pyramid(header, Encoding::of_file, channel, 0).kept, whole.bytes());
                    for (const uint32_t limit : {1u, 2u, 5u, 16u, 65536u}) {
                        const MipPyramid part = build_pyramid(raster, Encoding::of_file, channel, limit);
                        ASSERT_LE(std::max(part.levels[0].width, part.levels[0].height), limit);
                        ASSERT_LE(part.levels.size(), whole.levels.size());
                        const size_t dropped = whole.levels.size() - part.levels.size();
                        if (dropped > 0) {
                            EXPECT_GT(std::max(whole.levels[dropped - 1].width, whole.levels[dropped - 1].height),
                                      limit);
                        }
                        std::visit(
                            [&](const auto& of_part) {
                                using Values = std::remove_cvref_t<decltype(of_part)>;
                                const auto& of_whole = std::get<Values>(whole.values);
                                const size_t before = whole.levels[dropped].first;
                                EXPECT_EQ(of_part, Values(of_whole.begin() + static_cast<std::ptrdiff_t>(before),
                                                          of_whole.end()));
                                for (size_t i = 0; i < part.levels.size(); ++i)
                                    EXPECT_EQ(part.levels[i].first + before, whole.levels[i + dropped].first);
                            },
                            part.values);
                        EXPECT_EQ(part.mean, whole.mean);
                        EXPECT_EQ(cost_of_pyramid(header, Encoding::of_file, channel, limit).kept, part.bytes());
                    }
                }
}

}  // namespace
}  // namespace lancer
