// Samples so rare and bright that no filter of these halves can tell what they contribute.
#pragma once

#include "render/denoise/halves.h"

namespace lancer::denoise {

// A pixel of one half that is much brighter than all pixels near it in the other half keeps what these have; the rest
// of its light is spread evenly over a square of pixels, so that the picture's light stays.
void spread_outliers(Halves& halves);

}  // namespace lancer::denoise
