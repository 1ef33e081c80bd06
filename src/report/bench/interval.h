// Estimates of what rounds have measured: every contestant once in each round, one shortly after the other. What
// disturbs a machine lasts for many rounds, so neighbours are alike: an interval by resampling single rounds would be
// too narrow. It is taken from blocks of neighbours instead, as by batch means: Law and Carson, "A Sequential Procedure
// for Determining the Length of a Steady-State Simulation", Operations Research 27, 1979.
#pragma once

#include <span>
#include <vector>

#include "report/page/svg_plot.h"

namespace lancer {

// How often `other` went round in the time of `base`, round by round: above 1 other is faster. Of one size.
std::vector<double> speed_ratios(const std::vector<double>& base, const std::vector<double>& other);

inline constexpr size_t most_blocks = 15;

// The medians of blocks of neighbours, as equal in size as can be: at most most_blocks, of one value or more each.
std::vector<double> block_medians(std::span<const double> values);

// The median of the block medians and its 95 % interval by resampling them; with fewer than six values no interval.
// values: not empty, no NaN.
Ranged estimate(std::span<const double> values);

}  // namespace lancer
