// JPEG pictures, the 8-bit view of a render, and textures. They are read by libjpeg instead of OpenImageIO: most scenes
// have no other formats and then need not load its 260 libraries.
#pragma once

#include <optional>

#include "core/image.h"
#include "core/raster.h"
#include "io/image/metadata.h"
#include "io/image/to_bytes.h"
#include "io/input_file.h"

namespace lancer {

// Grey or RGB as stored: Exif rotation and colour profiles are ignored. Nothing for a CMYK picture, which OpenImageIO
// converts. A file of which nothing can be decoded is ErrorKind::invalid_input. Of a damaged or truncated one there is
// what could be decoded, the rest is grey, and Raster::damage says what libjpeg said.
std::optional<Raster> read_jpeg(InputFile& file);
// What the comments of a picture of ours say. Throws Error (invalid_input) for what is no JPEG.
Metadata read_jpeg_metadata(InputFile& file);

class AtomicFile;

inline constexpr uint32_t max_jpeg_side = 65500;  // as libjpeg has it

// The data window, 8 bit, see to_bytes.h; quality: 1 to 100, as of libjpeg, all channels in full resolution. Each
// metadata pair is a comment "lancer:NAME VALUE". The owner of the file commits it. Throws Error (failed).
void write_jpeg(AtomicFile& file, const Image& image, const Metadata& metadata = {}, const ByteOptions& options = {},
                int quality = 95);

}  // namespace lancer
