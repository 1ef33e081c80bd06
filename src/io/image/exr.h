// OpenEXR pictures: output of renders (exact floats, crop, metadata), references and textures.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/raster.h"
#include "io/image/color_space.h"
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

// The attributes worldToCamera and worldToNDC, as the format defines them: a row vector (x, y, z, 1) times the matrix.
struct ExrCamera {
    using Matrix = std::array<std::array<float, 4>, 4>;  // rows
    Matrix world_to_camera{};  // left-handed: x to the right, y up, z the way that the camera looks
    Matrix world_to_ndc{};     // by w: x and y from (0, 0) to (1, 1) over the display window, y down
};

// Sides of tiles that may be asked for.
inline constexpr uint32_t least_exr_tile = 16, most_exr_tile = 1024;

struct ExrOptions {
    bool half = false;  // 16-bit floats; a picture with finite values beyond 65504 is written as 32-bit all the same
    ExrCompression compression = ExrCompression::zip;
    std::vector<std::pair<std::string, std::string>> attributes{};  // more text, by its full name
    uint32_t tile = 0;                                              // side of tiles; 0: scan lines
    bool is_multipart = false;  // a part for each layer, called as it; the first, "rgba", has all without a layer
    std::optional<ExrCamera> camera{};
    ColorSpace space = ColorSpace::lin_rec709;  // the file's; what is given is linear Rec. 709
};

// Writes R, G, B, the chromaticities of the color space, with the image's display and data windows. Each metadata pair
// becomes an attribute "lancer:NAME" (of the first part); an integer beyond 32 bits, for which the format has no type,
// becomes text. Planes become further channels, always with 32 bits, under their whole names in every part: a layer is
// the name up to the last dot. Layers with R, G and B are colours of the color space as well, but for those called
// "Crypto...", whose numbers name things. The file appears as a whole or not at all. The second form writes into a file
// made earlier; its owner commits it.
void write_exr(const std::string& path, const Image& image, const Metadata& metadata = {},
               const ExrOptions& options = {}, std::span<const ImagePlane> planes = {});
void write_exr(AtomicFile& file, const ImageRows& image, const Metadata& metadata = {}, const ExrOptions& options = {},
               std::span<const ImagePlane> planes = {});

// Reads a flat picture, scan lines or tiles, of any type: the channels that choose_exr_channels() takes, without alpha;
// as they stand, or from ACEScg where the chromaticities say that. Metadata are the attributes "lancer:NAME" of the
// first part, without the prefix. A broken or truncated file is ErrorKind::invalid_input, never a partial picture; a
// missing one missing_input.
Image read_exr(const std::string& path, Metadata* metadata = nullptr);

// Likewise the display window, black and transparent outside the data window; with channel A as alpha, if there is one,
// by which colours are divided; the finest level of a mip-mapped picture.
Raster read_exr_raster(const std::string& path);
// What that would give. Throws the same.
RasterHeader read_exr_raster_header(const std::string& path);

// Information on a picture without its pixels. Channels of all flat parts of the first one's data window; in further
// parts a name without a layer gets that of its part: "R" of the part "albedo" is "albedo.R".
struct ExrInfo {
    Window display, data;
    struct Channel {
        std::string name, type;  // "depth.Z", "float"
    };
    std::vector<Channel> channels;  // in the order of the file
    std::string compression;        // "zip"
    int parts = 1;
    ColorSpace space = ColorSpace::lin_rec709;  // of all chromaticities but those of ACEScg
    std::optional<ExrCamera> camera{};
    uint32_t tile_width = 0, tile_height = 0;  // 0: scan lines
    Metadata metadata;
};
ExrInfo read_exr_info(const std::string& path);
// Reads channels, by the names that ExrInfo gives them, as floats as they stand, rows of the data window. Throws as
// read_exr, also if there is no such channel. A part is decompressed as a whole: many channels are read at once.
std::vector<std::vector<float>> read_exr_channels(const std::string& path, std::span<const std::string> names);
std::vector<float> read_exr_channel(const std::string& path, const std::string& name);

// What a float is in a picture of 16 bits.
float through_half(float x);

// Version of the library at compile time: "3.1.5".
std::string exr_version();

}  // namespace lancer
