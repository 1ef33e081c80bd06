#include "io/image/png.h"

#include <sys/resource.h>

#include <cmath>
#include <limits>

#include "core/srgb.h"
#include "io/atomic_file.h"
#include "io/temp_folder.h"

namespace lancer {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

// The 8-bit steps of a file, through the reader that applies no curve.
std::vector<int> steps(const std::string& path)
{
    std::vector<int> result;
    for (const Color c : read_png(path, Encoding::linear).pixels) {
        for (const float v : {c.r, c.g, c.b}) result.push_back(static_cast<int>(std::lround(v * 255)));
    }
    return result;
}

TEST(Srgb, KnownValuesOfTheCurve)
{
    EXPECT_EQ(srgb_from_linear(0), 0);
    EXPECT_NEAR(srgb_from_linear(1), 1, 1e-15);
    EXPECT_NEAR(srgb_from_linear(0.0031308), 0.0404499, 1e-7);
    EXPECT_NEAR(srgb_from_linear(0.214041140), 0.5, 1e-9);
    EXPECT_NEAR(linear_from_srgb(0.5), 0.214041140, 1e-9);
    EXPECT_NEAR(linear_from_srgb(0.04), 0.0030959752, 1e-10);
    for (int i = 0; i <= 255; ++i) EXPECT_NEAR(srgb_from_linear(linear_from_srgb(i / 255.0)) * 255, i, 1e-4);
}

TEST(Png, NearestStepAndClampedEnds)
{
    const TempFolder folder;
    const std::string path = folder.file("a.png");
    Image image = make_image(3, 2);
    image.at(0, 0) = {0, 1, 0.5f};        // 0.5 is 187.516 steps
    image.at(1, 0) = {0.18f, 0.001f, 2};  // 117.67, 3.29
    image.at(2, 0) = {-1, nan, infinity};
    image.at(0, 1) = {-infinity, 0.0031308f, 1e-8f};  // 10.31
    write_png(path, image);
    const std::vector<int> expected = {0, 255, 188, 118, 3, 255, 0, 0, 255, 0, 10, 0, 0, 0, 0, 0, 0, 0};
    EXPECT_EQ(steps(path), expected);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.png"});
}

TEST(Png, EveryStepSurvivesARoundTrip)
{
    const TempFolder folder;
    const std::string path = folder.file("a.png");
    Image image = make_image(256, 1);
    for (int32_t i = 0; i < 256; ++i) {
        const float v = static_cast<float>(linear_from_srgb(i / 255.0));
        image.at(i, 0) = {v, v, v};
    }
    write_png(path, image);
    EXPECT_EQ(read_png(path).pixels, image.pixels);
}

TEST(Png, ExposureIsInStops)
{
    const TempFolder folder;
    const std::string path = folder.file("a.png");
    Image image = make_image(1, 1);
    image.at(0, 0) = {0.125f, 0.25f, 1};
    write_png(path, image, {}, {.exposure_stops = 1});
    EXPECT_EQ(steps(path), (std::vector<int>{137, 188, 255}));  // 0.25 is 136.96 steps
    write_png(path, image, {}, {.exposure_stops = -1});
    EXPECT_EQ(steps(path)[2], 188);
}

TEST(Png, DitherKeepsTheMeanAndTheEnds)
{
    const TempFolder folder;
    const std::string path = folder.file("a.png");
    Image image = make_image(200, 200);
    const float grey = static_cast<float>(linear_from_srgb(100.3 / 255));
    for (Color& c : image.pixels) c = {grey, 0, 1};
    write_png(path, image, {}, {.dither = true});
    const std::vector<int> values = steps(path);
    double sum = 0;
    for (size_t i = 0; i < values.size(); i += 3) {
        EXPECT_TRUE(values[i] == 100 || values[i] == 101);
        EXPECT_EQ(values[i + 1], 0);
        EXPECT_EQ(values[i + 2], 255);
        sum += values[i];
    }
    EXPECT_NEAR(sum / 40000, 100.3, 0.01);  // four standard deviations of a fair coin of 0.3
    const std::string bytes = read_bytes(path);
    write_png(path, image, {}, {.dither = true});
    EXPECT_EQ(read_bytes(path), bytes);
}

TEST(Png, ACropWritesItsDataWindowAndPlace)
{
    const TempFolder folder;
    const std::string path = folder.file("a.png");
    write_png(path, make_image({0, 0, 100, 80}, {10, 20, 15, 23}));
    const Image back = read_png(path);
    EXPECT_EQ(back.data, (Window{0, 0, 5, 3}));
    EXPECT_EQ(back.display, back.data);
    EXPECT_NE(read_bytes(path).find(std::string("oFFs\0\0\0\x0a\0\0\0\x14\0", 13)), std::string::npos);
}

TEST(Png, MetadataAreTextChunks)
{
    const TempFolder folder;
    const std::string path = folder.file("a.png");
    write_png(path, make_image(1, 1),
              {{"spp", int64_t{64}}, {"seconds", 1.5}, {"scene", std::string("Szene ä")}, {"none", std::string()}});
    const std::string bytes = read_bytes(path);
    EXPECT_NE(bytes.find(std::string("tEXtSoftware\0lancer", 19)), std::string::npos);
    EXPECT_NE(bytes.find(std::string("tEXtlancer:spp\0"
                                     "64",
                                     17)),
              std::string::npos);
    EXPECT_NE(bytes.find(std::string("tEXtlancer:seconds\0"
                                     "1.5",
                                     22)),
              std::string::npos);
    EXPECT_NE(bytes.find("iTXtlancer:scene"), std::string::npos);
    EXPECT_NE(bytes.find("Szene ä"), std::string::npos);
}

TEST(Png, FailedWritesLeaveTheOldFile)
{
    const TempFolder folder;
    write_bytes(folder.file("old"), "old");
    const std::string path = folder.file("old/a.png");
    expect_error(ErrorKind::failed, path, "Not a directory", [&] { write_png(path, make_image(2, 2)); });
    std::filesystem::create_symlink("/dev/full", folder.file("full.png"));
    Image noise = make_image(300, 300);
    float v = 0;
    for (Color& c : noise.pixels) c = {v = std::fmod(v * 7 + 0.37f, 1.0f), v * v, 1 - v};
    expect_error(ErrorKind::failed, folder.file("full.png"), "No space left",
                 [&] { write_png(folder.file("full.png"), noise); });
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"full.png", "old"}));
}

TEST(Png, MissingTruncatedAndChangedFiles)
{
    const TempFolder folder;
    const std::string path = folder.file("a.png");
    expect_error(ErrorKind::missing_input, path, "No such file", [&] { read_png(path); });
    Image image = make_image(20, 20);
    for (size_t i = 0; i < 400; ++i)
        image.pixels[i] = {static_cast<float>(i % 7) / 7, 0.1f, static_cast<float>(i) / 400};
    write_png(path, image);
    const std::string whole = read_bytes(path);
    for (size_t size = 0; size < whole.size(); size += size < 100 ? 1 : 31) {
        write_bytes(path, whole.substr(0, size));
        expect_error(ErrorKind::invalid_input, path, "", [&] { read_png(path); });
    }
    for (size_t i = 0; i < whole.size(); i += i < 100 ? 1 : 7) {
        std::string changed = whole;
        changed[i] = static_cast<char>(changed[i] ^ 0x55);
        write_bytes(path, changed);
        expect_read_or_refused(path, [](const std::string& p) { return read_png(p); });
    }
    for (const std::string& file : malformed_files("images")) {
        expect_read_or_refused(file, [](const std::string& p) { return read_png(p); });
    }
}

long peak_kilobytes()
{
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

TEST(Png, AChunkThatSaysItIsLongTakesNoMemory)
{
    const TempFolder folder;
    const std::string path = folder.file("a.png");
    write_png(path, make_image(2, 2));
    std::string bytes = read_bytes(path);
    const size_t text = bytes.find("tEXt");
    ASSERT_NE(text, std::string::npos);
    bytes.replace(text - 4, 4, "\x20\0\0\0", 4);  // 512 MB
    write_bytes(path, bytes);
    const long before = peak_kilobytes();
    expect_error(ErrorKind::invalid_input, path, "ends too early", [&] { read_png(path); });
    expect_error(ErrorKind::invalid_input, path, "ends too early", [&] { read_png_info(path); });
    EXPECT_LT(peak_kilobytes() - before, 100000);
}

}  // namespace
}  // namespace lancer
