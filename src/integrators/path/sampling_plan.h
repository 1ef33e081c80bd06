// How the paths of a picture use their rays: path splitting, adjoint-driven Russian roulette, where light is sampled. A
// pilot estimates it before the first sample (render/estimators/pilot.h). The expected value of the picture does not
// depend on it.
#pragma once

#include <cstdint>
#include <vector>

#include "core/color.h"
#include "integrators/path/light_choice.h"

namespace lancer {

struct SamplingPlan {
    // Number of rays into which a path splits at its first diffuse or rough vertex, each with its share of the
    // throughput.
    uint32_t split = 1;
    // Number of parts into which the random numbers behind the split are divided. It equals `split`, except in a pilot,
    // where each part is a sample. Part j of sample i uses the numbers of sample i * parts + j, so that all parts of a
    // pixel form one low-discrepancy sequence.
    uint32_t parts = 1;

    // Sampler index of a path's first part; the other parts follow. sample: index of the path's sample; part: index of
    // the pilot's sample within its path, else 0. T: uint32_t or a vector of them.
    template <class T>
    T first_number(T sample, T part) const
    {
        return sample * parts + part;
    }

    // Number of samples that share the first vertices of a path: those with the same index / samples_per_path().
    uint32_t samples_per_path() const { return parts / split; }

    // Importance map: for each cell of cell x cell pixels, row by row, and each colour channel the radiance expected
    // along a ray, relative to the radiance of the pixel. Empty: roulette uses the throughput alone.
    uint32_t cell = 0, columns = 0;
    std::vector<Color> importance;

    // Squares of background_cell pixels, row by row: 1 where no camera ray hits anything and the background is
    // constant. Empty: none.
    uint32_t background_cell = 0, background_columns = 0;
    std::vector<uint8_t> background_only;
    bool is_background_only(uint32_t x, uint32_t y) const
    {
        return !background_only.empty() &&
               background_only[size_t{y / background_cell} * background_columns + x / background_cell] != 0;
    }

    LightChoice light_choice;

    // Importance for a pixel; negative if it is unknown.
    Color importance_at(uint32_t x, uint32_t y) const
    {
        if (importance.empty()) return {-1, -1, -1};
        return importance[size_t{y / cell} * columns + x / cell];
    }
};

}  // namespace lancer
