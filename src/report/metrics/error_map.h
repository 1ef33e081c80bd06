// Colour maps of per-pixel errors.
#pragma once

#include <array>
#include <span>

#include "core/image.h"

namespace lancer {

// Code values of sRGB for t in [0, 1] (cut off beyond), from black over blue-green, brown and violet to white:
// "cubehelix" of D. A. Green, "A colour scheme for the display of astronomical intensity images", Bulletin of the
// Astronomical Society of India 39, 2011, with its default parameters (start 0.5, -1.5 rotations, hue 1, gamma 1). Its
// perceived brightness rises evenly, so that it reads the same in grey.
std::array<double, 3> cubehelix(double t);

// A picture of one number per pixel: `errors` from 0 to 1, or as powers of ten from 1e-5 to 10. In linear light, for
// writing with the sRGB curve; with the windows of `like`.
Image draw_errors(const Image& like, std::span<const float> errors);
Image draw_error_powers(const Image& like, std::span<const float> errors);

}  // namespace lancer
