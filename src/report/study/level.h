// Whether the pictures of a method are as bright as the reference and where their mean is: what remains of their error
// when there is no noise left.
#pragma once

#include <string>
#include <vector>

#include "core/image.h"
#include "report/study/results.h"

namespace lancer {

// A picture of another program whose mean radiance is further from the reference's than this part of it does not show
// the same scene: its errors are shown and not ranked.
inline constexpr double largest_level_difference = 0.02;

// pictures: of independent random numbers, at least one. The references are independent halves. The systematic part is
// the mean over pairs of different pictures x, y of (x - r1)(y - r2) / (r1 r2 + 0.01), to which no noise adds: it may
// be below 0, and is NaN of one picture alone. Intervals are of 95 %, by resampling the pictures; NaN of fewer than
// fewest_seeds (study/ranking.h). Throws as compare().
PictureLevel level_of(const std::vector<Image>& pictures, const Image& first, const Image& second);

// Why such pictures may not be ranked, as their level is another one beyond doubt, or by itself where there is no
// interval; empty if they may.
std::string why_other_level(const PictureLevel& level);

}  // namespace lancer
