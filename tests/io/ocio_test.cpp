#include "io/image/ocio.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/image/png.h"
#include "io/temp_folder.h"

namespace lancer {
namespace {

// A configuration of our own: a display with a power and a matrix, and one with a range.
constexpr const char* config = R"(ocio_profile_version: 2
roles: {default: raw, scene_linear: lin_rec709}
displays:
  Screen:
    - !<View> {name: Power, colorspace: power}
    - !<View> {name: Raw, colorspace: raw}
  Wall:
    - !<View> {name: Swapped, colorspace: swapped}
active_displays: [Screen, Wall]
active_views: [Power, Raw, Swapped]
colorspaces:
  - !<ColorSpace> {name: lin_rec709}
  - !<ColorSpace> {name: raw, isdata: true}
  - !<ColorSpace>
    name: power
    from_scene_reference: !<ExponentTransform> {value: [2, 2, 2, 1], direction: inverse}
  - !<ColorSpace>
    name: swapped
    from_scene_reference: !<MatrixTransform> {matrix: [0, 0.5, 0, 0, 1, 0, 0, 0, 0, 0, 0.25, 0, 0, 0, 0, 1]}
)";

class Ocio : public testing::Test {
protected:
    Ocio() { write_bytes(path_, config); }
    Color seen(const char* display, const char* view, Color c) const
    {
        std::vector<Color> pixels(3, c);
        open_ocio({path_, display, view}).curve(pixels);
        EXPECT_EQ(pixels[0], pixels[2]);
        return pixels[1];
    }

    TempFolder folder_;
    std::string path_ = folder_.file("config.ocio");
};

TEST_F(Ocio, ViewsAreTheirFormulas)
{
    const Color c{0.25f, 0.5f, 0.8f}, power = seen("Screen", "Power", c);
    EXPECT_NEAR(power.r, 0.5f, 1e-6);
    EXPECT_NEAR(power.g, std::sqrt(0.5f), 1e-6);
    EXPECT_NEAR(power.b, std::sqrt(0.8f), 1e-6);
    EXPECT_EQ(seen("Wall", "Swapped", c), (Color{0.25f, 0.25f, 0.2f}));
    EXPECT_EQ(seen("Screen", "Raw", c), c);
}

TEST_F(Ocio, DefaultsAreThoseOfTheConfiguration)
{
    const OcioView view = open_ocio({path_, "", ""});
    EXPECT_EQ(view.choice, (OcioChoice{path_, "Screen", "Power"}));
    EXPECT_EQ(view.input, "lin_rec709");
    EXPECT_EQ(open_ocio({path_, "Wall", ""}).choice.view, "Swapped");
}

TEST_F(Ocio, UnknownNamesAreToldWithTheKnownOnes)
{
    expect_error(ErrorKind::usage, "", "has no display 'Scren'; it has 'Screen', 'Wall'", [&] {
        open_ocio({path_, "Scren", ""});
    });
    expect_error(ErrorKind::usage, "", "has no view 'Swapped' of the display 'Screen'; it has 'Power', 'Raw'", [&] {
        open_ocio({path_, "Screen", "Swapped"});
    });
    const std::string missing = folder_.file("none.ocio");
    expect_error(ErrorKind::invalid_input, missing, "", [&] { open_ocio({missing, "", ""}); });
    write_bytes(path_, "no configuration");
    expect_error(ErrorKind::invalid_input, path_, "", [&] { open_ocio({path_, "", ""}); });
}

// After the exposure, in place of the tone map; the file is not tagged as sRGB.
TEST_F(Ocio, BytesAreThoseOfTheView)
{
    Image image = make_image(2, 1);
    image.pixels = {{0.0625f, 0.25f, 4}, {-1, 0, 0.01f}};
    ByteOptions options{.exposure_stops = 2, .tonemap = ToneMap::clamped};
    options.curve = open_ocio({path_, "Screen", "Power"}).curve;
    EXPECT_EQ(to_bytes(image, options), (std::vector<uint8_t>{128, 255, 255, 0, 0, 51}));
    write_png(folder_.file("a.png"), image, {}, options);
    EXPECT_EQ(read_bytes(folder_.file("a.png")).find("sRGB"), std::string::npos);
}

// Run by the next test in a copy of this program that has no module beside it.
TEST(OcioModule, DISABLED_IsNotThere)
{
    expect_error(ErrorKind::failed, "lancer_ocio.so", "libopencolorio-dev", [] { open_ocio({"a.ocio", "", ""}); });
}

TEST(OcioModule, AMissingOneIsNamedWithItsRemedy)
{
    const TempFolder folder;
    std::filesystem::create_directory(folder.file("bin"));
    std::filesystem::copy_file("/proc/self/exe", folder.file("bin/io_tests"));
    const std::string command =
        folder.file("bin/io_tests") +
        " --gtest_also_run_disabled_tests --gtest_filter='*DISABLED_IsNotThere' --gtest_brief=1 >" +
        folder.file("log") + " 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << read_bytes(folder.file("log"));
    EXPECT_NE(read_bytes(folder.file("log")).find("1 test"), std::string::npos);
}

}  // namespace
}  // namespace lancer
