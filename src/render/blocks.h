// Passes that end within a block of samples: the next pass continues the partial sums in the order of a single pass and
// therefore has its bits.
#pragma once

#include <utility>
#include <vector>

#include "core/film.h"

namespace lancer {

// Sum: Pixel or double. sums: of complete blocks; open: of a partial block, or empty; see Film.
template <class Sum>
struct Blocks {
    std::vector<Sum>&sums, &open;

    // Takes the partial block of sample `first` out of the film.
    Sum take(size_t i, uint32_t first)
    {
        if (first % samples_per_block == 0) return {};
        if (first < samples_per_block) return std::exchange(sums[i], {});
        return open.empty() ? Sum{} : std::exchange(open[i], {});
    }
    // Stores the block as it is before sample `end`.
    void put(size_t i, const Sum& block, uint32_t end)
    {
        if (end % samples_per_block != 0 && end > samples_per_block && !open.empty())
            open[i] = block;
        else
            sums[i] += block;
    }
};
template <class Sum>
Blocks(std::vector<Sum>&, std::vector<Sum>&) -> Blocks<Sum>;

// Calls f(i, k) for each pixel of a tile, row by row; i: index in the film, k: index in the tile.
template <class F>
void for_pixels(const Film& film, const Tile& tile, const F& f)
{
    size_t k = 0;
    for (uint32_t y = tile.y0; y < tile.y1; ++y)
        for (uint32_t x = tile.x0; x < tile.x1; ++x) f(film.index(x, y), k++);
}

}  // namespace lancer
