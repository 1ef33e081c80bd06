#include "io/image/tga.h"

#include "io/temp_folder.h"

namespace lancer {
namespace {

using std::string_literals::operator""s;

struct Layout {
    int palette_count = 0, palette_bits = 0, type = 2, width = 0, height = 0, bits = 24, corner = 0x20;
};

std::string header(const Layout& l)
{
    const auto byte = [](int v) { return std::string(1, static_cast<char>(v)); };
    return "\0"s + byte(l.palette_count > 0) + byte(l.type) + "\0\0"s + byte(l.palette_count) + "\0"s +
           byte(l.palette_bits) + "\0\0\0\0"s + byte(l.width) + "\0"s + byte(l.height) + "\0"s + byte(l.bits) +
           byte(l.corner);
}

// The picture in steps of 255.
std::vector<Color> read_steps(const std::string& bytes)
{
    const TempFolder folder;
    write_bytes(folder.file("a.tga"), bytes);
    std::vector<Color> pixels = to_image(read_tga(folder.file("a.tga")), Encoding::linear).pixels;
    for (Color& c : pixels) c = {c.r * 255, c.g * 255, c.b * 255};
    return pixels;
}

const Color a = {1, 2, 3}, b = {4, 5, 6}, c = {7, 8, 9}, d = {10, 11, 12};
const std::string a_bytes = "\3\2\1", b_bytes = "\6\5\4", c_bytes = "\x9\x8\x7", d_bytes = "\xc\xb\xa";

void expect_near(const std::vector<Color>& pixels, const std::vector<Color>& expected)
{
    ASSERT_EQ(pixels.size(), expected.size());
    for (size_t i = 0; i < pixels.size(); ++i) {
        EXPECT_NEAR(pixels[i].r, expected[i].r, 1e-4) << i;
        EXPECT_NEAR(pixels[i].g, expected[i].g, 1e-4) << i;
        EXPECT_NEAR(pixels[i].b, expected[i].b, 1e-4) << i;
    }
}

TEST(Tga, AnyCornerFirst)
{
    const std::string pixels = a_bytes + b_bytes + c_bytes + d_bytes;
    expect_near(read_steps(header({.width = 2, .height = 2, .corner = 0x20}) + pixels), {a, b, c, d});
    expect_near(read_steps(header({.width = 2, .height = 2, .corner = 0x00}) + pixels), {c, d, a, b});
    expect_near(read_steps(header({.width = 2, .height = 2, .corner = 0x30}) + pixels), {b, a, d, c});
    expect_near(read_steps(header({.width = 2, .height = 2, .corner = 0x10}) + pixels), {d, c, b, a});
}

TEST(Tga, RunsCrossRows)
{
    const std::string runs = "\x82" + a_bytes + "\1"s + b_bytes + c_bytes + "\x80" + d_bytes;
    expect_near(read_steps(header({.type = 10, .width = 2, .height = 3}) + runs), {a, a, a, b, c, d});
}

TEST(Tga, PalettesGreyAndOtherDepths)
{
    const Layout palette = {.palette_count = 2, .palette_bits = 24, .type = 1, .width = 3, .height = 1, .bits = 8};
    expect_near(read_steps(header(palette) + a_bytes + b_bytes + "\1\0\1"s), {b, a, b});
    expect_near(read_steps(header({.type = 3, .width = 2, .height = 1, .bits = 8}) + "\x0a\xff"),
                {{10, 10, 10}, {255, 255, 255}});
    // Alpha of 128 is dropped and leaves the colour alone.
    expect_near(read_steps(header({.width = 1, .height = 1, .bits = 32, .corner = 0x28}) + a_bytes + "\x80"), {a});
    // Five bits each: red 31, green 16, blue 1.
    expect_near(read_steps(header({.width = 1, .height = 1, .bits = 16}) + "\x01\x7e"), {{255, 132, 8}});
}

TEST(Tga, BrokenFilesAreRefused)
{
    const TempFolder folder;
    const std::string path = folder.file("a.tga");
    const auto expect_refused = [&](const std::string& bytes, const std::string& words) {
        write_bytes(path, bytes);
        expect_error(ErrorKind::invalid_input, path, words, [&] { read_tga(path); });
    };
    const Layout palette = {.palette_count = 2, .palette_bits = 24, .type = 1, .width = 3, .height = 1, .bits = 8};
    expect_refused(header(palette) + a_bytes + b_bytes + "\1\2\1"s, "beyond its palette");
    expect_refused(header({.type = 1, .width = 1, .height = 1, .bits = 8}) + "\0"s, "unknown kind");
    expect_refused(header({.type = 4, .width = 1, .height = 1}) + a_bytes, "unknown kind");
    expect_refused(header({.width = 0, .height = 1}) + a_bytes, "0 x 1");
    expect_refused(header({.type = 10, .width = 2, .height = 1}) + "\x80" + a_bytes, "ends too early");
    expect_refused(header({.width = 100, .height = 100}) + a_bytes, "too short");
}

}  // namespace
}  // namespace lancer
