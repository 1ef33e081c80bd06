// The texels of a picture at every size down to 1 x 1, as textures look them up. Each level is the box filter, in
// linear light, of the one before: every texel counts alike, so all levels have the same mean. Sizes need not be powers
// of two; where one is odd, three texels share in two (Guthe and Heckbert, "Non-Power-of-Two Mipmapping", NVIDIA,
// 2005).
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "core/color.h"
#include "core/raster.h"

namespace lancer {

// Which channel a texture of one number is taken from. automatic: alpha if the picture has one that is not 1
// everywhere, else the first; for opacity only. alpha is never decoded, and 1 where a picture has none.
enum class Channel : uint8_t { color, red, green, blue, alpha, luminance, automatic };

struct MipLevel {
    uint32_t width = 0, height = 0;
    size_t first = 0;  // where its values begin
    friend bool operator==(const MipLevel&, const MipLevel&) = default;
};

struct MipPyramid {
    uint32_t channels = 1;         // 1 or 3
    std::vector<MipLevel> levels;  // finest first; rows from the top
    // Bytes stand for the numbers of `decode`; halves only where the finest level loses nothing by it.
    std::variant<std::vector<uint8_t>, std::vector<uint16_t>, std::vector<float>> values;
    const float* decode = nullptr;  // 256 numbers, for bytes
    Color mean{};                   // of the finest level; all three alike for 1 channel
    uint64_t not_finite = 0;        // numbers of the picture that were not, and count as 0

    uint64_t bytes() const;
    // Whether all texels of all levels are alike.
    bool is_constant() const;
    friend bool operator==(const MipPyramid&, const MipPyramid&) = default;
};

MipPyramid build_pyramid(const Raster& raster, Encoding encoding, Channel channel);

}  // namespace lancer
