// OpenEXR pictures: what a render writes (exact floats, crop, metadata) and reads back as reference or texture.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/raster.h"
#include "io/image/metadata.h"

namespace lancer {

class AtomicFile;

inline constexpr const char* exr_prefix = "lancer:";  // of the attributes that are metadata

// A picture whose rows are made while they are written, so that it need not be there as a whole.
struct ImageRows {
    Window display, data;                                            // as in Image
    std::function<void(int32_t y, std::span<Color> row)> fill = {};  // row y of the data window
};
// Of an image that must outlive it.
ImageRows rows_of(const Image& image);

struct ExrOptions {
    bool half = false;  // 16-bit floats; a picture with finite values beyond 65504 is written as 32-bit all the same
};

// R, G, B, ZIP-compressed, Rec. 709 chromaticities; display and data windows as in the image. Each metadata pair
// becomes an attribute "lancer:NAME"; an integer beyond 32 bits, for which the format has no type, becomes text.
// Planes become further channels, always of 32 bits: they are data. The file appears whole or not at all. The second
// form fills a file made earlier; its owner commits it.
void write_exr(const std::string& path, const Image& image, const Metadata& metadata = {},
               const ExrOptions& options = {}, std::span<const ImagePlane> planes = {});
void write_exr(AtomicFile& file, const ImageRows& image, const Metadata& metadata = {}, const ExrOptions& options = {},
               std::span<const ImagePlane> planes = {});

// Any single-part picture, scan lines or tiles, with channels R, G, B, or Y for grey, of any type. Metadata are the
// attributes "lancer:NAME", without the prefix. A broken or truncated file is ErrorKind::invalid_input, never a
// partial picture; a missing one missing_input.
Image read_exr(const std::string& path, Metadata* metadata = nullptr);

// The same as a picture of its display window, black and transparent where the data window has nothing; with a channel
// A as alpha, if there is one. Of a mip-mapped picture the finest level.
Raster read_exr_raster(const std::string& path);

// What there is in a picture without reading its pixels.
struct ExrInfo {
    Window display, data;
    struct Channel {
        std::string name, type;  // "depth.Z", "float"
    };
    std::vector<Channel> channels;  // in the order of the file
    std::string compression;        // "zip"
    Metadata metadata;
};
ExrInfo read_exr_info(const std::string& path);
// One channel of a picture as floats, rows of its data window. Throws as read_exr, also if there is no such channel.
std::vector<float> read_exr_channel(const std::string& path, const std::string& name);

// "3.1.5", of the library that it was compiled with.
std::string exr_version();

}  // namespace lancer
