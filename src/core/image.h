// A picture in memory: linear RGB, whole or a crop of a larger picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/color.h"

namespace lancer {

// A half-open rectangle of pixels; x to the right, y downwards.
struct Window {
    int32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    constexpr int32_t width() const { return x1 - x0; }
    constexpr int32_t height() const { return y1 - y0; }
    constexpr size_t area() const { return static_cast<size_t>(width()) * static_cast<size_t>(height()); }
    constexpr bool empty() const { return x1 <= x0 || y1 <= y0; }
    friend constexpr bool operator==(const Window&, const Window&) = default;
};

struct Image {
    Window display;             // the whole picture
    Window data;                // the part that has pixels
    std::vector<Color> pixels;  // rows of the data window, top first

    // The pixel at (x, y) of the picture; the data window must contain it.
    Color& at(int32_t x, int32_t y) { return pixels[index(x, y)]; }
    const Color& at(int32_t x, int32_t y) const { return pixels[index(x, y)]; }

private:
    size_t index(int32_t x, int32_t y) const
    {
        return static_cast<size_t>(y - data.y0) * static_cast<size_t>(data.width()) + static_cast<size_t>(x - data.x0);
    }
};

// One more number for each pixel of an image, under a name: "depth.Z".
struct ImagePlane {
    std::string name;
    std::vector<float> values;  // as Image::pixels
};

// A black image of `data` within `display`.
inline Image make_image(const Window& display, const Window& data)
{
    return {display, data, std::vector<Color>(data.empty() ? 0 : data.area())};
}
inline Image make_image(int32_t width, int32_t height)
{
    return make_image({0, 0, width, height}, {0, 0, width, height});
}

}  // namespace lancer
