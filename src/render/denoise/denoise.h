// Removes noise from a rendered picture. The app calls it when a picture is complete.
//
// Follows Bitterli, Rousselle, Moon, Iglesias-Guitian, Adler, Mitchell, Jarosz and Novak, "Nonlinearly Weighted
// First-order Regression for Denoising Monte Carlo Renderings" (2016), its first pass: two halves of the samples filter
// each other by linear fits to what the camera sees. The result is blended with the noisy picture by a James-Stein
// estimator, so that it converges to it with the number of samples.
//
// The bits of the result do not depend on the number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "core/color.h"

namespace lancer {

// Means over one half of the samples of each pixel, row by row. What is empty counts as 0, as does what is not finite.
struct DenoiseHalf {
    std::array<std::span<const float>, 3> color;  // linear, any unit
    // Of the first surface that spreads light: albedo in [0, 1], the shading normal, the distance along the ray (0
    // where nothing is hit).
    std::array<std::span<const float>, 3> albedo, normal;
    std::span<const float> depth;
    float samples = 1;  // of a pixel, on average: how much the half counts beside the other
};

struct DenoiseInput {
    uint32_t width = 0, height = 0;  // pixels
    std::array<DenoiseHalf, 2> halves;
    // Variance of the pixel's mean luminance, up to a factor: only its distribution over pixels counts.
    std::span<const float> variance;
};

struct Denoised {
    std::vector<Color> pixels;
    // The squared error that is expected of each pixel, as the halves tell it of the pixels around: the mean over
    // channels of (x - r)^2 / (r^2 + 0.01).
    std::vector<float> error;
    std::vector<std::vector<Color>> layers;  // of a film that has layers, each filtered alike
};

// Uses the threads of the innermost with_threads(). Without pixels if it is stopped. Large pictures are denoised in
// bands of rows, whose neighbourhoods are denoised with them: bytes_to_denoise().
// rows_at_once: the least number of rows of a band; the bits do not depend on it. 0: as many as 8 million pixels have.
Denoised denoise_picture(const DenoiseInput& input, const std::stop_token& stop = {}, uint32_t rows_at_once = 0);

// About what denoise_picture() takes at most beside its input, its result included.
uint64_t bytes_to_denoise(uint32_t width, uint32_t height);

}  // namespace lancer
