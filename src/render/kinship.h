// How much the light that comes to the places where the paths of a square split is alike, and the best linear
// prediction from it. See render/common_numbers.h.
#pragma once

#include <array>
#include <span>

#include "core/lanes/lanes.h"
#include "render/workspace.h"

namespace lancer {

inline constexpr size_t square_pixels = size_t{PathPlan::square} * PathPlan::square;

// One number for each pixel of a square, and by eights.
struct OfSquare {
    static constexpr size_t eights = square_pixels / float_lanes;
    alignas(32) std::array<float, square_pixels> each{};

    float& operator[](size_t i) { return each[i]; }
    float operator[](size_t i) const { return each[i]; }
    Float8 eight(size_t e) const { return load8(&each[e * float_lanes]); }
    void set_eight(size_t e, Float8 to) { store8(&each[e * float_lanes], to); }
};

// How much of the light that comes to two places is alike, [0, 1]; 1 for one and itself, 0 for any that did not split.
float kinship(const SplitVertex& a, const SplitVertex& b);

// How much what two pixels err by is alike if their paths split at one place and go on by the same numbers. Fitted
// once, on six scenes at 1 to 64 samples a pixel: 0.9 leaves up to 6 % more of the error or less, 0.5 up to a quarter
// more.
inline constexpr float likeness = 0.75f;

// The inverse of M = (2 - likeness) I + likeness K, where K_ij is the kinship of i and j, symmetric: of K as much as a
// few of the places tell of all others, by an incomplete Cholesky factorization with pivots (Fine and Scheinberg,
// "Efficient SVM Training Using Low-Rank Kernel Representations", 2001), and its diagonal as it is (Snelson and
// Ghahramani, "Sparse Gaussian Processes using Pseudo-inputs", 2006). Whatever K lacks makes predictions worse, never
// biased, as places alone decide on it.
class KinInverse {
public:
    // square: at most square_pixels; takes_part: of each, whether it is alike any other.
    KinInverse(std::span<const Found> square, const std::array<bool, square_pixels>& takes_part);

    // M^-1 v.
    OfSquare times(const OfSquare& v) const;
    // (M^-1)_ii.
    OfSquare diagonal() const;

private:
    static constexpr size_t most_pivots = 16;
    OfSquare own_;                               // M^-1 = diagonal of these
    std::array<OfSquare, most_pivots> columns_;  // - the sum of y y^T over the first pivots_ of these
    size_t pivots_ = 0;
};

}  // namespace lancer
