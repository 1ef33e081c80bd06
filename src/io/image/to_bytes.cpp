#include "io/image/to_bytes.h"

namespace lancer {
namespace {

// A number in [0, 1) for each channel of each pixel: fixed, so that the same picture gives the same file.
double dither_offset(uint32_t x, uint32_t y, uint32_t channel)
{
    uint32_t h = x * 0x9e3779b1u ^ (y * 0x85ebca77u + channel * 0xc2b2ae3du);
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    return (h ^ (h >> 16)) * 0x1p-32;
}

// The code values of a row, scaled by the exposure first.
std::vector<std::array<double, 3>> code_values(std::span<const Color> row, const ByteOptions& options)
{
    const double scale = std::exp2(static_cast<double>(options.exposure_stops));
    std::vector<std::array<double, 3>> values;
    for (const Color& c : row) values.push_back({scale * double{c.r}, scale * double{c.g}, scale * double{c.b}});
    if (!options.curve) {
        for (auto& v : values) v = to_display(options.tonemap, v);
        return values;
    }
    std::vector<Color> pixels;
    for (const auto& v : values)
        pixels.push_back({static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])});
    options.curve(pixels);
    for (size_t i = 0; i < pixels.size(); ++i) values[i] = {pixels[i].r, pixels[i].g, pixels[i].b};
    return values;
}

}  // namespace

std::vector<uint8_t> to_bytes(const Image& image, const ByteOptions& options)
{
    std::vector<uint8_t> bytes;
    bytes.reserve(3 * image.pixels.size());
    const double rounding = !options.curve && rounds_down(options.tonemap) ? 0 : 0.5;
    const auto width = static_cast<size_t>(image.data.width());
    for (int32_t y = image.data.y0; y < image.data.y1; ++y) {
        const std::vector<std::array<double, 3>> row =
            code_values(std::span(&image.at(image.data.x0, y), width), options);
        for (int32_t x = image.data.x0; x < image.data.x1; ++x) {
            const std::array<double, 3>& values = row[static_cast<size_t>(x - image.data.x0)];
            for (uint32_t i = 0; i < 3; ++i) {
                const double offset =
                    options.dither ? dither_offset(static_cast<uint32_t>(x), static_cast<uint32_t>(y), i) : rounding;
                bytes.push_back(values[i] >= 1 ? 255
                                               : static_cast<uint8_t>(values[i] > 0 ? values[i] * 255 + offset : 0));
            }
        }
    }
    return bytes;
}

}  // namespace lancer
