// The two halves of the samples as the denoiser works with them: planes, scaled so that its constants suit every
// picture, and the variance that the halves show.
#pragma once

#include <array>

#include "render/denoise/denoise.h"
#include "render/denoise/plane.h"

namespace lancer::denoise {

inline constexpr int albedo_at = 0, normal_at = 3, depth_at = 6, feature_count = 7;
using Features = std::array<Plane, feature_count>;
using ColorPlanes = std::array<Plane, 3>;

struct Half {
    ColorPlanes color;
    Features features;  // depth as z / (z + mean z), and 1 where nothing is hit
};

struct Halves {
    std::array<Half, 2> half;
    Plane pixel_variance;    // as DenoiseInput::variance
    float part_of_b = 0.5f;  // of the samples, that the second half has
    float scale = 1;         // what colours were multiplied by: a power of two, for a mean of about 0.3
};

// The mean that scaled pictures have, within a factor of sqrt(2).
inline constexpr float scaled_mean = 0.3f;

// What all of a picture decides.
struct Scales {
    float color = 1;  // Halves::scale
    float depth = 0;  // the mean distance of what is hit
};
Scales scales_of(const DenoiseInput& input);
Halves load_halves(const DenoiseInput& input, const Scales& scales);

// Variance of a half's colour at each pixel: the pixel variance, averaged over 3x3 pixels, times a factor that makes
// its mean over 21x21 pixels that of (A - B)^2 / 2. Thus samples that are not independent need no model.
ColorPlanes variance_of_half(const Halves& halves);

// (A - B)^2 / 2, averaged over a square: the variance of either.
Plane variance_of_pair(const Plane& a, const Plane& b, int radius);

}  // namespace lancer::denoise
