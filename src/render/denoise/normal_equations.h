// Weighted least squares of eight fits at once: the sums of products of a linear model, and their solution.
#pragma once

#include <array>

#include "core/lanes/lanes.h"
#include "render/denoise/halves.h"

namespace lancer::denoise {

// What a colour is fitted by: 1, the two offsets in the picture, and the features.
inline constexpr size_t basis_size = 3 + feature_count;
// An observation: the colour, then the basis.
inline constexpr size_t observation_size = 3 + basis_size;
using Observation = std::array<Float8, observation_size>;

using Coefficients = std::array<std::array<Float8, 3>, basis_size>;  // of each member of the basis for each channel

// The widths of weights that are tried: k of non-local means is 1 and 1/2.
inline constexpr size_t bandwidths = 2;

class NormalEquations {
public:
    // Adds observations with a weight for each bandwidth. Both arrays have `count` entries.
    void add(const Observation* observations, const std::array<Float8, bandwidths>* weights, int count);
    // The coefficients of least weighted squares. A ridge keeps members of the basis that do not vary at 0.
    Coefficients solve(size_t bandwidth) const;

private:
    template <size_t n>
    void add_products(const Observation* observations, const std::array<Float8, bandwidths>* weights, int count,
                      size_t row, size_t first);

    // Row i: products of member i of the basis with the colour and with the members up to i.
    std::array<std::array<Observation, basis_size>, bandwidths> sums_{};
};

}  // namespace lancer::denoise
