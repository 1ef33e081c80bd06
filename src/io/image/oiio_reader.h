// Pictures that OpenImageIO decodes, by the module lancer_oiio, which is opened with the first of them.
#pragma once

#include <string>

#include "core/raster.h"
#include "io/input_file.h"

namespace lancer {

// format: as OpenImageIO calls its decoder. May be called from several threads. Throws Error: invalid_input for a file
// that the decoder refuses or a picture that is too large, failed where there is no module.
Raster read_with_oiio(InputFile& file, const std::string& format);
// What that would give. No room is made for the pixels.
RasterHeader read_header_with_oiio(InputFile& file, const std::string& format);

}  // namespace lancer
