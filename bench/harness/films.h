// Films compared: bit by bit, and where there is no reference, by how two of one thing differ.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/film.h"

namespace lancer::bench {

// Pixels that do not have the same sums and counts to the bit. Of one size.
size_t differing_pixels(const Film& a, const Film& b);

// Two pictures of one thing, of one size, whose random numbers have nothing in common.
using Pair = std::array<Film, 2>;

// The mean of all the pictures, for each pixel. Not empty, all of one size.
std::vector<Color> mean_of(std::span<const Pair* const> pairs);

// Relative mean squared error of each picture of a pair, from how they differ, without bias but for that of the mean in
// the denominator: the mean of (a - b)^2 / 2 over mean^2 + 0.01. mean: of the same thing, of that size.
double error_of(const Pair& pair, std::span<const Color> mean);

}  // namespace lancer::bench
