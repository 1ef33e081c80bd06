// The error of a denoised picture, told by samples that the denoiser did not see: the product of its differences to two
// independent sets has the squared error as its mean, what the filter smooths away included.
#pragma once

#include <optional>
#include <vector>

#include "core/film.h"
#include "report/metrics/statistics.h"

namespace lancer {

struct HeldOutError {
    double rel_mse = 0;  // as all errors here; may be below 0 by chance
    Interval interval;   // 95 %
};

// denoised: of a film with four sets, without those held out. Nothing if no pixel has samples of both.
std::optional<HeldOutError> held_out_error(const Film& film, const std::vector<Color>& denoised);

}  // namespace lancer
