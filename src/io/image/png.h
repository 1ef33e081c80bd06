// PNG pictures: the 8-bit view of a render, and textures.
#pragma once

#include <span>
#include <string>

#include "core/image.h"
#include "core/raster.h"
#include "core/srgb.h"
#include "io/image/metadata.h"
#include "io/image/to_bytes.h"

namespace lancer {

class AtomicFile;

// 8 bit, see to_bytes.h. Tagged as sRGB; without a tone map as linear, gamma 1; not tagged with a curve in its place.
// Only the data window is written: a PNG has no display window, so a crop keeps its place as an oFFs chunk. Metadata
// pairs become text chunks "lancer:NAME". The file appears whole or not at all; the second form fills a file made
// earlier, its owner commits it.
void write_png(const std::string& path, const Image& image, const Metadata& metadata = {},
               const ByteOptions& options = {});
// alpha: of each pixel in [0, 1], by which colours are multiplied; empty: no alpha channel. In the file they are not
// multiplied by it.
void write_png(AtomicFile& file, const Image& image, const Metadata& metadata = {}, const ByteOptions& options = {},
               std::span<const float> alpha = {});

// Any PNG; alpha is dropped, the colour below it kept. A broken or truncated file is ErrorKind::invalid_input, never a
// partial picture; a missing one missing_input.
Image read_png(const std::string& path, Encoding encoding = Encoding::of_file);

// The picture as stored: palettes are resolved, fewer than 8 bits widened, a transparent colour becomes alpha.
// Its gamma chunks give the raster's exponent.
Raster read_png_raster(const std::string& path);
// What that would give. Throws the same, but for what is wrong with the pixels.
RasterHeader read_png_raster_header(const std::string& path);

// Information on a PNG without its pixels. Throws as read_png.
struct PngInfo {
    uint32_t width = 0, height = 0, bits = 0, channels = 0;
    Metadata metadata;  // text chunks "lancer:NAME", without the prefix
};
PngInfo read_png_info(const std::string& path);

// "1.6.39", of the library that is loaded.
std::string png_version();

}  // namespace lancer
