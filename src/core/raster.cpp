#include "core/raster.h"

#include <algorithm>
#include <cmath>

namespace lancer {

LinearValues::LinearValues(const Raster& raster, Encoding encoding) : raster_(raster)
{
    if (!raster.is_float) table_ = make_linear_table(encoding, raster.floats.empty() ? 256 : 65536);
}

float LinearValues::operator[](size_t i) const
{
    if (raster_.floats.empty()) return table_[raster_.bytes[i]];
    const float v = raster_.floats[i];
    if (raster_.is_float) return v;
    const auto last = static_cast<float>(table_.size() - 1);
    return table_[static_cast<size_t>(std::lround(std::clamp(v, 0.0f, 1.0f) * last))];
}

Image to_image(const Raster& raster, Encoding encoding)
{
    const LinearValues value(raster, encoding);
    Image image = make_image(static_cast<int32_t>(raster.width), static_cast<int32_t>(raster.height));
    const size_t green = raster.channels < 3 ? 0 : 1, blue = 2 * green;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        const size_t first = i * raster.channels;
        image.pixels[i] = {value[first], value[first + green], value[first + blue]};
    }
    return image;
}

}  // namespace lancer
