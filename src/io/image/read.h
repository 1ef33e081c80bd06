// Reads pictures of any supported format: textures, environment maps, references.
#pragma once

#include <memory>
#include <string>

#include "core/image.h"
#include "core/raster.h"
#include "core/srgb.h"
#include "io/image/metadata.h"

namespace lancer {

// The picture of an EXR, PNG, JPEG, TIFF, Radiance HDR, WebP, DDS, GIF, BMP, PNM/PFM or Targa file: of several the
// first. The first bytes decide which it is, not the name; only Targa, which has none of its own, goes by ".tga".
// Broken, truncated (but a JPEG, see Raster::damage) or of unknown format: ErrorKind::invalid_input; missing:
// missing_input; not enough memory, or the module lancer_oiio, which all but EXR, PNG, JPEG and Targa need, not there:
// failed. May be called from several threads.
std::shared_ptr<const Raster> read_raster(const std::string& path);
// What its header says; no room is made for pixels. Throws the same, but for what is wrong with the pixels.
RasterHeader read_raster_header(const std::string& path);

// What lancer wrote into its header: EXR, PNG, JPEG and HDR. Empty of other formats. Throws the same.
Metadata read_picture_metadata(const std::string& path);

// The same in linear RGB: integer formats are decoded as `encoding` says, floats are taken as they stand; alpha is
// dropped, grey becomes RGB. An EXR keeps its data window. A damaged picture of any format is invalid_input.
struct PictureKind {
    std::string format;     // "openexr", "png", "jpeg", "tiff", "hdr", "webp", "dds", "gif", "bmp", "pnm" or "targa"
    bool is_float = false;  // else integers, made for a screen
};
Image read_image(const std::string& path, Encoding encoding = Encoding::of_file, PictureKind* kind = nullptr);

}  // namespace lancer
