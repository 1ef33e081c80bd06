// Blocks of samples and the passes that may end within one: what a pass sums goes on where the one before it stopped,
// in the order of one pass, so that the bits are its bits.
#pragma once

#include <utility>
#include <vector>

#include "core/film.h"

namespace lancer {

// Sum: Pixel or double. sums: of whole blocks; open: of one that is not full, or empty; see Film.
template <class Sum>
struct Blocks {
    std::vector<Sum>&sums, &open;

    // What there is of the block that sample `first` belongs to; it is no longer in the film.
    Sum take(size_t i, uint32_t first)
    {
        if (first % samples_per_block == 0) return {};
        if (first < samples_per_block) return std::exchange(sums[i], {});
        return open.empty() ? Sum{} : std::exchange(open[i], {});
    }
    // The block as it is before sample `end`.
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

// f(i, k) of each pixel of a tile: its place in the film and in the tile, row by row.
template <class F>
void for_pixels(const Film& film, const Tile& tile, const F& f)
{
    size_t k = 0;
    for (uint32_t y = tile.y0; y < tile.y1; ++y)
        for (uint32_t x = tile.x0; x < tile.x1; ++x) f(film.index(x, y), k++);
}

}  // namespace lancer
