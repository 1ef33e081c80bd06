// Targa pictures, read here instead of by OpenImageIO: the decoder in current distributions reads outside its buffers
// when a palette index or a length is wrong.
#pragma once

#include <string>

#include "core/raster.h"

namespace lancer {

// Palette, true colour (15, 16, 24, 32 bits) or grey, plain or run-length encoded, any corner first; 5-bit parts are
// widened to 8. Alpha where the header says how many bits of it there are. A broken or truncated file is
// ErrorKind::invalid_input, never a partial picture; a missing one missing_input.
Raster read_tga(const std::string& path);
// What that would give. Throws the same, but for what is wrong with the pixels.
RasterHeader read_tga_header(const std::string& path);

}  // namespace lancer
