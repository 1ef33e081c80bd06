// The sphere of directions in tiles of equal solid angle, so that light sampling can learn which parts of the sky are
// seen from a place. A tile is sampled uniformly.
#pragma once

#include <cmath>
#include <numbers>

#include "core/vec.h"
#include "core/warp.h"

namespace lancer {

struct SkyTiles {
    // Bands of equal height, each with sectors of equal longitude, about y.
    static constexpr uint32_t bands = 8, sectors = 16, count = bands * sectors;
    // Density per solid angle of a direction within its tile.
    static constexpr float pdf = static_cast<float>(count / (4 * std::numbers::pi));

    // The tile of direction d (unit).
    static uint32_t tile_of(Vec3 d)
    {
        const float height = (1 - d.y) * (0.5f * bands);
        const auto band = static_cast<uint32_t>(std::min(std::max(height, 0.0f), bands - 1.0f));
        const float x = std::abs(d.x), z = std::abs(d.z);
        const bool swaps = z > x;
        const bool is_second = std::min(x, z) > tan_sector * std::max(x, z);
        const uint32_t sector =
            uint32_t{is_second} | uint32_t{swaps} << 1 | uint32_t{d.x < 0} << 2 | uint32_t{d.z < 0} << 3;
        return band * sectors + sector;
    }
    // A direction (unit) in the tile, up to rounding; u in [0, 1).
    static Vec3 sample(uint32_t tile, Vec2 u)
    {
        const uint32_t band = tile / sectors, sector = tile % sectors;
        const float y = 1 - (static_cast<float>(band) + u.x) * (2.0f / bands);
        const float radius = std::sqrt(std::max(0.0f, (1 - y) * (1 + y)));
        const SinCos turn = sin_cos_2pi((static_cast<float>(sector & 1) + u.y) / sectors);
        float x = radius * turn.cos, z = radius * turn.sin;
        if (sector & 2) std::swap(x, z);
        return {sector & 4 ? -x : x, y, sector & 8 ? -z : z};
    }

private:
    static constexpr float tan_sector = 0.414213562373f;  // tan(2 pi / sectors)
};

}  // namespace lancer
