// How often light is sampled and which light is chosen, by place, as a pilot learned it. Where few shadow rays arrive,
// as in a room whose window shows little of the sky, most vertices leave light to BSDF sampling: a light sample is
// taken with probability q, weighs 1 / q, and q times its density counts in multiple importance sampling. Of several
// lights the one is chosen that brings most; so is a tile of the sky, as in a room whose window shows a part of it. The
// expected value does not depend on any of these. Learned choice: Vevoda, Kondapaneni, Krivanek, "Bayesian Online
// Regression for Adaptive Direct Illumination Sampling", 2018.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/vec.h"
#include "scene/environment/sky_tiles.h"

namespace lancer {

// A grid of places, with six directions of the surface's normal in each.
struct LightChoice {
    static constexpr uint32_t most_cells = 24;   // along an axis
    static constexpr uint32_t most_lights = 64;  // that are chosen by place
    static constexpr uint8_t lowest = 3;         // rates are 2^-0 to 2^-lowest

    Vec3 low{};                             // corner of the grid, scene units
    float per_unit = 0;                     // cells; a power of two, or 0 for one cell
    std::array<uint32_t, 3> size{1, 1, 1};  // number of cells along each axis
    std::vector<uint32_t> cell_at;          // of index_in(); empty: nothing was learned
    std::vector<uint8_t> exponents;         // q = 2^-exponent, of each cell
    uint32_t lights = 0;                    // that are chosen by place; 0: the choice is that of LightTable
    bool has_tiles = false;                 // behind the lights, the tiles of the sky are chosen by place
    std::vector<float> cumulative;          // probabilities of what each cell chooses from, summed; the last is 1

    bool empty() const { return cell_at.empty(); }
    bool chooses() const { return lights > 0; }
    // Number of lights and tiles.
    uint32_t options() const { return lights + (has_tiles ? SkyTiles::count : 0); }
    bool is_tile(uint32_t option) const { return option >= lights; }

    // Index in a grid of this size. side: direction of the normal, 0 to 5.
    static size_t index_in(const std::array<uint32_t, 3>& size, uint32_t x, uint32_t y, uint32_t z, uint32_t side)
    {
        return ((size_t{z} * size[1] + y) * size[0] + x) * 6 + side;
    }
    static size_t indices_in(const std::array<uint32_t, 3>& size) { return size_t{6} * size[0] * size[1] * size[2]; }
    // Index of a place and a normal. Places outside of the grid belong to its border.
    size_t index_of(Vec3 p, Vec3 n) const
    {
        const auto along = [&](float x, float from, uint32_t count) {
            const float place = (x - from) * per_unit, last = static_cast<float>(count - 1);
            return static_cast<uint32_t>(place > 0 ? (place < last ? place : last) : 0.0f);
        };
        return index_in(size, along(p.x, low.x, size[0]), along(p.y, low.y, size[1]), along(p.z, low.z, size[2]),
                        side_of(n));
    }
    // The cell there. Places of which nothing is known share those of larger surroundings.
    uint32_t cell_of(Vec3 p, Vec3 n) const { return cell_at[index_of(p, n)]; }
    float rate(uint32_t cell) const { return rate_of(exponents[cell]); }
    static float rate_of(uint8_t exponent) { return 1.0f / static_cast<float>(1u << exponent); }

    // A light or a tile for u in [0, 1). Only if chooses(), like the next two.
    struct Chosen {
        uint32_t option;
        float probability;
    };
    Chosen choose(uint32_t cell, float u) const
    {
        const float* const sums = &cumulative[size_t{cell} * options()];
        const auto option = static_cast<uint32_t>(std::upper_bound(sums, sums + options() - 1, u) - sums);
        return {option, probability(cell, option)};
    }
    float probability(uint32_t cell, uint32_t option) const
    {
        const float* const sums = &cumulative[size_t{cell} * options()];
        return sums[option] - (option == 0 ? 0 : sums[option - 1]);
    }
    // Density per solid angle with which the tiles are sampled in direction wi (unit); 0 without tiles.
    float pdf_of_tiles(uint32_t cell, Vec3 wi) const
    {
        return has_tiles ? probability(cell, lights + SkyTiles::tile_of(wi)) * SkyTiles::pdf : 0;
    }

private:
    // The axis along which the normal is longest, and its sign.
    static uint32_t side_of(Vec3 n)
    {
        const float x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
        if (x >= y && x >= z) return n.x < 0;
        if (y >= z) return 2 + (n.y < 0);
        return 4 + (n.z < 0);
    }
};

}  // namespace lancer
