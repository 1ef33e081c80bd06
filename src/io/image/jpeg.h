// JPEG pictures, read by libjpeg instead of OpenImageIO: most scenes have no other formats and then need not load its
// 260 libraries.
#pragma once

#include <optional>

#include "core/raster.h"
#include "io/input_file.h"

namespace lancer {

// Grey or RGB as stored: Exif rotation and colour profiles are ignored. Nothing for a CMYK picture, which OpenImageIO
// converts. A broken or truncated file, and one in which libjpeg had to guess, is ErrorKind::invalid_input, never a
// partial picture.
std::optional<Raster> read_jpeg(InputFile& file);

}  // namespace lancer
