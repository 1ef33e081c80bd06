#include "render/estimators/small_picture.h"

#include <algorithm>
#include <cmath>

#include "render/aov.h"

namespace lancer {
namespace {

constexpr double pixels = 3072;  // about
constexpr uint32_t spp = 32;

Film small_film(PictureSize size)
{
    const double shrink = std::min(1.0, std::sqrt(pixels / (double{1} * size.width * size.height)));
    const auto small = [&](uint32_t side) { return std::max(1u, static_cast<uint32_t>(std::lround(shrink * side))); };
    const uint32_t width = small(size.width), height = small(size.height);
    return {width, height, {0, 0, width, height}};
}

}  // namespace

SmallPicture::SmallPicture(const Renderer& renderer, const CameraDescription& view, PictureSize size, PixelGrid grid)
    : film_(small_film(size)), camera_(view, renderer.scene().normalisation, film_.width, film_.height, grid)
{
    film_.keep_aovs(layout_of({Aov::flat}));
    renderer.pass(camera_, film_, make_tiles(film_.crop, 16), {0, spp});
}

double SmallPicture::luminance(size_t pixel) const
{
    const Color c = film_.pixels[pixel].mean();
    return lancer::luminance(double{c.r}, double{c.g}, double{c.b});
}

double SmallPicture::base_color(size_t pixel) const
{
    const auto sum = [&](AovSum of, size_t k) { return film_.whole_aov(pixel, film_.aov_layout.offset(of) + k); };
    const double n = std::max(1.0, sum(AovSum::samples, 0));
    return lancer::luminance(sum(AovSum::flat, 0), sum(AovSum::flat, 1), sum(AovSum::flat, 2)) / n;
}

double quantile(std::vector<Weighted> values, double share)
{
    std::sort(values.begin(), values.end(), [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
    double all = 0, below = 0;
    for (const Weighted& v : values) all += v.weight;
    for (const Weighted& v : values)
        if ((below += v.weight) >= share * all) return v.value;
    return 0;
}

}  // namespace lancer
