#include "render/light_layers.h"

#include <array>
#include <string>

namespace lancer {
namespace {

// In the order of PathSegment.
constexpr std::array<const char*, path_segments> names_of_segments{"emission", "direct", "indirect"};
// In the order of Lobe.
constexpr std::array<const char*, path_lobes> names_of_lobes{"lobe.emission", "lobe.diffuse", "lobe.glossy",
                                                             "lobe.transmission"};

std::vector<Color> pixels_of(const Film& film, uint32_t layer)
{
    std::vector<Color> pixels;
    pixels.reserve(film.pixels.size());
    for (size_t i = 0; i < film.pixels.size(); ++i) {
        const std::array<double, 3> sum = film.layer(i, layer);
        pixels.push_back(Pixel{.sum = sum, .n = film.whole(i).n}.mean());
    }
    return pixels;
}

std::string name_of(uint32_t layer, const LayerLayout& layout, const std::vector<std::string>& groups)
{
    if (layer < layout.groups) return "light." + groups[layer];
    if (layer < layout.first_lobe()) return names_of_segments[layer - layout.groups];
    return names_of_lobes[layer - layout.first_lobe()];
}

void add_planes(const std::string& name, const std::vector<Color>& pixels, std::vector<ImagePlane>& planes)
{
    const size_t first = planes.size();
    for (const char* channel : {".R", ".G", ".B"}) {
        planes.push_back({name + channel, {}});
        planes.back().values.reserve(pixels.size());
    }
    for (const Color& c : pixels) {
        planes[first].values.push_back(c.r);
        planes[first + 1].values.push_back(c.g);
        planes[first + 2].values.push_back(c.b);
    }
}

}  // namespace

std::vector<ImagePlane> layer_planes(const Film& film, const std::vector<std::string>& groups,
                                     const std::vector<std::vector<Color>>& denoised)
{
    std::vector<ImagePlane> planes;
    for (uint32_t k = 0; k < film.layers.size(); ++k) {
        add_planes(name_of(k, film.layers, groups), denoised.empty() ? pixels_of(film, k) : denoised[k], planes);
    }
    return planes;
}

}  // namespace lancer
