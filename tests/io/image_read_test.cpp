#include "io/image/read.h"

#include <thread>

#include "io/image/exr.h"
#include "io/image/png.h"
#include "io/image_files.h"
#include "io/temp_folder.h"

namespace lancer {
namespace {

using std::string_literals::operator""s;

Color decoded(double r, double g, double b)
{
    const auto value = [](double step) { return static_cast<float>(linear_from_srgb(step / 255)); };
    return {value(r), value(g), value(b)};
}

void expect_steps(const TempFolder& folder, const std::string& name, const std::string& bytes)
{
    SCOPED_TRACE(name);
    write_bytes(folder.file(name), bytes);
    PictureKind kind{"", true};
    Image image = read_image(folder.file(name), Encoding::srgb, &kind);
    EXPECT_FALSE(kind.is_float);
    EXPECT_NE(kind.format, "");
    EXPECT_EQ(image.display, (Window{0, 0, 2, 2}));
    EXPECT_EQ(image.data, image.display);
    EXPECT_EQ(image.pixels, (std::vector<Color>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, decoded(188, 100, 7)}));
    image = read_image(folder.file(name), Encoding::linear);
    EXPECT_EQ(image.at(1, 1), (Color{188 / 255.0f, 100 / 255.0f, 7 / 255.0f}));
}

void expect_floats(const TempFolder& folder, const std::string& name, const std::string& bytes)
{
    SCOPED_TRACE(name);
    write_bytes(folder.file(name), bytes);
    const std::vector<Color> expected = {{1, 2, 0.5f}, {0, 0, 0}, {100, 0, 0}, {0.25f, 0.5f, 0.75f}};
    PictureKind kind;
    EXPECT_EQ(read_image(folder.file(name), Encoding::srgb, &kind).pixels, expected);
    EXPECT_TRUE(kind.is_float);
    EXPECT_EQ(read_image(folder.file(name), Encoding::linear).pixels, expected);
}

TEST(ImageRead, IntegerFormatsAreDecodedFromSrgb)
{
    const TempFolder folder;
    expect_steps(folder, "a.ppm", ppm());
    expect_steps(folder, "a.bmp", bmp());
    expect_steps(folder, "a.tga", tga(false));
    expect_steps(folder, "b.TGA", tga(true));
    expect_steps(folder, "a.tif", tiff(8, 3, 1, top + bottom));
    expect_steps(folder, "a.gif", gif());
    expect_steps(folder, "a.webp", webp());
    expect_steps(folder, "a.dds", dds());
    expect_steps(folder, "a.png", [&] {
        Image image = make_image(2, 2);
        image.pixels = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, decoded(188, 100, 7)};
        write_png(folder.file("b.png"), image);
        return read_bytes(folder.file("b.png"));
    }());
}

TEST(ImageRead, FloatFormatsAreTakenAsTheyStand)
{
    const TempFolder folder;
    expect_floats(folder, "a.hdr", hdr());
    expect_floats(folder, "a.pfm", pfm());
    expect_floats(folder, "a.tif", tiff(32, 3, 3, pack<float>({1, 2, 0.5f, 0, 0, 0, 100, 0, 0, 0.25f, 0.5f, 0.75f})));
    Image image = make_image(2, 2);
    image.pixels = {{1, 2, 0.5f}, {0, 0, 0}, {100, 0, 0}, {0.25f, 0.5f, 0.75f}};
    write_exr(folder.file("b.exr"), image);
    expect_floats(folder, "a.exr", read_bytes(folder.file("b.exr")));
}

TEST(ImageRead, GreyBecomesRgbAndSixteenBitsCount)
{
    const TempFolder folder;
    write_bytes(folder.file("a.jpg"), jpeg());
    const Image image = read_image(folder.file("a.jpg"));
    EXPECT_EQ(image.data, (Window{0, 0, 8, 8}));
    for (const Color& c : image.pixels) EXPECT_EQ(c, decoded(188, 188, 188));
    write_bytes(folder.file("a.tif"), tiff(16, 1, 1, pack<uint16_t>({0, 65535, 12345, 257 * 188})));
    const float middle = static_cast<float>(linear_from_srgb(12345 / 65535.0));
    EXPECT_EQ(read_image(folder.file("a.tif")).pixels,
              (std::vector<Color>{{0, 0, 0}, {1, 1, 1}, {middle, middle, middle}, decoded(188, 188, 188)}));
}

TEST(ImageRead, TheFirstBytesDecideNotTheName)
{
    const TempFolder folder;
    expect_steps(folder, "really_ppm.png", ppm());
    expect_steps(folder, "really_bmp.exr", bmp());
    expect_steps(folder, "really_tiff.tga", tiff(8, 3, 1, top + bottom));
    expect_floats(folder, "no_extension", hdr());
    const std::string path = folder.file("tga.jpg");
    write_bytes(path, tga(true));
    expect_error(ErrorKind::invalid_input, path, "not a picture of a known format", [&] { read_image(path); });
}

TEST(ImageRead, OtherFilesAreRefused)
{
    const TempFolder folder;
    const std::string missing = folder.file("none.jpg"), path = folder.file("a.jpg");
    expect_error(ErrorKind::missing_input, missing, "No such file", [&] { read_image(missing); });
    expect_error(ErrorKind::invalid_input, folder.path(), "is a folder, not a file",
                 [&] { read_image(folder.path()); });
    for (const std::string& bytes : {""s, "P"s, "P7\n2 2\n"s, "GIF88a\1\0\1\0"s, "a scene, not a picture"s}) {
        write_bytes(path, bytes);
        expect_error(ErrorKind::invalid_input, path, "not a picture of a known format", [&] { read_image(path); });
    }
    write_bytes(path, "\xff\xd8\xff\xe0 nothing but a beginning \xff\xd9");
    expect_error(ErrorKind::invalid_input, path, "not a valid jpeg file", [&] { read_image(path); });
}

TEST(ImageRead, AbsurdSizesAreRefusedBeforeAllocation)
{
    const TempFolder folder;
    const auto expect_refused = [&](const std::string& name, const std::string& bytes) {
        SCOPED_TRACE(name);
        write_bytes(folder.file(name), bytes);
        expect_error(ErrorKind::invalid_input, folder.file(name), "", [&] { read_image(folder.file(name)); });
    };
    expect_refused("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 100000 +X 100000\n\1\1\1\1"s);
    expect_refused("b.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16000 +X 16000\n\1\1\1\1"s);
    expect_refused("a.ppm", "P6\n1000000000 1000000000\n255\n123"s);
    expect_refused("b.ppm", "P6\n16000 16000\n255\n123"s);
    expect_refused("c.ppm", "P6\n3 -5\n255\n123"s);
    expect_refused("a.pfm", "PF\n16000 16000\n-1.0\n1234"s);
    expect_refused("a.bmp", bmp().replace(18, 8, pack<int32_t>({2000000000, -2000000000})));
    expect_refused("b.bmp", bmp().replace(30, 1, "\1"));
    expect_refused("a.tga", tga(true).replace(12, 4, pack<uint16_t>({65535, 65535})));
    expect_refused("a.gif", gif().replace(6, 4, pack<uint16_t>({65535, 65535})));
    expect_refused("a.webp", webp().replace(21, 4, "\xff\xff\xff\x0f"));
    expect_refused("a.dds", dds().replace(12, 8, pack<uint32_t>({16000, 16000})));
    // OpenImageIO's decoder divides by the alpha of these, which may be 0.
    expect_refused("b.dds", dds().replace(80, 8, pack<uint32_t>({4}) + "DXT2"));
}

// Cut anywhere, a picture is refused, not filled up with grey.
TEST(ImageRead, TruncatedFilesAreRefused)
{
    const TempFolder folder;
    const std::pair<const char*, std::string> files[] = {
        {"a.ppm", ppm()},  {"a.bmp", bmp()}, {"a.tga", tga(true)}, {"a.tif", tiff(8, 3, 1, top + bottom)},
        {"a.jpg", jpeg()}, {"a.hdr", hdr()}, {"a.pfm", pfm()},     {"a.webp", webp()},
        {"a.dds", dds()}};
    for (const auto& [name, whole] : files) {
        SCOPED_TRACE(name);
        for (size_t size = 0; size < whole.size(); ++size) {
            SCOPED_TRACE(size);
            const std::string path = folder.file(name);
            write_bytes(path, whole.substr(0, size));
            expect_error(ErrorKind::invalid_input, path, "", [&] { read_image(path); });
        }
    }
}

TEST(ImageRead, ChangedBytesNeverCrash)
{
    const TempFolder folder;
    const std::pair<const char*, std::string> files[] = {
        {"a.ppm", ppm()},  {"a.bmp", bmp()}, {"a.tga", tga(true)}, {"a.tif", tiff(8, 3, 1, top + bottom)},
        {"a.jpg", jpeg()}, {"a.hdr", hdr()}, {"a.pfm", pfm()},     {"a.webp", webp()},
        {"a.dds", dds()},  {"a.gif", gif()}};
    for (const auto& [name, whole] : files) {
        for (size_t i = 0; i < whole.size(); ++i) {
            for (const char value : {'\x7f', '\xff'}) {
                std::string changed = whole;
                changed[i] = value;
                write_bytes(folder.file(name), changed);
                expect_read_or_refused(folder.file(name), [](const std::string& p) { return read_image(p); });
            }
        }
    }
}

TEST(ImageRead, ASegmentOfAJpegTooShortForItsLengthIsEmpty)
{
    const TempFolder folder;
    const std::string path = folder.file("a.jpg");
    write_bytes(path, jpeg().insert(2, "\xff\xe1\0\1"s));
    EXPECT_EQ(read_raster(path)->width, 8u);
    EXPECT_EQ(read_raster_header(path).width, 8u);
}

TEST(ImageRead, SeveralThreadsMayRead)
{
    const TempFolder folder;
    write_bytes(folder.file("a.ppm"), ppm());
    std::vector<std::thread> threads;
    std::vector<Image> images(4);
    for (Image& image : images) threads.emplace_back([&] { image = read_image(folder.file("a.ppm")); });
    for (std::thread& t : threads) t.join();
    for (const Image& image : images) EXPECT_EQ(image.at(1, 1), decoded(188, 100, 7));
}

// Run by the next test in a copy of this program that has no module beside it.
TEST(ImageRead, DISABLED_InAFolderWithoutTheModule)
{
    const TempFolder folder;
    write_bytes(folder.file("a.ppm"), ppm());
    write_png(folder.file("a.png"), make_image(2, 2));
    write_bytes(folder.file("a.jpg"), jpeg());
    EXPECT_NO_THROW(read_image(folder.file("a.png")));
    EXPECT_NO_THROW(read_image(folder.file("a.jpg")));
    expect_error(ErrorKind::failed, "lancer_oiio.so", "libopenimageio-dev", [&] { read_image(folder.file("a.ppm")); });
}

TEST(ImageRead, AMissingModuleIsNamedWithItsRemedy)
{
    const TempFolder folder;
    std::filesystem::create_directory(folder.file("bin"));
    const std::string program = folder.file("bin/io_tests");
    std::filesystem::copy_file("/proc/self/exe", program);
    const std::string command =
        program +
        " --gtest_also_run_disabled_tests --gtest_filter='*DISABLED_InAFolderWithoutTheModule' --gtest_brief=1 >" +
        folder.file("log") + " 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << read_bytes(folder.file("log"));
    EXPECT_NE(read_bytes(folder.file("log")).find("1 test"), std::string::npos);
}

}  // namespace
}  // namespace lancer
