// How a picture's paths are to spend their rays: into how many a path splits, and which of them roulette may end. Found
// out by a pilot before the first sample; see render/estimators/pilot.h. Whatever it says, pictures converge to the
// same.
#pragma once

#include <cstdint>
#include <vector>

#include "core/color.h"

namespace lancer {

struct SamplingPlan {
    // Rays that a path sends on from the first vertex that spreads light, each with its share of the throughput.
    uint32_t split = 1;
    // In how many parts the random numbers from there on are dealt: `split`, but in a pilot, where the parts of a path
    // are samples of their own. Part j of sample i has the numbers of sample i * parts + j, so that all of a pixel's
    // are still one low-discrepancy sequence.
    uint32_t parts = 1;

    // The number of the random numbers of a path's first part; its others follow. sample: number of the path's own;
    // part: that of the pilot's sample within its path, else 0. T: uint32_t or several of them.
    template <class T>
    T first_number(T sample, T part) const
    {
        return sample * parts + part;
    }

    // Samples that share the first vertices of a path: those of number i / samples_per_path().
    uint32_t samples_per_path() const { return parts / split; }

    // Of each cell of cell x cell pixels, row by row, and each colour channel: about how much light comes along a ray,
    // as a part of what the pixel shows of it. Empty: roulette knows nothing of pixels.
    uint32_t cell = 0, columns = 0;
    std::vector<Color> importance;

    // Squares of background_cell pixels, row by row, in which no camera ray of the picture meets anything, and what it
    // sees instead is the same everywhere: 1 where that is so. Empty: nowhere.
    uint32_t background_cell = 0, background_columns = 0;
    std::vector<uint8_t> background_only;
    bool is_background_only(uint32_t x, uint32_t y) const
    {
        return !background_only.empty() &&
               background_only[size_t{y / background_cell} * background_columns + x / background_cell] != 0;
    }

    // Of a pixel; negative if it is not known.
    Color importance_at(uint32_t x, uint32_t y) const
    {
        if (importance.empty()) return {-1, -1, -1};
        return importance[size_t{y / cell} * columns + x / cell];
    }
};

}  // namespace lancer
