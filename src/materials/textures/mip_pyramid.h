// Mip-map pyramids. Each level is the box filter of the previous one in linear light, so that all levels have the same
// mean. Sizes need not be powers of two; for an odd size three texels contribute to two (Guthe and Heckbert, "Non-
// Power-of-Two Mipmapping", NVIDIA, 2005).
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "core/color.h"
#include "core/raster.h"

namespace lancer {

// Channel of a scalar texture. automatic, for opacity only: alpha if the picture has one that is not 1 everywhere, else
// the first channel. alpha is never decoded, and 1 if the picture has none.
enum class Channel : uint8_t { color, red, green, blue, alpha, luminance, automatic };

struct MipLevel {
    uint32_t width = 0, height = 0;
    size_t first = 0;  // index of its first value
    friend bool operator==(const MipLevel&, const MipLevel&) = default;
};

struct MipPyramid {
    uint32_t channels = 1;         // 1 or 3
    std::vector<MipLevel> levels;  // finest first; rows from the top
    // Bytes are decoded by `decode`; halves are used only if the finest level loses no precision.
    std::variant<std::vector<uint8_t>, std::vector<uint16_t>, std::vector<float>> values;
    const float* decode = nullptr;  // 256 numbers, for bytes
    Color mean{};                   // of the finest level; all three alike for 1 channel
    uint64_t not_finite = 0;        // number of values that were not finite; they count as 0

    uint64_t bytes() const;
    // Whether all texels of all levels are equal.
    bool is_constant() const;
    friend bool operator==(const MipPyramid&, const MipPyramid&) = default;
};

// limit: levels with a side longer than this are dropped, in pixels; 0: none. Those that remain are the same.
MipPyramid build_pyramid(const Raster& raster, Encoding encoding, Channel channel, uint32_t limit = 0);

// The memory that build_pyramid() takes beside the raster, at most: what it keeps, and what it frees again.
struct PyramidCost {
    uint64_t kept = 0, working = 0;
};
PyramidCost cost_of_pyramid(const RasterHeader& header, Encoding encoding, Channel channel, uint32_t limit);

}  // namespace lancer
