#include "io/image/jpeg.h"

#include <cmath>

#include "io/atomic_file.h"
#include "io/image/png.h"
#include "io/image/read.h"
#include "io/temp_folder.h"

namespace lancer {
namespace {

void write_jpeg_file(const std::string& path, const Image& image, const Metadata& metadata = {},
                     const ByteOptions& options = {}, int quality = 95)
{
    AtomicFile file(path);
    write_jpeg(file, image, metadata, options, quality);
    file.commit();
}

Image smooth_picture()
{
    Image image = make_image(40, 24);
    for (int32_t y = 0; y < 24; ++y)
        for (int32_t x = 0; x < 40; ++x)
            image.at(x, y) = {static_cast<float>(x) / 40, static_cast<float>(y) / 24, 0.2f};
    return image;
}

int largest_difference(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b)
{
    EXPECT_EQ(a.size(), b.size());
    int most = 0;
    for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most;
}

// Whatever exposure and tone map.
TEST(Jpeg, HoldsTheStepsOfThePngButForItsLoss)
{
    const TempFolder folder;
    const std::string png = folder.file("a.png"), jpg = folder.file("a.jpg");
    for (const ToneMap map : {ToneMap::srgb, ToneMap::agx, ToneMap::none, ToneMap::gamma22, ToneMap::clamped}) {
        const ByteOptions options{.exposure_stops = -0.5f, .tonemap = map};
        write_png(png, smooth_picture(), {}, options);
        write_jpeg_file(jpg, smooth_picture(), {}, options, 100);
        EXPECT_LE(largest_difference(read_raster(jpg)->bytes, read_raster(png)->bytes), 3);
    }
}

// Columns of red and blue in turns survive only where colours have the full resolution.
TEST(Jpeg, ColoursHaveTheFullResolution)
{
    const TempFolder folder;
    Image image = make_image(32, 32);
    for (int32_t y = 0; y < 32; ++y)
        for (int32_t x = 0; x < 32; ++x) image.at(x, y) = x % 2 ? Color{1, 0, 0} : Color{0, 0, 1};
    write_jpeg_file(folder.file("a.jpg"), image);
    EXPECT_LE(largest_difference(read_raster(folder.file("a.jpg"))->bytes, to_bytes(image, {})), 16);
}

TEST(Jpeg, LessQualityIsSmaller)
{
    const TempFolder folder;
    size_t before = 0;
    for (const int quality : {1, 50, 95, 100}) {
        write_jpeg_file(folder.file("a.jpg"), smooth_picture(), {}, {.dither = true}, quality);
        const size_t size = read_bytes(folder.file("a.jpg")).size();
        EXPECT_GT(size, before);
        before = size;
    }
}

TEST(Jpeg, MetadataComesBackAsText)
{
    const TempFolder folder;
    const std::string path = folder.file("a.jpg");
    write_jpeg_file(path, smooth_picture(),
                    {{"spp", int64_t{4}}, {"scene", "two\nlines"}, {"long", std::string(70000, 'x')}});
    const Metadata back = read_picture_metadata(path);
    ASSERT_EQ(back.size(), 3u);
    EXPECT_EQ(text_of(back, "spp"), "4");
    EXPECT_EQ(text_of(back, "scene"), "two\nlines");
    EXPECT_EQ(text_of(back, "long"), std::string(65533 - 12, 'x'));
}

TEST(Jpeg, WhatCannotBeWrittenLeavesNoFile)
{
    const TempFolder folder;
    EXPECT_THROW(write_jpeg_file(folder.file("a.jpg"), Image{}), Error);
    expect_error(ErrorKind::failed, folder.file("a.jpg"), "Maximum supported image dimension is 65500 pixels",
                 [&] { write_jpeg_file(folder.file("a.jpg"), make_image(65501, 1)); });
    EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace lancer
