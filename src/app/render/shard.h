// Which part of a picture a shard is, and where a cluster says it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/options/options.h"
#include "core/film.h"

namespace lancer {

// The tiles of the crop that the shard has: scattered over the picture, so that shards have about the same work. Those
// of all shards cover it once. Empty if there are more shards than pixels.
std::vector<Tile> tiles_of(const Shard& shard, const Tile& crop);

// Calls f(x, y) for each pixel of the tiles.
template <class F>
void for_pixels_of(const std::vector<Tile>& tiles, const F& f)
{
    for (const Tile& t : tiles)
        for (uint32_t y = t.y0; y < t.y1; ++y)
            for (uint32_t x = t.x0; x < t.x1; ++x) f(x, y);
}
// Their number.
uint64_t pixels_of(const std::vector<Tile>& tiles);

// What of the crop none of the tiles has.
std::vector<Tile> tiles_without(const std::vector<Tile>& tiles, const Tile& crop);

// "3/8"; "auto": as Slurm (array, srun), Open MPI or PMI say in the environment. variable: the value of a variable,
// null where there is none. Throws Error (usage), for auto with what was looked for.
Shard to_shard(const std::string& text, const std::function<const char*(const char*)>& variable);

}  // namespace lancer
