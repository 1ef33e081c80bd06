// FLIP: how different two pictures look when one flips between them on a screen, 0 (the same) to 1, at each pixel.
// For people who look, not for slopes or tests: of noise it sees what the eye sees.
// Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", 2020; for pictures of any brightness
// Andersson, Nilsson, Shirley, Akenine-Möller, "Visualizing Errors in Rendered High Dynamic Range Images",
// Eurographics short papers, 2021. Settings are the defaults of NVIDIA's tool. Sums are in double and in a fixed order,
// whatever the number of threads.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/image.h"

namespace lancer {

// Stops by which pixels are brightened, evenly spaced.
struct FlipExposures {
    double start = 0, stop = 0;
    int count = 0;  // two or more
};

struct Flip {
    std::vector<float> error;  // as Image::pixels
    double mean = 0;
    double weighted_median = 0;  // the pixels up to it have half of the sum of all errors
    double min = 0, max = 0;
    std::optional<FlipExposures> exposures;  // of flip_hdr
};

// Both throw as compare() of metrics.h. A pixel that is not finite on either side has error 1, and counts as black in
// what its neighbours look like. Pictures for a screen, in linear light: what lies outside [0, 1] is cut off.
Flip flip_ldr(const Image& test, const Image& reference);

// Pictures of any brightness: the largest error of each pixel over exposures, with the ACES tone map. The exposures are
// those of the reference, so the order of the pictures matters.
Flip flip_hdr(const Image& test, const Image& reference);

// From where the brightest pixel of the reference is nearly white to where its median is. If the median is black, that
// of the pixels that are not counts; if all are black, no stops at all.
FlipExposures flip_exposures(std::span<const Color> reference);

}  // namespace lancer
