// Which width of weights is better at each pixel, judged by how well what was filtered of one half predicts the other.
#pragma once

#include "render/denoise/first_order_fit.h"

namespace lancer::denoise {

// Filtered pictures of both halves, mixed of the two bandwidths as their errors say.
struct FilteredHalves {
    ColorPlanes a, b;
};
// a, b: fitted pictures of both halves. variance: of one half.
FilteredHalves choose_bandwidth(const Halves& halves, const ColorPlanes& variance, Fitted a, Fitted b);

}  // namespace lancer::denoise
