#include "io/image/exr.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "io/atomic_file.h"
#include "io/same_bits.h"
#include "io/temp_folder.h"

namespace lancer {
namespace {

using std::string_literals::operator""s;

// Values over the whole range of floats, no two alike.
Image test_image(const Window& display, const Window& data)
{
    Image image = make_image(display, data);
    uint32_t h = 1;
    const auto next = [&] {
        h = h * 1664525u + 1013904223u;
        return std::ldexp(static_cast<float>(h >> 8), static_cast<int>(h & 63) - 50);
    };
    for (Color& c : image.pixels) c = {next(), -next(), next()};
    return image;
}

TEST(Exr, FloatsComeBackBitByBit)
{
    const TempFolder folder;
    const std::string path = folder.file("a.exr");
    Image image = test_image({0, 0, 37, 41}, {0, 0, 37, 41});
    image.at(3, 4) = {std::numeric_limits<float>::infinity(), -0.0f, std::numeric_limits<float>::quiet_NaN()};
    image.at(5, 6) = {std::numeric_limits<float>::denorm_min(), std::numeric_limits<float>::max(), 1e-30f};
    write_exr(path, image);
    const Image back = read_exr(path);
    EXPECT_EQ(back.display, image.display);
    EXPECT_EQ(back.data, image.data);
    EXPECT_TRUE(same_bits(back, image));
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.exr"});
}

TEST(Exr, ACropKeepsBothWindows)
{
    const TempFolder folder;
    for (const Window data : {Window{10, 20, 13, 600}, Window{-5, -7, 40, 2}, Window{99, 0, 100, 1}}) {
        const Image image = test_image({0, 0, 100, 800}, data);
        write_exr(folder.file("a.exr"), image);
        const Image back = read_exr(folder.file("a.exr"));
        EXPECT_EQ(back.display, image.display);
        EXPECT_EQ(back.data, data);
        EXPECT_TRUE(same_bits(back, image));
    }
}

TEST(Exr, HalfRoundsAndNeverOverflows)
{
    const TempFolder folder;
    const std::string path = folder.file("a.exr");
    Image image = make_image(2, 1);
    image.at(0, 0) = {1.0f / 3, 65504, -65504};
    image.at(1, 0) = {std::numeric_limits<float>::infinity(), 0.5f, 0};
    write_exr(path, image, {}, {.half = true});
    Image back = read_exr(path);
    EXPECT_EQ(back.at(0, 0), (Color{0.333251953125f, 65504, -65504}));
    EXPECT_EQ(back.at(1, 0), image.at(1, 0));
    image.at(1, 0).g = 65505;
    write_exr(path, image, {}, {.half = true});
    back = read_exr(path);
    EXPECT_TRUE(same_bits(back, image));
}

TEST(Exr, MetadataComeBack)
{
    const TempFolder folder;
    const std::string path = folder.file("a.exr");
    const Metadata metadata = {
        {"big", int64_t{1} << 40}, {"scene", std::string("Szene ä")}, {"seconds", 0.1}, {"spp", int64_t{-64}}};
    write_exr(path, make_image(3, 3), metadata);
    Metadata back;
    read_exr(path, &back);
    const Metadata expected = {{"big", std::string("1099511627776")},
                               {"scene", std::string("Szene ä")},
                               {"seconds", 0.1},
                               {"spp", int64_t{-64}}};
    EXPECT_EQ(back, expected);
}

TEST(Exr, FailedWritesLeaveTheOldFile)
{
    const TempFolder folder;
    write_bytes(folder.file("old"), "old");
    const std::string path = folder.file("old/a.exr");
    expect_error(ErrorKind::failed, path, "Not a directory", [&] { write_exr(path, make_image(2, 2)); });
    std::filesystem::create_symlink("/dev/full", folder.file("full.exr"));
    expect_error(ErrorKind::failed, folder.file("full.exr"), "No space left", [&] {
        write_exr(folder.file("full.exr"), test_image({0, 0, 500, 500}, {0, 0, 500, 500}));
    });
    expect_error(ErrorKind::failed, folder.file("none.exr"), "without pixels",
                 [&] { write_exr(folder.file("none.exr"), Image{}); });
    EXPECT_EQ(read_bytes(folder.file("old")), "old");
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"full.exr", "old"}));
}

TEST(Exr, MissingFileAndFolder)
{
    const TempFolder folder;
    const std::string path = folder.file("none.exr");
    expect_error(ErrorKind::missing_input, path, "No such file", [&] { read_exr(path); });
    expect_error(ErrorKind::invalid_input, folder.path(), "is a folder, not a file", [&] { read_exr(folder.path()); });
}

// Every file cut short, at each byte of the header and some of the rest, is refused.
TEST(Exr, TruncatedFilesAreRefused)
{
    const TempFolder folder;
    const std::string path = folder.file("a.exr");
    write_exr(path, test_image({0, 0, 20, 50}, {0, 0, 20, 50}), {{"spp", int64_t{4}}});
    const std::string whole = read_bytes(path);
    for (size_t size = 0; size < whole.size(); size += size < 700 ? 1 : 197) {
        write_bytes(path, whole.substr(0, size));
        expect_error(ErrorKind::invalid_input, path, "", [&] { read_exr(path); });
    }
}

// Any byte wrong: a picture or an error, never a crash. Run under the address sanitizer this says more.
TEST(Exr, ChangedBytesNeverCrash)
{
    const TempFolder folder;
    const std::string path = folder.file("a.exr");
    write_exr(path, test_image({0, 0, 9, 40}, {0, 0, 9, 40}), {{"spp", int64_t{4}}});
    const std::string whole = read_bytes(path);
    for (size_t i = 0; i < whole.size(); i += i < 700 ? 1 : 37) {
        for (const char value : {'\x7f', '\xff'}) {
            std::string changed = whole;
            changed[i] = value;
            write_bytes(path, changed);
            expect_read_or_refused(path, [](const std::string& p) { return read_exr(p); });
        }
    }
}

TEST(Exr, AbsurdSizesAreRefusedBeforeAllocation)
{
    const TempFolder folder;
    const std::string path = folder.file("a.exr");
    write_exr(path, make_image(4, 4));
    const std::string whole = read_bytes(path);
    const size_t window = whole.find("dataWindow") + std::strlen("dataWindow") + 1 + std::strlen("box2i") + 1 + 4;
    const auto with_window = [&](int32_t x0, int32_t y0, int32_t x1, int32_t y1) {
        const int32_t box[] = {x0, y0, x1, y1};
        std::string changed = whole;
        std::memcpy(changed.data() + window, box, sizeof box);
        write_bytes(path, changed);
    };
    with_window(0, 0, 30000, 30000);
    expect_error(ErrorKind::invalid_input, path, "too large: 30001 x 30001", [&] { read_exr(path); });
    with_window(std::numeric_limits<int32_t>::min(), 0, std::numeric_limits<int32_t>::max(), 0);
    expect_error(ErrorKind::invalid_input, path, "too large", [&] { read_exr(path); });
    with_window(0, 0, 3, 60000);
    expect_error(ErrorKind::invalid_input, path, "too short", [&] { read_exr(path); });
    with_window(3, 0, 0, 3);
    expect_error(ErrorKind::invalid_input, path, "-2 x 4", [&] { read_exr(path); });
}

// The library reads as many bytes as a type has and takes the rest for another attribute, of any size.
TEST(Exr, AttributesAreAsLongAsTheirTypes)
{
    const TempFolder folder;
    const std::string path = folder.file("a.exr");
    write_exr(path, make_image(4, 4));
    const std::string whole = read_bytes(path);
    const std::string huge = "a\0b\0\0\0\0\x70"s;  // an attribute of a type that is not known, and its size
    for (const std::string& start :
         {"channels\0chlist\0"s, "compression\0compression\0"s, "lineOrder\0lineOrder\0"s, "pixelAspectRatio\0float\0"s,
          "chromaticities\0chromaticities\0"s, "screenWindowCenter\0v2f\0"s}) {
        SCOPED_TRACE(start);
        std::string changed = whole;
        const size_t at = whole.find(start) + start.size();
        int32_t size = 0;
        std::memcpy(&size, &changed[at], sizeof size);
        changed.insert(at + sizeof size + static_cast<size_t>(size), huge);
        size += static_cast<int32_t>(huge.size());
        std::memcpy(&changed[at], &size, sizeof size);
        write_bytes(path, changed);
        expect_error(ErrorKind::invalid_input, path, "is not as long as its type", [&] { read_exr(path); });
    }
}

TEST(Exr, MalformedFilesAreReadOrRefused)
{
    for (const std::string& path : malformed_files("exr")) {
        SCOPED_TRACE(path);
        expect_read_or_refused(path, [](const std::string& p) { return read_exr(p); });
    }
}

}  // namespace
}  // namespace lancer
