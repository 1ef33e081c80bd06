#include "core/raster.h"

#include <algorithm>
#include <cmath>

namespace lancer {

Image to_image(const Raster& raster, Encoding encoding)
{
    constexpr size_t steps = 65536;  // integers of more than 16 bits are rounded to these
    const bool is_bytes = raster.floats.empty();
    const std::vector<float> table = make_linear_table(encoding, is_bytes ? 256 : steps);
    const auto value = [&](size_t i) {
        if (is_bytes) return table[raster.bytes[i]];
        const float v = raster.floats[i];
        if (raster.is_float) return v;
        return table[static_cast<size_t>(std::lround(std::clamp(v, 0.0f, 1.0f) * (steps - 1)))];
    };
    Image image = make_image(static_cast<int32_t>(raster.width), static_cast<int32_t>(raster.height));
    const size_t green = raster.channels < 3 ? 0 : 1, blue = 2 * green;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        const size_t first = i * raster.channels;
        image.pixels[i] = {value(first), value(first + green), value(first + blue)};
    }
    return image;
}

}  // namespace lancer
