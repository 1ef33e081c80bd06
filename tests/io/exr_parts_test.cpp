// EXR files in tiles, in parts, and in other color spaces.
#include <cstring>

#include "io/image/exr.h"
#include "io/image/read.h"
#include "io/same_bits.h"
#include "io/temp_folder.h"

namespace lancer {
namespace {

Image picture(const Window& display, const Window& data)
{
    Image image = make_image(display, data);
    float x = 0;
    for (Color& c : image.pixels) c = {x += 0.25f, -x, 1 / x};
    return image;
}

// Numbers of which no two are alike; alpha is not of a layer.
std::vector<ImagePlane> layers(const Image& image)
{
    std::vector<ImagePlane> planes;
    for (const char* name : {"albedo.R", "albedo.G", "albedo.B", "A", "light.key.R", "depth.Z"}) {
        ImagePlane& plane = planes.emplace_back(ImagePlane{name, {}});
        for (size_t i = 0; i < image.pixels.size(); ++i)
            plane.values.push_back(static_cast<float>(i) + 1000.5f * static_cast<float>(planes.size()));
    }
    return planes;
}

std::vector<std::string> sorted_names(const ExrInfo& info)
{
    std::vector<std::string> names;
    for (const auto& c : info.channels) names.push_back(c.name);
    std::sort(names.begin(), names.end());
    return names;
}

// However a file is cut and packed, the same is read from it.
TEST(ExrParts, TilesPartsAndCompressionHoldTheSame)
{
    const TempFolder folder;
    const std::string path = folder.file("a.exr");
    for (const Window data : {Window{0, 0, 100, 300}, Window{-5, 7, 12, 40}})
        for (const uint32_t tile : {0u, 16u, 100u, 1024u})
            for (const bool is_multipart : {false, true})
                for (const ExrCompression compression :
                     {ExrCompression::none, ExrCompression::rle, ExrCompression::zips, ExrCompression::zip,
                      ExrCompression::piz}) {
                    const Image image = picture({0, 0, 100, 300}, data);
                    const std::vector<ImagePlane> planes = layers(image);
                    write_exr(path, image, {{"spp", int64_t{4}}},
                              {.compression = compression, .tile = tile, .is_multipart = is_multipart}, planes);
                    Metadata metadata;
                    EXPECT_TRUE(same_bits(read_exr(path, &metadata), image));
                    EXPECT_EQ(text_of(metadata, "spp"), "4");
                    std::vector<std::string> names;
                    for (const ImagePlane& p : planes) names.push_back(p.name);
                    const auto values = read_exr_channels(path, names);
                    for (size_t i = 0; i < planes.size(); ++i) EXPECT_EQ(values[i], planes[i].values) << names[i];
                    const ExrInfo info = read_exr_info(path);
                    EXPECT_EQ(info.tile_width, tile);
                    EXPECT_EQ(info.parts, is_multipart ? 4 : 1);
                    EXPECT_EQ(info.compression, name_of(compression));
                    EXPECT_EQ(sorted_names(info), (std::vector<std::string>{"A", "B", "G", "R", "albedo.B", "albedo.G",
                                                                            "albedo.R", "depth.Z", "light.key.R"}));
                }
}

TEST(ExrParts, LossyCompressionWorksWithThemToo)
{
    const TempFolder folder;
    const std::string path = folder.file("a.exr");
    Image image = make_image(100, 70);
    for (Color& c : image.pixels) c = {0.5f, 0.25f, 0.75f};
    for (const ExrCompression compression : {ExrCompression::dwaa, ExrCompression::dwab}) {
        write_exr(path, image, {}, {.half = true, .compression = compression, .tile = 32, .is_multipart = true},
                  layers(image));
        for (const Color& c : read_exr(path).pixels) EXPECT_NEAR(c.r, 0.5f, 0.01f);
    }
}

TEST(ExrParts, TheRasterOfATextureIsTheSame)
{
    const TempFolder folder;
    const Image image = picture({0, 0, 40, 30}, {0, 0, 40, 30});
    write_exr(folder.file("a.exr"), image, {}, {}, layers(image));
    write_exr(folder.file("b.exr"), image, {}, {.tile = 16, .is_multipart = true}, layers(image));
    EXPECT_EQ(read_raster(folder.file("a.exr"))->floats, read_raster(folder.file("b.exr"))->floats);
}

TEST(ExrParts, CutFilesAreRefused)
{
    const TempFolder folder;
    const Image image = picture({0, 0, 40, 30}, {0, 0, 40, 30});
    write_exr(folder.file("a.exr"), image, {}, {.tile = 16, .is_multipart = true}, layers(image));
    const std::string whole = read_bytes(folder.file("a.exr"));
    for (size_t size = 0; size < whole.size() - 1; size += 97) {
        write_bytes(folder.file("b.exr"), whole.substr(0, size));
        EXPECT_THROW(read_exr_channel(folder.file("b.exr"), "depth.Z"), Error) << size;
    }
}

TEST(ExrParts, TheCameraComesBack)
{
    const TempFolder folder;
    ExrCamera camera;
    for (size_t i = 0; i < 16; ++i) {
        camera.world_to_camera[i / 4][i % 4] = static_cast<float>(i) / 3;
        camera.world_to_ndc[i / 4][i % 4] = static_cast<float>(i) * -7;
    }
    const std::string path = folder.file("a.exr");
    write_exr(path, make_image(4, 4), {}, {.is_multipart = true, .camera = camera});
    const auto back = read_exr_info(path).camera;
    ASSERT_TRUE(back);
    EXPECT_EQ(back->world_to_camera, camera.world_to_camera);
    EXPECT_EQ(back->world_to_ndc, camera.world_to_ndc);
    write_exr(path, make_image(4, 4));
    EXPECT_FALSE(read_exr_info(path).camera);
}

// In the file the numbers are ACEScg, and the header says so; who reads colours gets them back.
TEST(ExrParts, AcescgIsWrittenAndReadBack)
{
    const TempFolder folder;
    const std::string path = folder.file("a.exr");
    Image image = make_image(3, 2);
    for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = {1, 0.5f, static_cast<float>(i)};
    std::vector<ImagePlane> planes;
    for (const char* name : {"albedo.R", "albedo.G", "albedo.B", "Crypto00.R", "Crypto00.G", "Crypto00.B", "normal.X"})
        planes.push_back({name, std::vector<float>(6, static_cast<float>(planes.size() + 1))});
    write_exr(path, image, {}, {.space = ColorSpace::acescg}, planes);
    const ExrInfo info = read_exr_info(path);
    EXPECT_EQ(info.space, ColorSpace::acescg);
    const std::vector<std::string> names{"R", "albedo.R", "albedo.G", "Crypto00.R", "normal.X"};
    const auto stored = read_exr_channels(path, names);
    const ColorMatrix to = to_space(ColorSpace::acescg);
    for (size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(stored[0][i], transformed(to, image.pixels[i]).r);
        EXPECT_EQ(stored[1][i], transformed(to, {1, 2, 3}).r);
        EXPECT_EQ(stored[2][i], transformed(to, {1, 2, 3}).g);
        EXPECT_EQ(stored[3][i], 4);
        EXPECT_EQ(stored[4][i], 7);
    }
    const Image back = read_exr(path);
    const auto raster = read_raster(path);
    for (size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(back.pixels[i].r, image.pixels[i].r, 1e-6);
        EXPECT_NEAR(back.pixels[i].b, image.pixels[i].b, 1e-6);
        EXPECT_EQ(raster->floats[3 * i + 1], back.pixels[i].g);
    }
    write_exr(path, image);
    EXPECT_EQ(read_exr_info(path).space, ColorSpace::lin_rec709);
}

}  // namespace
}  // namespace lancer
