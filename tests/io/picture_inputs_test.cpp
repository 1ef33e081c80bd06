// One picture in several formats gives the same texels: alpha in colours, gamma, orientation, names of channels.
#include <array>
#include <cmath>
#include <cstring>

#include "io/image/exr_channels.h"
#include "io/image/png.h"
#include "io/image/read.h"
#include "io/image_files.h"
#include "io/temp_folder.h"
#include "materials/textures/texture.h"

namespace lancer {
namespace {

Raster raster_of(const std::string& bytes)
{
    const TempFolder folder;
    write_bytes(folder.file("a"), bytes);
    const auto raster = read_raster(folder.file("a"));
    // What the header promises is what is read.
    const RasterHeader header = read_raster_header(folder.file("a"));
    EXPECT_EQ(header.width, raster->width);
    EXPECT_EQ(header.height, raster->height);
    EXPECT_EQ(header.channels, raster->channels);
    EXPECT_EQ(header.bytes(), raster->bytes.size() + raster->floats.size() * sizeof(float));
    EXPECT_EQ(header.is_float(), raster->is_float);
    EXPECT_EQ(header.exponent, raster->exponent);
    return *raster;
}

// The texels of the finest level as a texture shows them, rows from the top.
std::vector<Color> texels(const Raster& raster, const ImageUse& use)
{
    const ImageTexture texture(raster, use);
    std::vector<Color> result;
    for (uint32_t y = 0; y < raster.height; ++y)
        for (uint32_t x = 0; x < raster.width; ++x)
            result.push_back(texture.eval({(x + 0.5) / raster.width, 1 - (y + 0.5) / raster.height}, {}));
    return result;
}

void expect_near(const std::vector<Color>& a, const std::vector<Color>& b, float relative)
{
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i)
        for (const auto part : {&Color::r, &Color::g, &Color::b})
            EXPECT_NEAR(a[i].*part, b[i].*part, relative * std::abs(b[i].*part) + 1e-7f) << i;
}

// Four texels, alpha 1, 0.2, 0.6 and 0.4: colours are multiples of 5 and 255, so that products with alpha are steps.
constexpr std::array<std::array<uint8_t, 4>, 4> stored_texels{
    {{255, 40, 5, 255}, {100, 200, 15, 51}, {50, 255, 125, 153}, {10, 20, 250, 102}}};

std::string with_alpha(bool multiplied)
{
    std::string bytes;
    for (const auto& texel : stored_texels) {
        for (size_t c = 0; c < 3; ++c) bytes += static_cast<char>(multiplied ? texel[c] * texel[3] / 255 : texel[c]);
        bytes += static_cast<char>(texel[3]);
    }
    return bytes;
}

// Linear, as floats.
std::string floats_with_alpha(bool multiplied)
{
    std::string bytes;
    for (const auto& texel : stored_texels) {
        const auto alpha = static_cast<float>(texel[3] / 255.0);
        for (size_t c = 0; c < 3; ++c)
            bytes += pack<float>({static_cast<float>(linear_from_srgb(texel[c] / 255.0)) * (multiplied ? alpha : 1)});
        bytes += pack<float>({alpha});
    }
    return bytes;
}

TEST(PictureInputs, AlphaIsDividedOutOfColoursInEveryFormat)
{
    const std::string straight = with_alpha(false);
    const std::string of_png = png(2, 2, 8, 6, "\0"s + straight.substr(0, 8) + "\0"s + straight.substr(8));
    const std::string numbers = floats_with_alpha(true);
    const auto of_exr = [&](int32_t x, int32_t y, char channel, int32_t) {
        const size_t c = channel == 'A' ? 3 : channel == 'B' ? 2 : channel == 'G' ? 1 : 0;
        float value = 0;
        std::memcpy(&value, &numbers[(static_cast<size_t>(y * 2 + x) * 4 + c) * sizeof value], sizeof value);
        return value;
    };
    const std::pair<const char*, std::string> files[] = {
        {"png", of_png},
        {"exr", exr({}, of_exr)},
        {"tiff, 8 bits, associated", tiff(8, 4, 1, with_alpha(true), 1)},
        {"tiff, 8 bits", tiff(8, 4, 1, straight, 2)},
        {"tiff, floats, associated", tiff(32, 4, 3, numbers, 1)},
        {"tiff, floats", tiff(32, 4, 3, floats_with_alpha(false), 2)}};
    std::vector<Color> colors, opacity;
    for (const auto& texel : stored_texels) {
        const auto linear = [&](size_t c) { return static_cast<float>(linear_from_srgb(texel[c] / 255.0)); };
        const auto alpha = static_cast<float>(texel[3] / 255.0);
        colors.push_back({linear(0), linear(1), linear(2)});
        opacity.push_back({alpha, alpha, alpha});
    }
    for (const auto& [name, bytes] : files) {
        SCOPED_TRACE(name);
        const Raster raster = raster_of(bytes);
        EXPECT_EQ(raster.channels, 4u);
        expect_near(texels(raster, {}), colors, 3e-7f);
        expect_near(texels(raster, {.encoding = Encoding::linear, .channel = Channel::automatic}), opacity, 1e-7f);
    }
}

TEST(PictureInputs, WhereAlphaIsZeroColoursStay)
{
    Raster r{.width = 2, .height = 1, .channels = 4, .bytes = {10, 20, 30, 0, 10, 20, 30, 20}, .floats = {}};
    divide_by_alpha(r);
    EXPECT_EQ(r.bytes, (std::vector<uint8_t>{10, 20, 30, 0, 128, 255, 255, 20}));
    Raster f{.width = 3, .height = 1, .channels = 2, .bytes = {}, .floats = {3, 0, 3, 0.5f, 3, -1}, .is_float = true};
    divide_by_alpha(f);
    EXPECT_EQ(f.floats, (std::vector<float>{3, 0, 6, 0.5f, 3, -1}));
}

TEST(PictureInputs, WebpAndGifKeepTheirAlpha)
{
    EXPECT_EQ(raster_of(gif()).channels, 4u);
    EXPECT_EQ(raster_of(dds()).channels, 4u);
    EXPECT_EQ(raster_of(webp()).channels, 3u);
    // (255, 0, 0) with alpha 128 first, without loss, by cwebp 1.2.4.
    const std::string half =
        "RIFF\x38\0\0\0WEBPVP8L\x2b\0\0\0\x2f\x01\x40\0\x10\x1f\x20\x10\x20\x78\xf5\xbf\x60\x43\x20\x90\xe4\xef\x34\xdb"
        "\x42\x02\x82\xe4\xff\x62\x02\x01\xc2\xba\x26\x81\x02\x3f\x71\xac\xc2\x0d\x18\x22\xfa\x1f\x02\0"s;
    const Raster raster = raster_of(half);
    ASSERT_EQ(raster.channels, 4u);
    EXPECT_EQ((std::vector<uint8_t>(raster.bytes.begin(), raster.bytes.begin() + 4)),
              (std::vector<uint8_t>{255, 0, 0, 128}));
}

// A picture of 3 x 2 whose texel (x, y) has 1 + x + 4 y in red.
std::string radiance(const std::string& lines, const std::string& size, bool columns_first, bool from_right,
                     bool from_bottom)
{
    std::string file = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n" + lines + "\n" + size + "\n";
    const int outer = columns_first ? 3 : 2, inner = columns_first ? 2 : 3;
    for (int i = 0; i < outer; ++i)
        for (int k = 0; k < inner; ++k) {
            int x = columns_first ? i : k, y = columns_first ? k : i;
            if (from_right) x = 2 - x;
            if (from_bottom) y = 1 - y;
            // The mantissa of 1 is 128 with the exponent 129; 8 stand for 1 with 132.
            file += static_cast<char>(16 * (1 + x + 4 * y)) + "\x08\x10"s + static_cast<char>(132);
        }
    return file;
}

TEST(PictureInputs, RadianceInAllEightOrientations)
{
    const std::vector<float> reds{1, 2, 3, 5, 6, 7};
    int seen = 0;
    for (const bool columns_first : {false, true})
        for (const bool from_right : {false, true})
            for (const bool from_bottom : {false, true}) {
                const std::string x = std::string(from_right ? "-" : "+") + "X 3",
                                  y = std::string(from_bottom ? "+" : "-") + "Y 2",
                                  size = columns_first ? x + " " + y : y + " " + x;
                SCOPED_TRACE(size);
                const Raster r = raster_of(radiance("", size, columns_first, from_right, from_bottom));
                EXPECT_EQ(r.width, 3u);
                EXPECT_EQ(r.height, 2u);
                ASSERT_EQ(r.floats.size(), 18u);
                for (size_t i = 0; i < reds.size(); ++i) {
                    EXPECT_EQ(r.floats[3 * i], reds[i]) << i;
                    EXPECT_EQ(r.floats[3 * i + 1], 0.5f) << i;
                    EXPECT_EQ(r.floats[3 * i + 2], 1) << i;
                }
                ++seen;
            }
    EXPECT_EQ(seen, 8);
}

TEST(PictureInputs, RadianceExposureAndColourCorrectionAreTakenBack)
{
    const auto first = [](const std::string& lines) {
        const Raster r = raster_of(radiance(lines, "-Y 2 +X 3", false, false, false));
        return Color{r.floats[0], r.floats[1], r.floats[2]};
    };
    EXPECT_EQ(first(""), (Color{1, 0.5f, 1}));
    EXPECT_EQ(first("EXPOSURE=4\n"), (Color{0.25f, 0.125f, 0.25f}));
    EXPECT_EQ(first("EXPOSURE= 4\nSOFTWARE=none\nEXPOSURE=0.5\n"), (Color{0.5f, 0.25f, 0.5f}));
    EXPECT_EQ(first("COLORCORR=2 0.5 4\nEXPOSURE=2\n"), (Color{0.25f, 0.5f, 0.125f}));
    for (const char* lines : {"EXPOSURE=0\n", "EXPOSURE=nan\n", "EXPOSURE=dark\n", "COLORCORR=1 2\n"})
        EXPECT_THROW(first(lines), Error) << lines;
    std::string xyz = hdr();
    xyz.replace(xyz.find("rgbe"), 4, "xyze");
    EXPECT_THROW(raster_of(xyz), Error);
}

using Names = std::vector<std::string>;

void expect_channels(const std::vector<Names>& parts, size_t part, const Names& colors, const std::string& alpha)
{
    const auto found = choose_exr_channels(parts);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->part, part);
    EXPECT_EQ(found->colors, colors);
    EXPECT_EQ(found->alpha, alpha);
}

TEST(PictureInputs, ChannelsOfExrByAnyName)
{
    expect_channels({{"A", "B", "G", "R", "Z"}}, 0, {"R", "G", "B"}, "A");
    expect_channels({{"A", "Y"}}, 0, {"Y"}, "A");
    expect_channels({{"roughness"}}, 0, {"roughness"}, "");
    expect_channels({{"A"}}, 0, {"A"}, "");
    expect_channels({{"A", "height"}}, 0, {"height"}, "A");
    expect_channels({{"G", "R"}}, 0, {"R", "G", ""}, "");
    expect_channels({{"U", "V"}}, 0, {"U", "V", ""}, "");
    expect_channels({{"X", "Y", "Z"}}, 0, {"X", "Y", "Z"}, "");
    expect_channels({{"diffuse.B", "diffuse.G", "diffuse.R"}}, 0, {"diffuse.R", "diffuse.G", "diffuse.B"}, "");
    expect_channels({{"b", "g", "r"}}, 0, {"r", "g", "b"}, "");
    // The layer without a name, the whole picture among passes, the first one; colours before numbers.
    expect_channels({{"B", "G", "R", "a.B", "a.G", "a.R"}}, 0, {"R", "G", "B"}, "");
    expect_channels({{"V.AO.B", "V.AO.G", "V.AO.R", "V.Combined.A", "V.Combined.B", "V.Combined.G", "V.Combined.R"}}, 0,
                    {"V.Combined.R", "V.Combined.G", "V.Combined.B"}, "V.Combined.A");
    expect_channels({{"Z", "b.B", "b.G", "b.R"}}, 0, {"b.R", "b.G", "b.B"}, "");
    expect_channels({{}, {"depth.Z"}, {"B", "G", "R"}}, 2, {"R", "G", "B"}, "");
    EXPECT_FALSE(choose_exr_channels({{"BY", "RY", "Y"}}));
    EXPECT_FALSE(choose_exr_channels({{"id", "k", "m", "n"}}));
    EXPECT_FALSE(choose_exr_channels({{}}));
}

TEST(PictureInputs, LayersAndPartsOfExrAreRead)
{
    const auto value = [](size_t part, size_t channel, int x) {
        return static_cast<float>(100 * part + 10 * channel + static_cast<size_t>(x));
    };
    EXPECT_EQ(raster_of(exr_of({{"rough"}}, value)).floats, (std::vector<float>{0, 1}));
    const Raster two = raster_of(exr_of({{"G", "R"}}, value));
    EXPECT_EQ(two.channels, 3u);
    EXPECT_EQ(two.floats, (std::vector<float>{10, 0, 0, 11, 1, 0}));
    EXPECT_EQ(raster_of(exr_of({{"diffuse.B", "diffuse.G", "diffuse.R"}}, value)).floats,
              (std::vector<float>{20, 10, 0, 21, 11, 1}));
    EXPECT_EQ(raster_of(exr_of({{"depth.Z"}, {"B", "G", "R"}}, value)).floats,
              (std::vector<float>{120, 110, 100, 121, 111, 101}));
    const TempFolder folder;
    const std::string path = folder.file("a.exr");
    write_bytes(path, exr_of({{"k", "l", "m", "n"}}, value));
    expect_error(ErrorKind::invalid_input, path, "the file has k, l, m, n", [&] { read_raster(path); });
}

// A header that announces more than the file can hold costs nothing, in the second part too.
TEST(PictureInputs, PartsOfExrAreCheckedBeforeTheyAreRead)
{
    const auto value = [](size_t, size_t, int) { return 0.0f; };
    const std::string whole = exr_of({{"Y"}, {"Y"}}, value);
    const TempFolder folder;
    const std::string path = folder.file("a.exr");
    const size_t window = whole.rfind("dataWindow") + std::strlen("dataWindow") + 1 + std::strlen("box2i") + 1 + 4;
    const size_t count = whole.rfind("chunkCount") + std::strlen("chunkCount") + 1 + std::strlen("int") + 1 + 4;
    for (const auto& [place, bytes] :
         {std::pair(window, pack<int32_t>({0, 0, 50000, 50000})), std::pair(count, pack<int32_t>({2000000000}))}) {
        write_bytes(path, std::string(whole).replace(place, bytes.size(), bytes));
        expect_error(ErrorKind::invalid_input, path, "", [&] { read_raster(path); });
    }
    constexpr size_t second = 20;  // bytes of pixels of the second part, which are not read
    for (size_t size = 0; size < whole.size() - second; size += 7) {
        write_bytes(path, whole.substr(0, size));
        EXPECT_THROW(read_raster(path), Error) << size;
    }
}

TEST(PictureInputs, PngsOfLancerComeBackAsTheyWere)
{
    const TempFolder folder;
    const std::string path = folder.file("a.png");
    Image image = make_image(256, 1);
    for (int32_t i = 0; i < 256; ++i) image.at(i, 0) = Color{1, 1, 1} * (static_cast<float>(i) / 255.0f);
    write_png(path, image, {}, {.tonemap = ToneMap::none});
    EXPECT_EQ(texels(*read_raster(path), {}), image.pixels);
    EXPECT_EQ(read_image(path).pixels, image.pixels);
    for (int32_t i = 0; i < 256; ++i) {
        const auto linear = static_cast<float>(linear_from_srgb(i / 255.0));
        image.at(i, 0) = {linear, linear, linear};
    }
    write_png(path, image);
    EXPECT_EQ(texels(*read_raster(path), {}), image.pixels);
}

TEST(PictureInputs, GammaOfPngs)
{
    const auto texel_of = [](const std::string& chunks, Encoding encoding) {
        const Raster r = raster_of(png(1, 1, 8, 0, "\0\x80"s, chunks));
        return texels(r, {.encoding = encoding})[0].r;
    };
    const auto gamma = [](uint32_t g) { return png_chunk("gAMA", pack_big(g)); };
    const double v = 128 / 255.0;
    const auto srgb = static_cast<float>(linear_from_srgb(v)), linear = static_cast<float>(v);
    EXPECT_EQ(texel_of("", Encoding::of_file), srgb);
    EXPECT_EQ(texel_of(gamma(100000), Encoding::of_file), linear);
    EXPECT_NEAR(texel_of(gamma(55556), Encoding::of_file), std::pow(v, 1 / 0.55556), 1e-6);
    // What many programs write beside or in place of an sRGB chunk means sRGB.
    EXPECT_EQ(texel_of(gamma(45455), Encoding::of_file), srgb);
    EXPECT_EQ(texel_of(png_chunk("sRGB", "\0"s) + gamma(100000), Encoding::of_file), srgb);
    EXPECT_EQ(texel_of(gamma(0), Encoding::of_file), srgb);
    // A scene file that says how a picture is encoded knows better.
    EXPECT_EQ(texel_of(gamma(100000), Encoding::srgb), srgb);
    EXPECT_EQ(texel_of(gamma(55556), Encoding::linear), linear);
    // 16 bits, and the luminance of colours.
    const Raster fine = raster_of(png(1, 1, 16, 0, "\0\x80\x00"s, gamma(55556)));
    EXPECT_NEAR(texels(fine, {})[0].r, std::pow(32768 / 65535.0, 1 / 0.55556), 1e-6);
    const Raster grey = raster_of(png(1, 1, 8, 2, "\0\x80\x80\x80"s, gamma(55556)));
    EXPECT_NEAR(texels(grey, {.channel = Channel::luminance})[0].r, std::pow(v, 1 / 0.55556), 1e-6);
}

}  // namespace
}  // namespace lancer
