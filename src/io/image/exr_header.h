// Validates the header of an OpenEXR file before the library reads it. The library allocates what the size fields
// demand (attributes, chunk tables, line buffers) before it knows whether the file is long enough; a broken file of 300
// bytes must not cost gigabytes.
#pragma once

#include "io/input_file.h"

namespace lancer {

// Throws Error(invalid_input) where the file is no OpenEXR file or a deep one of a single part, where a picture in it
// is larger than the limits of input_file.h, or where the file is too short for what a header announces.
void check_exr_header(InputFile& file);

}  // namespace lancer
