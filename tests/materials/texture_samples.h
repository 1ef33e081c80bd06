// Pictures to make textures of.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "materials/textures/texture.h"
#include "support/random.h"

namespace lancer {

struct Size {
    uint32_t width, height;
};
inline const std::vector<Size> odd_and_even_sizes = {{1, 1}, {1, 5},  {2, 2},   {3, 7},
                                                     {8, 4}, {13, 6}, {64, 64}, {61, 47}};

// f(x, y, c) in [0, 255]; rows from the top.
template <class F>
Raster byte_raster(Size size, uint32_t channels, const F& f)
{
    Raster r = {.width = size.width, .height = size.height, .channels = channels, .bytes = {}, .floats = {}};
    for (uint32_t y = 0; y < size.height; ++y)
        for (uint32_t x = 0; x < size.width; ++x)
            for (uint32_t c = 0; c < channels; ++c) r.bytes.push_back(static_cast<uint8_t>(f(x, y, c)));
    return r;
}
template <class F>
Raster float_raster(Size size, uint32_t channels, const F& f)
{
    Raster r = {
        .width = size.width, .height = size.height, .channels = channels, .bytes = {}, .floats = {}, .is_float = true};
    for (uint32_t y = 0; y < size.height; ++y)
        for (uint32_t x = 0; x < size.width; ++x)
            for (uint32_t c = 0; c < channels; ++c) r.floats.push_back(static_cast<float>(f(x, y, c)));
    return r;
}

}  // namespace lancer
