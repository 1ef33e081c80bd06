#include "render/estimators/auto_exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/estimators/small_picture.h"

namespace lancer {
namespace {

constexpr double middle = 0.21, middle_albedo = 0.4;  // the luminance that a median base colour gets
constexpr double adaptation = 0.4;                    // the power of base colours with which it goes

// Where much of the picture would be burnt out, as by the sun in a room or around a dark object, the median gets
// darker, down to `least`.
constexpr double white = 0.85, share_below_white = 0.92, least = 0.08;

// The part of each pixel that shows an object, by four rays.
std::vector<double> coverage_of_objects(const Renderer& renderer, const SmallPicture& picture)
{
    const Scene& scene = renderer.scene();
    const auto shows_object = [&](float x, float y) {
        const Hit hit = renderer.accelerator().closest(picture.camera().middle_ray({x, y}));
        return hit && hit.kind != Kind::plane && scene.emission[scene.material_of(hit)].is_dark();
    };
    std::vector<double> coverage;
    for (uint32_t y = 0; y < picture.height(); ++y)
        for (uint32_t x = 0; x < picture.width(); ++x) {
            int seen = 0;
            for (const float dx : {0.25f, 0.75f})
                for (const float dy : {0.25f, 0.75f})
                    seen += shows_object(static_cast<float>(x) + dx, static_cast<float>(y) + dy);
            coverage.push_back(seen / 4.0);
        }
    return coverage;
}

// What counts of each pixel. At edges pixels mix objects with what is behind them: they count only in want of others.
std::vector<double> weights_of(std::vector<double> coverage)
{
    for (const double enough : {1.0, 0.25})
        if (std::any_of(coverage.begin(), coverage.end(), [&](double c) { return c >= enough; })) {
            for (double& c : coverage) c = c >= enough ? c : 0;
            return coverage;
        }
    return std::vector<double>(coverage.size(), 1);
}

// Where light is found by chance, most pixels are too dark and few far too bright; the median would be too low. The
// mean of a pixel and its neighbours of the same kind is less so.
double smoothed_luminance(const SmallPicture& picture, const std::vector<double>& weights, uint32_t x, uint32_t y)
{
    double sum = 0, all = 0;
    for (uint32_t v = y == 0 ? 0 : y - 1; v < std::min(picture.height(), y + 2); ++v)
        for (uint32_t u = x == 0 ? 0 : x - 1; u < std::min(picture.width(), x + 2); ++u) {
            const size_t i = picture.index(u, v);
            sum += weights[i] * picture.luminance(i), all += weights[i];
        }
    return all > 0 ? sum / all : 0;
}

}  // namespace

float auto_exposure(const Renderer& renderer, const CameraDescription& view, PictureSize size, PixelGrid grid)
{
    const SmallPicture picture(renderer, view, size, grid);
    const std::vector<double> weights = weights_of(coverage_of_objects(renderer, picture));
    std::vector<Weighted> lights, base_colors, all;
    for (uint32_t y = 0; y < picture.height(); ++y)
        for (uint32_t x = 0; x < picture.width(); ++x) {
            const size_t i = picture.index(x, y);
            all.push_back({picture.luminance(i), 1});
            if (weights[i] == 0) continue;
            lights.push_back({smoothed_luminance(picture, weights, x, y), weights[i]});
            base_colors.push_back({picture.base_color(i), weights[i]});
        }
    const double median = quantile(lights, 0.5), metered = median > 0 ? median : quantile(lights, 1);
    if (!(metered > 0)) return 0;
    const double albedo = std::clamp(quantile(base_colors, 0.5), 0.02, 1.0);
    const double target = middle * std::pow(albedo / middle_albedo, adaptation);
    const double wanted = std::log2(target / metered), darkest = std::log2(least / metered);
    const double brightest = std::log2(white / std::max(metered, quantile(all, share_below_white)));
    const double stops = std::clamp(std::max(std::min(wanted, brightest), std::min(wanted, darkest)), -60.0, 60.0);
    return static_cast<float>(std::round(10 * stops) / 10) + 0.0f;  // no -0
}

}  // namespace lancer
