// Errors of pictures that have no reference: two of one thing by random numbers of their own tell by how they differ.
#pragma once

#include <array>
#include <vector>

#include "core/film.h"

namespace lancer::bench {

// Two pictures of one thing, of one size, whose random numbers have nothing in common.
using Pair = std::array<Film, 2>;

// Relative mean squared error of each picture of a pair, without bias but for that of r in the denominator: the mean of
// (a - b)^2 / 2 over r^2 + 0.01, r the mean of all pictures that there are. all: not empty, all of that size.
double error_of(const Pair& pair, const std::vector<const Pair*>& all);

}  // namespace lancer::bench
