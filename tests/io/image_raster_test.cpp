// Pictures as textures get them: bytes as bytes, with their alpha.
#include <array>

#include "io/image/exr.h"
#include "io/image/png.h"
#include "io/image/read.h"
#include "io/image_files.h"
#include "io/temp_folder.h"

namespace lancer {
namespace {

Raster raster_of(const std::string& name, const std::string& bytes)
{
    const TempFolder folder;
    write_bytes(folder.file(name), bytes);
    return *read_raster(folder.file(name));
}

using Bytes = std::vector<uint8_t>;
using Floats = std::vector<float>;

void expect_bytes(const Raster& r, uint32_t channels, const Bytes& bytes)
{
    EXPECT_EQ(r.channels, channels);
    EXPECT_EQ(r.bytes, bytes);
    EXPECT_TRUE(r.floats.empty());
    EXPECT_FALSE(r.is_float);
    EXPECT_EQ(r.value_count(), bytes.size());
}

void expect_floats(const Raster& r, uint32_t channels, const Floats& floats, bool is_float)
{
    EXPECT_EQ(r.channels, channels);
    EXPECT_EQ(r.floats, floats);
    EXPECT_TRUE(r.bytes.empty());
    EXPECT_EQ(r.is_float, is_float);
    EXPECT_EQ(r.value_count(), floats.size());
}

TEST(ImageRaster, BytesStayBytesInEveryFormat)
{
    const Bytes steps = {255, 0, 0, 0, 255, 0, 0, 0, 255, 188, 100, 7};
    expect_bytes(raster_of("a.ppm", ppm()), 3, steps);
    expect_bytes(raster_of("a.bmp", bmp()), 3, steps);
    expect_bytes(raster_of("a.tga", tga(false)), 3, steps);
    expect_bytes(raster_of("a.tif", tiff(8, 3, 1, top + bottom)), 3, steps);
    expect_bytes(raster_of("a.png", png(2, 2, 8, 2, "\0"s + top + "\0"s + bottom)), 3, steps);
    expect_bytes(raster_of("a.jpg", jpeg()), 1, Bytes(64, 188));
}

// Recommendation T.871, section 7: red = Y + 1.402 (Cr - 128), and so on.
TEST(ImageRaster, JpegsOfEveryKind)
{
    expect_bytes(raster_of("a", jpeg_of({188})), 1, Bytes(64, 188));
    Bytes color;
    for (int i = 0; i < 64; ++i) color.insert(color.end(), {118, 210, 255});
    expect_bytes(raster_of("a", jpeg_of({188, 168, 78})), 3, color);
    // Of four inks what is left of the light is R = C K / 255.
    const Raster inks = raster_of("a", jpeg_of({168, 188, 78, 90}));
    EXPECT_EQ(inks.channels, 3u);
    ASSERT_EQ(inks.bytes.size(), 3u * 64);
    for (size_t c = 0; c < 3; ++c) {
        const int ink = std::array{168, 188, 78}[c];
        EXPECT_NEAR(inks.bytes[c], ink * 90 / 255.0, 1) << c;
    }
}

TEST(ImageRaster, PngsOfEveryKind)
{
    expect_bytes(raster_of("a", png(2, 1, 8, 0, "\0\x01\xff"s)), 1, {1, 255});
    expect_bytes(raster_of("a", png(2, 1, 8, 4, "\0\x01\x80\xff\x02"s)), 2, {1, 128, 255, 2});
    expect_bytes(raster_of("a", png(1, 2, 8, 6, "\0\1\2\3\4\0\5\6\7\x08"s)), 4, {1, 2, 3, 4, 5, 6, 7, 8});
    expect_bytes(raster_of("a", png(4, 1, 2, 0, "\0\x1b"s)), 1, {0, 85, 170, 255});  // two bits each
    const std::string palette = png_chunk("PLTE", "\x0a\x0b\x0c\x14\x15\x16");
    expect_bytes(raster_of("a", png(2, 1, 8, 3, "\0\1\0"s, palette)), 3, {20, 21, 22, 10, 11, 12});
    expect_bytes(raster_of("a", png(2, 1, 8, 3, "\0\1\0"s, palette + png_chunk("tRNS", "\x80"))), 4,
                 {20, 21, 22, 255, 10, 11, 12, 128});
    // One colour is transparent.
    expect_bytes(raster_of("a", png(2, 1, 8, 2, "\0\1\2\3\4\5\6"s, png_chunk("tRNS", "\0\4\0\5\0\6"s))), 4,
                 {1, 2, 3, 255, 4, 5, 6, 0});
    expect_floats(raster_of("a", png(2, 1, 16, 4, "\0\x30\x39\xff\xff\0\0\x80\0"s)), 2,
                  {12345 / 65535.0f, 1, 0, 32768 / 65535.0f}, false);
}

TEST(ImageRaster, TargaAlphaIsWhatTheHeaderSays)
{
    const auto file = [](int bits, int alpha_bits, const std::string& pixels) {
        return "\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0"s + static_cast<char>(bits) + static_cast<char>(0x20 | alpha_bits) +
               pixels;
    };
    expect_bytes(raster_of("a.tga", file(32, 8, "\3\2\1\x80")), 4, {1, 2, 3, 128});
    expect_bytes(raster_of("a.tga", file(32, 0, "\3\2\1\x80")), 3, {1, 2, 3});
    expect_bytes(raster_of("a.tga", file(16, 1, "\x01\xfe")), 4, {255, 132, 8, 255});
    expect_bytes(raster_of("a.tga", file(16, 1, "\x01\x7e")), 4, {255, 132, 8, 0});
    const std::string grey = "\0\0\3\0\0\0\0\0\0\0\0\0\1\0\1\0\x10\x28\x07\x09"s;
    expect_bytes(raster_of("a.tga", grey), 2, {7, 9});
}

TEST(ImageRaster, MoreThanEightBitsAreFloats)
{
    const Floats values = {1, 2, 0.5f, 0, 0, 0, 100, 0, 0, 0.25f, 0.5f, 0.75f};
    expect_floats(raster_of("a.hdr", hdr()), 3, values, true);
    expect_floats(raster_of("a.pfm", pfm()), 3, values, true);
    expect_floats(raster_of("a.tif", tiff(16, 1, 1, pack<uint16_t>({0, 65535, 12345, 7}))), 1,
                  {0, 1, 12345 / 65535.0f, 7 / 65535.0f}, false);
    expect_floats(raster_of("a.tif", tiff(32, 1, 3, pack<float>({-1, 1e9f, 0.1f, 7}))), 1, {-1, 1e9f, 0.1f, 7}, true);
}

float exr_value(int32_t x, int32_t y, char channel, int32_t level)
{
    return static_cast<float>(x + 10 * y + 100 * level) + (channel == 'A' ? 0.5f : static_cast<float>(channel) * 1000);
}

TEST(ImageRaster, ExrWithAlphaAndWithoutColour)
{
    const float r = 'R' * 1000, g = 'G' * 1000, b = 'B' * 1000;
    const auto rgba =
        raster_of("a.exr", exr({.channels = "ABGR", .width = 2, .height = 1, .display = {0, 0, 1, 0}}, exr_value));
    expect_floats(rgba, 4, {r / 0.5f, g / 0.5f, b / 0.5f, 0.5f, (r + 1) / 1.5f, (g + 1) / 1.5f, (b + 1) / 1.5f, 1.5f},
                  true);
    const auto grey = raster_of("a.exr", exr({.channels = "Y", .display = {0, 0, 1, 1}}, exr_value));
    const float y = 'Y' * 1000;
    expect_floats(grey, 1, {y, y + 1, y + 10, y + 11}, true);
    const auto both =
        raster_of("a.exr", exr({.channels = "AY", .width = 1, .height = 1, .display = {0, 0, 0, 0}}, exr_value));
    expect_floats(both, 2, {y / 0.5f, 0.5f}, true);
}

TEST(ImageRaster, OfAMipMappedExrTheFinestLevel)
{
    const ExrFile file = {.channels = "ABGR", .width = 4, .height = 2, .display = {0, 0, 3, 1}, .mip_mapped = true};
    const Raster r = raster_of("a.exr", exr(file, exr_value));
    ASSERT_EQ(r.value_count(), 32u);
    for (int32_t i = 0; i < 8; ++i) {
        const float alpha = exr_value(i % 4, i / 4, 'A', 0);
        EXPECT_EQ(r.floats[static_cast<size_t>(i) * 4 + 2], exr_value(i % 4, i / 4, 'B', 0) / alpha);
        EXPECT_EQ(r.floats[static_cast<size_t>(i) * 4 + 3], alpha);
    }
}

TEST(ImageRaster, OfAnExrTheDisplayWindow)
{
    // The data window is (0, 0) to (1, 1), both included.
    const Raster inside = raster_of("a.exr", exr({.channels = "Y", .display = {1, 0, 1, 1}}, exr_value));
    const float y = 'Y' * 1000;
    EXPECT_EQ(inside.width, 1u);
    expect_floats(inside, 1, {y + 1, y + 11}, true);
    const Raster around = raster_of("a.exr", exr({.channels = "Y", .display = {-1, -1, 1, 0}}, exr_value));
    EXPECT_EQ(around.width, 3u);
    expect_floats(around, 1, {0, 0, 0, 0, y, y + 1}, true);
    const Raster beside = raster_of("a.exr", exr({.channels = "Y", .display = {5, 5, 5, 6}}, exr_value));
    expect_floats(beside, 1, {0, 0}, true);
    for (const std::vector<int32_t>& absurd : {std::vector{0, 0, 1000, 1000}, {0, 0, 2000000000, 1}, {3, 3, 1, 1}}) {
        const TempFolder folder;
        write_bytes(folder.file("a.exr"), exr({.channels = "Y", .display = absurd}, exr_value));
        expect_error(ErrorKind::invalid_input, folder.file("a.exr"), "", [&] { read_raster(folder.file("a.exr")); });
    }
}

void expect_raster_or_refused(const std::string& path)
{
    try {
        const auto r = read_raster(path);
        EXPECT_EQ(r->value_count(), r->bytes.size() + r->floats.size()) << path;
        EXPECT_TRUE(r->channels >= 1 && r->channels <= 4) << path;
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::invalid_input) << e.what();
        EXPECT_NE(std::string(e.what()).find(path), std::string::npos) << e.what();
    }
}

TEST(ImageRaster, TruncatedAndChangedFilesNeverCrash)
{
    const TempFolder folder;
    const std::string path = folder.file("a.tga");
    // The coarse level of the last one, 36 bytes, is not read and may be missing.
    const std::pair<std::string, size_t> files[] = {
        {png(2, 1, 16, 4, "\0\x30\x39\xff\xff\0\0\x80\0"s), 0},
        {png(2, 1, 8, 3, "\0\1\0"s, png_chunk("PLTE", "\x0a\x0b\x0c\x14\x15\x16") + png_chunk("tRNS", "\x80")), 0},
        {tga(true), 0},
        {exr({}, exr_value), 0},
        {exr({.mip_mapped = true}, exr_value), 36}};
    for (const auto& [whole, spare] : files) {
        for (size_t i = 0; i < whole.size(); i += whole.size() < 200 ? 1 : 7) {
            write_bytes(path, whole.substr(0, i));
            if (i < whole.size() - spare) {
                expect_error(ErrorKind::invalid_input, path, "", [&] { read_raster(path); });
            } else {
                expect_raster_or_refused(path);
            }
            std::string changed = whole;
            changed[i] = static_cast<char>(changed[i] ^ 0x55);
            write_bytes(path, changed);
            expect_raster_or_refused(path);
        }
    }
}

TEST(ImageRaster, MalformedFilesAreReadOrRefused)
{
    for (const char* folder : {"images", "exr"})
        for (const std::string& file : malformed_files(folder)) expect_raster_or_refused(file);
}

// Of a damaged JPEG there is what can be decoded, and a word about the rest.
TEST(ImageRaster, DamagedJpegsAreReadAsFarAsTheyGo)
{
    const std::string whole = jpeg(), end = "\xff\xd9"s;
    const Raster expected = raster_of("a.jpg", whole);
    EXPECT_EQ(expected.damage, "");
    std::string extra = whole;
    extra.insert(whole.size() - 2, std::string(23, '\x2a'));
    for (const std::string& bytes : {whole.substr(0, whole.size() - 2), extra}) {
        const Raster damaged = raster_of("a.jpg", bytes);
        EXPECT_NE(damaged.damage, "");
        expect_bytes(damaged, expected.channels, expected.bytes);
    }
    EXPECT_EQ(raster_of("a.jpg", whole + "trailing").damage, "");
    // Half a header is nothing, and a few bytes are no large picture.
    EXPECT_THROW(raster_of("a.jpg", whole.substr(0, 60)), Error);
    std::string large = whole.substr(0, whole.size() - 4);
    const size_t size = large.find("\x08\0\x08\0\x08"s);
    ASSERT_NE(size, std::string::npos);
    EXPECT_THROW(raster_of("a.jpg", large.replace(size, 5, "\x08\x10\0\x10\0"s)), Error);
}

}  // namespace
}  // namespace lancer
