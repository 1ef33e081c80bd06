#include "render/estimators/own_light.h"

#include <algorithm>
#include <vector>

#include "core/frame.h"
#include "core/sampler.h"
#include "core/warp.h"
#include "render/estimators/small_picture.h"

namespace lancer {
namespace {

constexpr uint32_t directions = 16;    // of the sky, from each place
constexpr int most_panes = 8;          // that a ray passes
constexpr double least_share = 0.25;   // of a sky's light, for a place to count as lit
constexpr double least_albedo = 0.02;  // what is darker shows no light

// The first surface that is not of glass, seen straight through what is; no hit: the sky.
struct Sight {
    Hit hit;
    Ray ray;  // that ends there
};
Sight look(const Renderer& renderer, Ray ray)
{
    const Scene& scene = renderer.scene();
    for (int pane = 0;; ++pane) {
        const Hit hit = renderer.accelerator().closest(ray);
        if (!hit || pane == most_panes || !scene.lets_through(scene.material_of(hit))) return {hit, ray};
        ray.org = ray_origin(surface_at(scene, ray, hit), ray.dir);
    }
}

double open_part(const Renderer& renderer, const Surface& surface, uint64_t place)
{
    const Frame frame(surface.n);
    double open = 0;
    for (uint32_t i = 0; i < directions; ++i) {
        const Vec2 u = Sampler::independent2(place, i);
        const Vec3 wi =
            normalize(frame.to_world(square_to_cosine_hemisphere({(static_cast<float>(i) + u.x) / directions, u.y})));
        if (!look(renderer, {.org = ray_origin(surface, wi), .dir = wi}).hit) open += 1.0 / directions;
    }
    return open;
}

}  // namespace

OwnLight measure_own_light(const Renderer& renderer, const CameraDescription& view, PictureSize size, double sky)
{
    const Scene& scene = renderer.scene();
    const SmallPicture picture(renderer, view, size, PixelGrid::centres);
    std::vector<Weighted> levels;
    double open = 0, lit = 0;
    for (uint32_t y = 0; y < picture.height(); ++y)
        for (uint32_t x = 0; x < picture.width(); ++x) {
            const Vec2 middle{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
            const Sight seen = look(renderer, picture.camera().middle_ray(middle));
            if (!seen.hit || !scene.emission[scene.material_of(seen.hit)].is_dark()) continue;
            const size_t i = picture.index(x, y);
            const double part = open_part(renderer, surface_at(scene, seen.ray, seen.hit), i);
            const double level = picture.luminance(i) / (sky * std::max(least_albedo, picture.base_color(i)));
            levels.push_back({level, 1});
            open += part;
            if (level >= least_share * part) lit += 1;
        }
    if (levels.empty()) return {};
    const auto places = static_cast<double>(levels.size());
    return {.open = open / places, .lit = lit / places, .level = quantile(levels, 0.5)};
}

}  // namespace lancer
