// OpenEXR pictures: output of renders (exact floats, crop, metadata), references and textures.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/raster.h"
#include "io/image/exr_compression.h"
#include "io/image/metadata.h"

namespace lancer {

class AtomicFile;

inline constexpr const char* exr_prefix = "lancer:";  // prefix of metadata attributes

// A picture whose rows are generated while they are written.
struct ImageRows {
    Window display, data;                                            // as in Image
    std::function<void(int32_t y, std::span<Color> row)> fill = {};  // row y of the data window
};
// The rows of an image, which must outlive the result.
ImageRows rows_of(const Image& image);

struct ExrOptions {
    bool half = false;  // 16-bit floats; a picture with finite values beyond 65504 is written as 32-bit all the same
    ExrCompression compression = ExrCompression::zip;
    std::vector<std::pair<std::string, std::string>> attributes{};  // more text, by its full name
};

// Writes R, G, B, Rec. 709 chromaticities, with the image's display and data windows. Each metadata
// pair becomes an attribute "lancer:NAME"; an integer beyond 32 bits, for which the format has no type, becomes text.
// Planes become further channels, always with 32 bits. The file appears as a whole or not at all. The second form
// writes into a file made earlier; its owner commits it.
void write_exr(const std::string& path, const Image& image, const Metadata& metadata = {},
               const ExrOptions& options = {}, std::span<const ImagePlane> planes = {});
void write_exr(AtomicFile& file, const ImageRows& image, const Metadata& metadata = {}, const ExrOptions& options = {},
               std::span<const ImagePlane> planes = {});

// Reads a flat picture, scan lines or tiles, of any type: the channels that choose_exr_channels() takes, as they stand,
// without alpha. Metadata are the attributes "lancer:NAME" of the first part, without the prefix. A broken or truncated
// file is ErrorKind::invalid_input, never a partial picture; a missing one missing_input.
Image read_exr(const std::string& path, Metadata* metadata = nullptr);

// Reads the display window, black and transparent outside the data window; with channel A as alpha, if there is one, by
// which colours are divided; the finest level of a mip-mapped picture.
Raster read_exr_raster(const std::string& path);
// What that would give. Throws the same.
RasterHeader read_exr_raster_header(const std::string& path);

// Information on a picture without its pixels.
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
// Reads channels as floats, rows of the data window. Throws as read_exr, also if there is no such channel. A file is
// decompressed as a whole: many channels are read at once.
std::vector<std::vector<float>> read_exr_channels(const std::string& path, std::span<const std::string> names);
std::vector<float> read_exr_channel(const std::string& path, const std::string& name);

// What a float is in a picture of 16 bits.
float through_half(float x);

// Version of the library at compile time: "3.1.5".
std::string exr_version();

}  // namespace lancer
