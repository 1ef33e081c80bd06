// Pictures in code, for textures and environments.
#pragma once

#include <future>

#include "core/color.h"
#include "core/raster.h"

namespace lancer {

// Linear floats; f(x, y) is the Color of a pixel, rows from the top.
template <class F>
Raster make_raster(uint32_t width, uint32_t height, const F& f)
{
    Raster r{.width = width, .height = height, .channels = 3, .bytes = {}, .floats = {}, .is_float = true};
    r.floats.resize(r.value_count());
    for (size_t i = 0; i < r.floats.size(); i += 3) {
        const auto pixel = static_cast<uint32_t>(i / 3);
        const Color c = f(pixel % width, pixel / width);
        r.floats[i] = c.r, r.floats[i + 1] = c.g, r.floats[i + 2] = c.b;
    }
    return r;
}

// Gives this picture for every file.
inline RasterSource picture_source(Raster raster)
{
    std::promise<std::shared_ptr<const Raster>> promise;
    promise.set_value(std::make_shared<const Raster>(std::move(raster)));
    return [future = promise.get_future().share()](const std::string&) { return future; };
}

}  // namespace lancer
