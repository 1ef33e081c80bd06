#include "app/view/shown.h"

#include <algorithm>
#include <cmath>

#include "app/render/outputs.h"
#include "render/aov.h"
#include "render/denoise/film_halves.h"

namespace lancer {
namespace {

std::vector<Aov> aovs_of(ShownAs what)
{
    switch (what) {
        case ShownAs::albedo:
            return {Aov::albedo};
        case ShownAs::normal:
            return {Aov::normal};
        case ShownAs::depth:
            return {Aov::depth};
        case ShownAs::light:
        case ShownAs::noise:
        case ShownAs::samples:
        case ShownAs::denoised:
            break;
    }
    return {};
}

Color grey(float x) { return {x, x, x}; }

// As Pixel's sums tell it: the darkest parts count as if they were a tenth as bright as 1.
float noise_of(const Pixel& pixel)
{
    const double mean = luminance(pixel.mean());
    return static_cast<float>(std::sqrt(variance_of_mean(pixel) / (mean * mean + 0.01)));
}

}  // namespace

void keep_for(ShownAs what, Film& film)
{
    film.keep_aovs(layout_of(aovs_of(what)));
    if (what == ShownAs::denoised) film.keep_sets({});  // whatever the number of samples will be
}

std::optional<Image> shown_image(const Film& film, ShownAs what, const Normalisation& normalisation, uint32_t most,
                                 const std::stop_token& stop)
{
    Image image = to_image(film);
    if (what == ShownAs::light || (what == ShownAs::denoised && film.sets.empty())) return image;
    if (what == ShownAs::denoised) {
        Denoised denoised = denoise_film(film, UsedSets::all, stop);
        if (denoised.pixels.empty()) return {};
        image.pixels = std::move(denoised.pixels);
        return image;
    }
    const std::vector<ImagePlane> planes = aov_planes(film, aovs_of(what), normalisation);
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        Color& c = image.pixels[i];
        if (what == ShownAs::noise) c = grey(noise_of(film.whole(i)));
        if (what == ShownAs::samples)
            c = grey(static_cast<float>(film.whole(i).n) / static_cast<float>(std::max(most, 1u)));
        if (what == ShownAs::albedo) c = {planes[0].values[i], planes[1].values[i], planes[2].values[i]};
        if (what == ShownAs::normal)
            c = {0.5f + 0.5f * planes[0].values[i], 0.5f + 0.5f * planes[1].values[i],
                 0.5f + 0.5f * planes[2].values[i]};
    }
    if (what == ShownAs::depth) {
        float largest = 0;
        for (const float z : planes[0].values)
            if (std::isfinite(z)) largest = std::max(largest, z);
        for (size_t i = 0; i < image.pixels.size(); ++i)
            image.pixels[i] =
                grey(largest > 0 && std::isfinite(planes[0].values[i]) ? planes[0].values[i] / largest : 1);
    }
    return image;
}

}  // namespace lancer
