// JPEG pictures, read by libjpeg and not through OpenImageIO: most scenes with pictures have no others, and need not
// open its 260 libraries.
#pragma once

#include <optional>

#include "core/raster.h"
#include "io/input_file.h"

namespace lancer {

// Grey or RGB, as it is stored: no turning by Exif, no colour profile. Nothing for a picture of four inks, which
// OpenImageIO knows how to turn into RGB. A broken or truncated file, and one in which libjpeg had to guess, is
// ErrorKind::invalid_input, never a partial picture.
std::optional<Raster> read_jpeg(InputFile& file);

}  // namespace lancer
