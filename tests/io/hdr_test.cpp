#include "io/image/hdr.h"

#include <cmath>
#include <limits>

#include "io/atomic_file.h"
#include "io/image/read.h"
#include "io/temp_folder.h"

namespace lancer {
namespace {

using Rgbe = std::array<uint8_t, 4>;

void write_hdr_file(const std::string& path, const Image& image, const Metadata& metadata = {})
{
    AtomicFile file(path);
    write_hdr(file, rows_of(image), metadata);
    file.commit();
}

// What the bytes mean to a reader that takes them as they stand.
Color meaning(const Rgbe& p)
{
    const auto value = [&](uint8_t x) { return p[3] ? std::ldexp(static_cast<float>(x), p[3] - 136) : 0.0f; };
    return {value(p[0]), value(p[1]), value(p[2])};
}

// Colours over the whole range, and runs and copies of all lengths.
Image varied(int32_t width, int32_t height)
{
    Image image = make_image(width, height);
    uint32_t h = 1;
    const auto next = [&] { return (h = h * 1664525u + 1013904223u) >> 8; };
    Color c;
    for (uint32_t i = 0, left = 0; i < image.pixels.size(); ++i, --left) {
        if (left == 0) {
            left = next() % 3 ? 1 : 1 + next() % 300;
            const auto channel = [&] {
                return std::ldexp(static_cast<float>(next()), static_cast<int>(next() % 60) - 54);
            };
            c = {channel(), channel(), channel()};
        }
        image.pixels[i] = c;
    }
    return image;
}

TEST(Hdr, ColoursBecomeTheNearestNumbers)
{
    EXPECT_EQ(to_rgbe({1, 0.5f, 0.25f}), (Rgbe{128, 64, 32, 129}));
    EXPECT_EQ(to_rgbe({0, 0, 0}), Rgbe{});
    EXPECT_EQ(to_rgbe({-1, std::numeric_limits<float>::quiet_NaN(), 2}), (Rgbe{0, 0, 128, 130}));
    EXPECT_EQ(to_rgbe({0.999f, 0, 0}), (Rgbe{128, 0, 0, 129}));  // would be 256 of the exponent below
    EXPECT_EQ(to_rgbe({255.4f / 256, 0, 0}), (Rgbe{255, 0, 0, 128}));
    EXPECT_EQ(to_rgbe({std::numeric_limits<float>::infinity(), 0, 0}), (Rgbe{255, 0, 0, 255}));
    EXPECT_EQ(to_rgbe({std::numeric_limits<float>::max(), 0, 0}), (Rgbe{255, 0, 0, 255}));
    EXPECT_EQ(to_rgbe({1e-45f, 0, 0}), Rgbe{});
    EXPECT_EQ(to_rgbe({0x1p-128f, 0, 0}), (Rgbe{128, 0, 0, 1}));
}

TEST(Hdr, AChannelIsOffByHalfAStepAtMost)
{
    for (const Color c : varied(100, 100).pixels) {
        const Rgbe p = to_rgbe(c);
        const Color back = meaning(p);
        const float half_step = std::ldexp(0.5f, p[3] - 136);
        EXPECT_LE(std::abs(back.r - c.r), half_step);
        EXPECT_LE(std::abs(back.g - c.g), half_step);
        EXPECT_LE(std::abs(back.b - c.b), half_step);
        EXPECT_TRUE(p[3] == 0 || std::max({p[0], p[1], p[2]}) >= 128);
    }
}

// Widths around the ends of the packed form, as our own reader finds them.
TEST(Hdr, APictureComesBack)
{
    const TempFolder folder;
    const std::string path = folder.file("a.hdr");
    for (const int32_t width : {1, 7, 8, 127, 129, 1000, 32767, 32768}) {
        const Image image = varied(width, 3);
        write_hdr_file(path, image);
        const Image back = read_image(path);
        ASSERT_EQ(back.display, image.display);
        for (size_t i = 0; i < image.pixels.size(); ++i)
            ASSERT_EQ(back.pixels[i], meaning(to_rgbe(image.pixels[i]))) << width << " " << i;
    }
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.hdr"});
}

TEST(Hdr, RunsArePacked)
{
    const TempFolder folder;
    Image image = make_image(1000, 10);
    for (Color& c : image.pixels) c = {1, 2, 3};
    write_hdr_file(folder.file("a.hdr"), image);
    EXPECT_LT(read_bytes(folder.file("a.hdr")).size(), 1000u);
}

TEST(Hdr, MetadataComesBackAsText)
{
    const TempFolder folder;
    const std::string path = folder.file("a.hdr");
    write_hdr_file(path, make_image(9, 2), {{"spp", int64_t{4}}, {"scene", "two\nlines = 1"}});
    EXPECT_EQ(read_picture_metadata(path), (Metadata{{"spp", "4"}, {"scene", "two lines = 1"}}));
}

TEST(Hdr, WithoutPixelsThereIsNoFile)
{
    const TempFolder folder;
    EXPECT_THROW(write_hdr_file(folder.file("a.hdr"), Image{}), Error);
    EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace lancer
