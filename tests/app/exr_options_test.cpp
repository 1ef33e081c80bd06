// How EXR pictures are laid out, what their headers say of the camera, and views of OpenColorIO.
#include <cmath>

#include "app/run_program.h"
#include "io/image/png.h"
#include "io/image/read.h"

namespace lancer {
namespace {

class ExrOptionsTest : public AppTest {
protected:
    // The same render twice, once with more options.
    void render_both(const std::vector<std::string>& common, const std::vector<std::string>& more) const
    {
        std::vector<std::string> plain = common, other = common;
        plain.insert(plain.end(), {"-o", "plain.exr"});
        other.insert(other.end(), {"-o", "other.exr"});
        other.insert(other.end(), more.begin(), more.end());
        ASSERT_EQ(render(plain).code, 0);
        const Said said = render(other);
        ASSERT_EQ(said.code, 0) << said.err;
    }
};

TEST_F(ExrOptionsTest, TilesAndPartsHaveTheSamePictureForEveryCommand)
{
    for (const std::vector<std::string>& more :
         std::vector<std::vector<std::string>>{{"--exr-tiles", "16"},
                                               {"--exr-multipart"},
                                               {"--exr-tiles", "20", "--exr-multipart", "--exr-compression", "piz"}}) {
        render_both({"--aov", "all,denoise", "--background", "transparent"}, more);
        EXPECT_TRUE(same_pixels(image("plain.exr"), image("other.exr")));
        expect_words(run({"compare", "other.exr", "plain.exr"}).out, "differing_channels   0 of ");
        const Said verified = run({"verify", "other.exr"});
        EXPECT_EQ(verified.code, 0) << verified.err;
        ASSERT_EQ(run({"denoise", "plain.exr", "-o", "plain_denoised.exr"}).code, 0);
        ASSERT_EQ(run({"denoise", "other.exr", "-o", "denoised.exr"}).code, 0);
        EXPECT_TRUE(same_pixels(image("plain_denoised.exr"), image("denoised.exr")));
    }
    const Said said = run({"info", "other.exr"});
    expect_words(said.out, "tiles         20x20");
    expect_words(said.out, "parts         ");
    EXPECT_EQ(render({"--exr-tiles", "8", "-o", "a.exr"}).code, 2);
}

// What lies in a pixel, as the layer position has it, is projected into it by the matrices of the header.
TEST_F(ExrOptionsTest, TheCameraOfTheHeaderProjectsPositionsIntoTheirPixels)
{
    for (const std::vector<std::string>& more :
         std::vector<std::vector<std::string>>{{},
                                               {"--crop", "6,4,20,12"},
                                               {"-D", "camera.position=[103,1,2]", "-D", "camera.target=[100,1,-8]"},
                                               {"-D", "camera.up=[1,1,0]", "-D", "camera.fov=90"}}) {
        std::vector<std::string> arguments{"--aov", "position,depth,mask", "-o", "a.exr", "--filter", "centre"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Said said = render(arguments);
        ASSERT_EQ(said.code, 0) << said.err;
        const ExrInfo info = read_exr_info(file("a.exr"));
        ASSERT_TRUE(info.camera);
        const std::vector<std::string> names{"position.X", "position.Y", "position.Z", "depth.Z", "mask.A"};
        const auto values = read_exr_channels(file("a.exr"), names);
        const auto times = [&](const ExrCamera::Matrix& m, size_t pixel) {
            std::array<double, 4> r{};
            for (size_t j = 0; j < 4; ++j) {
                r[j] = m[3][j];
                for (size_t i = 0; i < 3; ++i) r[j] += double{values[i][pixel]} * double{m[i][j]};
            }
            return r;
        };
        size_t seen = 0;
        for (int32_t y = info.data.y0; y < info.data.y1; ++y)
            for (int32_t x = info.data.x0; x < info.data.x1; ++x) {
                const auto pixel = static_cast<size_t>((y - info.data.y0) * info.data.width() + x - info.data.x0);
                if (values[4][pixel] < 1) continue;
                ++seen;
                const auto ndc = times(info.camera->world_to_ndc, pixel),
                           c = times(info.camera->world_to_camera, pixel);
                EXPECT_NEAR(ndc[0] / ndc[3] * info.display.width(), x + 0.5, 0.01);
                EXPECT_NEAR(ndc[1] / ndc[3] * info.display.height(), y + 0.5, 0.01);
                // To the right and above the middle both coordinates are positive, and what is seen lies in front.
                EXPECT_GT(c[2], 0);
                EXPECT_GE(c[0] * (x + 0.5 - 0.5 * info.display.width()), 0);
                EXPECT_LE(c[1] * (y + 0.5 - 0.5 * info.display.height()), 0);
                EXPECT_NEAR(std::hypot(c[0], c[1], c[2]), values[3][pixel], 1e-3 * values[3][pixel]);
                EXPECT_NEAR(ndc[3], c[2], 1e-4 * c[2]);
            }
        EXPECT_GT(seen, 0u);
    }
}

TEST_F(ExrOptionsTest, TheCameraStaysThroughMergeAndDenoiseAndNotWithoutMetadata)
{
    ASSERT_EQ(render({"-o", "a.exr", "--aov", "denoise"}).code, 0);
    ASSERT_EQ(render({"--shard", "1/1", "-o", "a.lancer", "--exr-tiles", "16"}).code, 0);
    ASSERT_EQ(run({"merge", "a.lancer", "-o", "m.exr"}).code, 0);
    ASSERT_EQ(run({"denoise", "a.exr", "-o", "d.exr"}).code, 0);
    const auto camera = read_exr_info(file("a.exr")).camera;
    ASSERT_TRUE(camera);
    for (const char* name : {"m.exr", "d.exr"}) {
        const auto other = read_exr_info(file(name)).camera;
        ASSERT_TRUE(other);
        EXPECT_EQ(other->world_to_ndc, camera->world_to_ndc);
        EXPECT_EQ(other->world_to_camera, camera->world_to_camera);
    }
    EXPECT_EQ(read_exr_info(file("m.exr")).tile_width, 16u);
    ASSERT_EQ(render({"-o", "n.exr", "--no-metadata"}).code, 0);
    EXPECT_FALSE(read_exr_info(file("n.exr")).camera);
    EXPECT_EQ(read_bytes(file("a.exr")).find("capDate"), std::string::npos);
}

TEST_F(ExrOptionsTest, AcescgIsComparedAndVerified)
{
    render_both({"--aov", "normal"}, {"--color-space", "acescg"});
    EXPECT_EQ(read_exr_info(file("other.exr")).space, ColorSpace::acescg);
    const Image a = image("plain.exr"), b = image("other.exr");
    for (size_t i = 0; i < a.pixels.size(); ++i) EXPECT_NEAR(a.pixels[i].g, b.pixels[i].g, 1e-6 * (1 + a.pixels[i].g));
    EXPECT_EQ(run({"verify", "other.exr"}).code, 0);
    expect_words(run({"info", "other.exr"}).out, "color space   acescg");
    EXPECT_EQ(render({"--color-space", "acescg", "--aov", "denoise", "-o", "c.exr"}).code, 2);
}

TEST_F(ExrOptionsTest, OpenColorIoTakesThePlaceOfTheToneMap)
{
    if (!std::filesystem::exists(std::filesystem::path(LANCER_PROGRAM).parent_path() / "lancer_ocio.so"))
        GTEST_SKIP() << "built without OpenColorIO";
    // The square root, which is no tone map of ours.
    write("c.ocio",
          "ocio_profile_version: 2\nroles: {default: lin_rec709}\ndisplays:\n  D:\n"
          "    - !<View> {name: V, colorspace: root}\n    - !<View> {name: W, colorspace: lin_rec709}\n"
          "active_displays: [D]\nactive_views: [V, W]\ncolorspaces:\n  - !<ColorSpace> {name: lin_rec709}\n"
          "  - !<ColorSpace>\n    name: root\n"
          "    from_scene_reference: !<ExponentTransform> {value: 2, direction: inverse}\n");
    const Said said = render({"-o", "a.exr", "-o", "a.png", "-o", "a.ppm", "--ocio", "c.ocio", "--exposure", "1"});
    ASSERT_EQ(said.code, 0) << said.err;
    const Image light = image("a.exr");
    const auto png = read_raster(file("a.png")), ppm = read_raster(file("a.ppm"));
    EXPECT_EQ(png->bytes, ppm->bytes);
    for (size_t i = 0; i < light.pixels.size(); ++i)
        EXPECT_NEAR(png->bytes[3 * i], 255 * std::min(1.0, std::sqrt(2.0 * double{light.pixels[i].r})), 0.501);
    const Metadata metadata = read_picture_metadata(file("a.png"));
    EXPECT_EQ(text_of(metadata, "ocio_view"), "V");
    EXPECT_EQ(text_of(metadata, "tonemap"), "");
    // Merging draws by the same view, and threads do not matter.
    ASSERT_EQ(render({"--shard", "1/1", "-o", "a.lancer", "--ocio", "c.ocio", "--exposure", "1", "-t", "1"}).code, 0);
    ASSERT_EQ(run({"merge", "a.lancer", "-o", "m.png"}).code, 0);
    EXPECT_EQ(read_raster(file("m.png"))->bytes, png->bytes);
    const auto expect_fault = [&](const std::vector<std::string>& options, int code, const std::string& words) {
        const Said wrong = render(options);
        EXPECT_EQ(wrong.code, code);
        expect_words(wrong.err, words);
    };
    expect_fault({"-o", "b.png", "--ocio", "c.ocio", "--ocio-view", "X"}, 2,
                 "has no view 'X' of the display 'D'; it has 'V', 'W'");
    expect_fault({"-o", "b.png", "--ocio", "c.ocio", "--ocio-display", "E"}, 2, "has no display 'E'; it has 'D'");
    expect_fault({"-o", "b.png", "--ocio", "none.ocio"}, 65, "none.ocio");
    expect_fault({"-o", "b.png", "--ocio-view", "V"}, 2, "--ocio-view: needs --ocio CONFIG");
    expect_fault({"-o", "b.png", "--ocio", "c.ocio", "--tonemap", "agx"}, 2, "--tonemap: has no use with --ocio");
    EXPECT_FALSE(exists("b.png"));
}

}  // namespace
}  // namespace lancer
