// JPEG pictures, read by libjpeg instead of OpenImageIO: most scenes have no other formats and then need not load its
// 260 libraries.
#pragma once

#include <optional>

#include "core/raster.h"
#include "io/input_file.h"

namespace lancer {

// Grey or RGB as stored: Exif rotation and colour profiles are ignored. Nothing for a CMYK picture, which OpenImageIO
// converts. A file of which nothing can be decoded is ErrorKind::invalid_input. Of a damaged or truncated one there is
// what could be decoded, the rest is grey, and Raster::damage says what libjpeg said.
std::optional<Raster> read_jpeg(InputFile& file);

}  // namespace lancer
