// Where points are sampled on a triangle whose radiance is a picture: a density over the square of random numbers that
// square_to_triangle() maps to the triangle, constant in each cell of a grid.
#pragma once

#include <cstdint>
#include <vector>

#include "core/vec.h"

namespace lancer {

class EmissionMap {
public:
    // weights: of side x side cells, rows of the second number; finite, > 0. side: a power of two.
    EmissionMap(const std::vector<double>& weights, uint32_t side);

    // A point of the square, and its density relative to a uniform one.
    struct Place {
        Vec2 u;
        float density;
    };
    // u: uniform in [0, 1)^2.
    Place sample(Vec2 u) const;
    float density(Vec2 u) const;

private:
    // Cumulative probabilities within each row, and of the rows.
    std::vector<float> in_row_, rows_;
    uint32_t side_;
};

// Variance of the weights relative to the square of their mean.
double relative_variance(const std::vector<double>& weights);

}  // namespace lancer
