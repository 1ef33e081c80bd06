// FLIP: perceived difference of two pictures that alternate on a screen, 0 (equal) to 1 per pixel. It models human
// vision; it is not a measure of convergence. Andersson et al., "FLIP: A Difference Evaluator for Alternating Images",
// 2020; for HDR pictures Andersson, Nilsson, Shirley, Akenine-Möller, "Visualizing Errors in Rendered High Dynamic
// Range Images", Eurographics short papers, 2021. Parameters are the defaults of NVIDIA's tool. Sums are in double and
// in a fixed order for any number of threads.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/image.h"

namespace lancer {

// Exposures in stops, evenly spaced.
struct FlipExposures {
    double start = 0, stop = 0;
    int count = 0;  // two or more
};

struct Flip {
    std::vector<float> error;  // as Image::pixels
    double mean = 0;
    double weighted_median = 0;  // pixels with at most this error have half of the total error
    double min = 0, max = 0;
    std::optional<FlipExposures> exposures;  // of flip_hdr
};

// Both throw as compare() in metrics.h. A pixel that is not finite in either picture has error 1 and counts as black
// for its neighbours. Low dynamic range, in linear light, clamped to [0, 1].
Flip flip_ldr(const Image& test, const Image& reference);

// High dynamic range: the largest error of each pixel over exposures, with the ACES tone map. The exposures are those
// of the reference, so the order of the pictures matters.
Flip flip_hdr(const Image& test, const Image& reference);

// From the exposure at which the reference's brightest pixel is nearly white to that of its median; if the median is
// black, the median of the other pixels; if all are black, no exposures.
FlipExposures flip_exposures(std::span<const Color> reference);

}  // namespace lancer
