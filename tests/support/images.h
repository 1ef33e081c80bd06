// Pictures by name, made up on the spot, as if files held them: what the textures of the test scenes show.
#pragma once

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/raster.h"

namespace lancer {

// Three bytes or one for each pixel, from f(x, y, channel) in [0, 1] over the centres of a size x size picture.
template <class F>
std::shared_ptr<const Raster> make_bytes(uint32_t size, uint32_t channels, const F& f)
{
    Raster r;
    r.width = r.height = size;
    r.channels = channels;
    for (uint32_t y = 0; y < size; ++y)
        for (uint32_t x = 0; x < size; ++x)
            for (uint32_t c = 0; c < channels; ++c)
                r.bytes.push_back(
                    static_cast<uint8_t>(std::lround(255 * f((x + 0.5) / size, 1 - (y + 0.5) / size, c))));
    return std::make_shared<const Raster>(std::move(r));
}

std::shared_ptr<const Raster> make_picture(const std::string& name);

// For Scene::build. A name that is no picture here cannot be read.
RasterFuture test_picture(const std::string& name);

}  // namespace lancer
