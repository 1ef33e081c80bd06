// Pictures compared: bit by bit, and where there is no reference, by how two of one thing differ.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/film.h"

namespace lancer {

// Pixels that do not have the same sums and counts to the bit. Of one size.
size_t differing_pixels(const Film& a, const Film& b);

// The mean of each pixel that has samples.
std::vector<Color> pixel_means(const Film& film);

// Two pictures of one thing, as pixel_means(), whose random numbers have nothing in common.
using PicturePair = std::array<std::vector<Color>, 2>;

// The mean of all the pictures, for each pixel. Not empty, all of one size.
std::vector<Color> mean_of(std::span<const PicturePair* const> pairs);

// Relative mean squared error of each picture of a pair, from how they differ, without bias but for that of the mean in
// the denominator: the mean of (a - b)^2 / 2 over mean^2 + 0.01. mean: of the same thing, of that size.
double error_of(const PicturePair& pair, std::span<const Color> mean);

}  // namespace lancer
