// Any picture the program reads: textures, environment maps, references.
#pragma once

#include <string>

#include "core/image.h"
#include "core/srgb.h"

namespace lancer {

// Linear RGB of an EXR, PNG, JPEG, TIFF, Radiance HDR, BMP, PNM/PFM or Targa file. The first bytes decide which it is,
// not the name; only Targa, which has none of its own, goes by ".tga". Integer formats are decoded as `encoding`
// says, floats are taken as they stand; alpha is dropped, grey becomes RGB.
// Broken, truncated or of unknown format: ErrorKind::invalid_input; missing: missing_input; the module lancer_oiio,
// which all but EXR, PNG and Targa need, not there: failed. May be called from several threads.
Image read_image(const std::string& path, Encoding encoding = Encoding::srgb);

}  // namespace lancer
