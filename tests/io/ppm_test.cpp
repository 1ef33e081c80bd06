#include "io/image/ppm.h"

#include <gtest/gtest.h>

#include "io/image/png.h"
#include "io/image/read.h"
#include "io/temp_folder.h"

namespace lancer {
namespace {

Image small_picture()
{
    Image image = make_image(2, 2);
    image.at(0, 0) = {0, 1, 0.25f};
    image.at(1, 0) = {0.5f, -1, 7};
    image.at(0, 1) = {0.1f, 0.2f, 0.3f};
    image.at(1, 1) = {0.9f, 0.99f, 0.999f};
    return image;
}

TEST(Ppm, HasTheBytesOfTheFormat)
{
    const TempFolder folder;
    const std::string path = folder.file("a.ppm");
    write_ppm(path, small_picture(), {}, {.tonemap = ToneMap::clamped}, true);
    EXPECT_EQ(read_bytes(path), "P3\n2 2\n255\n0 255 63\n127 0 255\n25 51 76\n229 252 254\n");
    write_ppm(path, small_picture(), {}, {.tonemap = ToneMap::clamped});
    EXPECT_EQ(read_bytes(path),
              std::string("P6\n2 2\n255\n") + std::string("\x00\xff\x3f\x7f\x00\xff\x19\x33\x4c\xe5\xfc\xfe", 12));
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.ppm"});
}

TEST(Ppm, MetadataIsInCommentsOfOneLine)
{
    const TempFolder folder;
    const std::string path = folder.file("a.ppm");
    write_ppm(path, small_picture(), {{"spp", int64_t{4}}, {"scene", "two\nlines"}}, {}, true);
    EXPECT_TRUE(read_bytes(path).starts_with("P3\n# lancer:spp 4\n# lancer:scene two lines\n2 2\n255\n"));
}

// Whatever the tone map, what a reader finds is what stands in the PNG; both forms, comments and all.
TEST(Ppm, HoldsTheStepsOfThePng)
{
    const TempFolder folder;
    const std::string png = folder.file("a.png"), ppm = folder.file("a.ppm");
    for (const ToneMap map : {ToneMap::srgb, ToneMap::agx, ToneMap::none, ToneMap::gamma22, ToneMap::clamped})
        for (const bool ascii : {false, true}) {
            const ByteOptions options{.exposure_stops = -0.5f, .dither = true, .tonemap = map};
            write_png(png, small_picture(), {}, options);
            write_ppm(ppm, small_picture(), {{"made", "by a test"}}, options, ascii);
            EXPECT_EQ(read_raster(ppm)->bytes, read_raster(png)->bytes) << ascii;
        }
}

TEST(Ppm, WithoutPixelsThereIsNoFile)
{
    const TempFolder folder;
    EXPECT_THROW(write_ppm(folder.file("a.ppm"), Image{}), Error);
    EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace lancer
