// The formats that pictures are written in, by name or by --format, into files and pipes.
#include <sys/stat.h>

#include <thread>

#include "app/run_program.h"
#include "io/image/read.h"

namespace lancer {
namespace {

class Formats : public AppTest {};

constexpr const char* all_formats[] = {"exr", "png", "ppm", "jpg", "hdr"};

TEST_F(Formats, ANameWithoutEndingHasTheBytesOfOneWithIt)
{
    for (const std::string format : all_formats) {
        ASSERT_EQ(render({"-o", "a." + format, "--reproducible"}).code, 0);
        ASSERT_EQ(render({"-o", "a", "--format", format, "--reproducible"}).code, 0);
        EXPECT_EQ(read_bytes(file("a")), read_bytes(file("a." + format))) << format;
    }
    ASSERT_EQ(render({"-o", "b.jpeg", "--reproducible"}).code, 0);
    EXPECT_EQ(read_bytes(file("b.jpeg")), read_bytes(file("a.jpg")));
}

TEST_F(Formats, ThePictureIsAllThatIsOnTheStandardOutput)
{
    for (const std::string format : all_formats) {
        ASSERT_EQ(render({"-o", "a." + format, "--reproducible"}).code, 0);
        const std::string command = std::string(LANCER_PROGRAM) +
                                    " scene.toml --size 24x16 -s 4 --reproducible -o - -o b.png --format " + format +
                                    " | cat > piped";
        ASSERT_EQ(std::system(("cd '" + folder_.path() + "' && " + command + " 2>/dev/null").c_str()), 0);
        EXPECT_EQ(read_bytes(file("piped")), read_bytes(file("a." + format))) << format;
    }
}

TEST_F(Formats, APipeWithANameGetsAPicture)
{
    ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
    std::string got;
    std::thread reader([&] { got = read_bytes(file("pipe")); });
    EXPECT_EQ(render({"-o", "pipe", "--format", "exr", "--reproducible"}).code, 0);
    reader.join();
    ASSERT_EQ(render({"-o", "a.exr", "--reproducible"}).code, 0);
    EXPECT_EQ(got, read_bytes(file("a.exr")));
}

TEST_F(Formats, WrongNamesAreToldWithTheFormats)
{
    const auto expect_usage = [&](const std::vector<std::string>& options, const std::string& words) {
        const Said said = render(options);
        EXPECT_EQ(said.code, 2);
        expect_words(said.err, words);
    };
    expect_usage({"-o", "a"}, "'a' must end in .exr, .png, .ppm, .jpg, .jpeg or .hdr, or --format say what it is");
    expect_usage({"-o", "-"}, "'-' must end in .exr");
    expect_usage({"-o", "a.tif", "--format", "exr"}, "'a.tif' must end in .exr, .png, .ppm, .jpg, .jpeg or .hdr");
    expect_usage({"-o", "a", "--format", "gif"}, "--format: unknown name 'gif'; known: exr, png, ppm, jpg, hdr");
    expect_usage({"-o", "a.jpg", "--jpeg-quality", "0"}, "--jpeg-quality: '0' is not a whole number from 1 to 100");
    for (const char* name : {"a.jpg", "a.hdr"})
        expect_usage({"-o", name, "--background", "transparent"}, "cannot hold an alpha channel");
    expect_usage({"-o", "a.jpg", "--aov", "normal"}, "--aov: its channels are written to EXR pictures");
    expect_usage({"-o", "a.jpg", "--size", "65501x1"}, "a JPEG has at most 65500 pixels across and down");
}

TEST_F(Formats, TheLightOfHdrIsThatOfExr)
{
    ASSERT_EQ(render({"-o", "a.exr", "-o", "a.hdr", "--exposure", "3"}).code, 0);
    const Image exr = image("a.exr"), hdr = read_image(file("a.hdr"));
    for (size_t i = 0; i < exr.pixels.size(); ++i) {
        const Color a = exr.pixels[i], b = hdr.pixels[i];
        const float most = std::max({a.r, a.g, a.b});
        EXPECT_LE(std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}), most / 256);
    }
}

TEST_F(Formats, HeadersSayHowThePictureWasMade)
{
    ASSERT_EQ(render({"-o", "a.jpg", "-o", "a.hdr", "-o", "a.png", "--seed", "7"}).code, 0);
    const Metadata png = read_picture_metadata(file("a.png"));
    EXPECT_EQ(read_picture_metadata(file("a.jpg")), png);
    EXPECT_EQ(text_of(read_picture_metadata(file("a.hdr")), "settings_hash"), text_of(png, "settings_hash"));
    expect_words(run({"info", "a.jpg"}).out, "seed          7");
    expect_words(run({"compare", "a.jpg", "a.hdr"}).out, "shared_samples       seed 7");
    ASSERT_EQ(render({"-o", "b.jpg", "-o", "b.hdr", "--no-metadata"}).code, 0);
    EXPECT_TRUE(text_of(read_picture_metadata(file("b.jpg")), "seed").empty());
    EXPECT_TRUE(read_picture_metadata(file("b.hdr")).empty());
    const Said said = run({"verify", "a.hdr"});
    EXPECT_EQ(said.code, 65);
    expect_words(said.err, "verify the EXR of the same render");
}

TEST_F(Formats, OtherCommandsWriteThemToo)
{
    ASSERT_EQ(render({"-o", "a.exr", "--aov", "denoise"}).code, 0);
    ASSERT_EQ(render({"-o", "b.exr", "--seed", "1"}).code, 0);
    ASSERT_EQ(render({"--shard", "1/1", "-o", "a.lancer", "--jpeg-quality", "10"}).code, 0);
    for (const std::string format : all_formats) {
        EXPECT_EQ(run({"denoise", "a.exr", "-o", "d." + format, "-o", "d", "--format", format}).code, 0);
        EXPECT_EQ(read_bytes(file("d")), read_bytes(file("d." + format)));
        EXPECT_EQ(run({"compare", "a.exr", "b.exr", "-o", "c." + format, "-o", "c", "--format", format}).code, 0);
        EXPECT_EQ(read_bytes(file("c")), read_bytes(file("c." + format)));
        EXPECT_EQ(run({"merge", "a.lancer", "-o", "m." + format, "-o", "m", "--format", format}).code, 0);
        EXPECT_EQ(read_bytes(file("m")), read_bytes(file("m." + format)));
    }
    ASSERT_EQ(render({"-o", "m10.jpg", "--jpeg-quality", "10"}).code, 0);
    EXPECT_EQ(read_raster(file("m10.jpg"))->bytes, read_raster(file("m.jpg"))->bytes);
    EXPECT_EQ(run({"compare", "a.exr", "b.exr", "-o", "-", "--format", "png"}).code, 2);
}

}  // namespace
}  // namespace lancer
