// Blends a filtered picture with the noisy one so that the result is not worse than either, about: James and Stein,
// "Estimation with Quadratic Loss" (1961).
#pragma once

#include "render/denoise/plane.h"

namespace lancer::denoise {

// For each pixel of a channel the part of the noisy picture that the result has. Where filtered and noisy picture
// differ, over a square of pixels, by more than the noise, the rest is error of the filter. variance: of the noisy
// picture.
Plane noisy_part(const Plane& filtered, const Plane& noisy, const Plane& variance);
// Half of the side of the square.
inline constexpr int blend_radius = 8;

}  // namespace lancer::denoise
