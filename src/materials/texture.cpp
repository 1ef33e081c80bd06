#include "materials/texture.h"

#include <algorithm>
#include <cmath>

namespace lancer {

ImageTexture::ImageTexture(const Raster& raster, const ImageUse& use)
    : use_(use), width_(raster.width), height_(raster.height)
{
    const auto table = make_linear_table(use.encoding, 256);
    pixels_.resize(size_t{width_} * height_);
    const auto value = [&](size_t pixel, uint32_t channel) {
        const size_t i = pixel * raster.channels + std::min(channel, raster.channels - 1);
        return raster.is_float || raster.bytes.empty() ? raster.floats[i] : table[raster.bytes[i]];
    };
    for (size_t i = 0; i < pixels_.size(); ++i)
        pixels_[i] = raster.channels < 3 ? Color{value(i, 0), value(i, 0), value(i, 0)}
                                         : Color{value(i, 0), value(i, 1), value(i, 2)};
}

Color ImageTexture::eval(Vec2 uv, float) const
{
    const auto wrapped = [](float x) { return x - std::floor(x); };
    const float u = wrapped(uv.x * use_.scale.x + use_.offset.x), v = wrapped(uv.y * use_.scale.y + use_.offset.y);
    const auto x = std::min(static_cast<uint32_t>(u * static_cast<float>(width_)), width_ - 1);
    const auto y = std::min(static_cast<uint32_t>((1 - v) * static_cast<float>(height_)), height_ - 1);
    const Color c = pixels_[size_t{y} * width_ + x] * use_.gain;
    return c + Color{use_.bias, use_.bias, use_.bias};
}

Vec2 ImageTexture::slope(Vec2 uv, float width) const
{
    const float du = 1 / static_cast<float>(width_), dv = 1 / static_cast<float>(height_);
    const float here = eval(uv, width).r;
    return {eval(uv + Vec2{du, 0}, width).r - here, eval(uv + Vec2{0, dv}, width).r - here};
}

}  // namespace lancer
