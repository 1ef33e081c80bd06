// Conversion of linear light to 8 bits for the writers of PNG, PPM and JPEG.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/image.h"
#include "io/image/tonemap.h"

namespace lancer {

// Turns linear light into code values, 0 to 1 in range.
using CodeCurve = std::function<void(std::span<Color> pixels)>;

struct ByteOptions {
    float exposure_stops = 0;  // pixels are scaled by 2^stops
    bool dither = false;       // hides banding with a fixed pattern of +- half a step
    ToneMap tonemap = ToneMap::srgb;
    CodeCurve curve{};  // if there is one, in place of the tone map
};

// Three bytes for each pixel of the data window: code values below 0 and NaN become 0, above 1 they become 255, else
// the nearest step, or the one below where the tone map is of the kind that rounds down and nothing is dithered.
std::vector<uint8_t> to_bytes(const Image& image, const ByteOptions& options);

}  // namespace lancer
