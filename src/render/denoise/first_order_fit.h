// The regression of NFOR: around every second pixel of every second row, colours of a window are fitted linearly by
// features and place, and each fit predicts its whole window; predictions are averaged by weight.
#pragma once

#include <array>
#include <stop_token>

#include "render/denoise/halves.h"
#include "render/denoise/normal_equations.h"
#include "render/denoise/patch_distance.h"

namespace lancer::denoise {

// Sums have the same order, and the same bits, in a picture without its first rows if their number is a multiple of
// this.
inline constexpr int row_period = 64;

// The filtered colours for each bandwidth.
using Fitted = std::array<ColorPlanes, bandwidths>;

// color: what is filtered. guide: the other half's colour with its variance, which decides the weights. features: the
// other half's. Margins are not mirrored. What is stopped returns soon, with anything.
Fitted fit_first_order(const ColorPlanes& color, const Features& features, const Guide& guide,
                       const std::stop_token& stop);

}  // namespace lancer::denoise
