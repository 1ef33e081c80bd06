#include "core/raster.h"

#include <algorithm>
#include <cmath>

namespace lancer {

void divide_by_alpha(Raster& raster)
{
    if (!raster.has_alpha()) return;
    const size_t channels = raster.channels, colors = channels - 1;
    for (size_t first = 0; first < raster.bytes.size(); first += channels) {
        const uint32_t alpha = raster.bytes[first + colors];
        if (alpha == 0 || alpha == 255) continue;
        for (size_t c = 0; c < colors; ++c) {
            uint8_t& v = raster.bytes[first + c];
            v = static_cast<uint8_t>(std::min((v * 255u + alpha / 2) / alpha, 255u));
        }
    }
    for (size_t first = 0; first < raster.floats.size(); first += channels) {
        const float alpha = raster.floats[first + colors];
        if (!(alpha > 0) || alpha == 1 || !std::isfinite(alpha)) continue;
        for (size_t c = 0; c < colors; ++c) raster.floats[first + c] /= alpha;
    }
}

LinearValues::LinearValues(const Raster& raster, Encoding encoding) : raster_(raster)
{
    if (!raster.is_float) table_ = make_linear_table(encoding, raster.floats.empty() ? 256 : 65536, raster.exponent);
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

bool looks_like_normals(const Raster& raster)
{
    if (raster.channels < 3 || raster.is_float) return false;
    const LinearValues value(raster, Encoding::linear);
    constexpr uint32_t samples = 64;  // along each side, at most
    constexpr double off_unit = 0.15, share = 0.9;
    const uint32_t step_x = (raster.width + samples - 1) / samples, step_y = (raster.height + samples - 1) / samples;
    uint64_t count = 0, unit = 0;
    double z = 0, tint = 0;
    for (uint32_t y = 0; y < raster.height; y += step_y)
        for (uint32_t x = 0; x < raster.width; x += step_x) {
            const size_t first = (size_t{y} * raster.width + x) * raster.channels;
            const auto part = [&](size_t k) { return 2 * static_cast<double>(value[first + k]) - 1; };
            const double length = std::sqrt(part(0) * part(0) + part(1) * part(1) + part(2) * part(2));
            ++count;
            unit += std::abs(length - 1) < off_unit ? 1 : 0;
            z += part(2), tint += std::abs(part(2) - part(0));
        }
    const auto n = static_cast<double>(count);
    return static_cast<double>(unit) >= share * n && z > 0.5 * n && tint > 0.3 * n;
}

}  // namespace lancer
