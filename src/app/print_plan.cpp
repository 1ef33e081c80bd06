#include "app/print_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "app/console.h"
#include "core/parallel.h"
#include "io/image/png.h"

namespace lancer {
namespace {

void print_field(const char* name, const std::string& value) { print_result(format_text("%-13s ", name) + value); }

std::string rates_of(const LightChoice& choice)
{
    std::array<uint32_t, LightChoice::lowest + 1> places{};
    for (const uint32_t cell : choice.cell_at) ++places[choice.exponents[cell]];
    std::string text;
    for (uint32_t i = 0; i < places.size(); ++i)
        text += (i ? ", 1/" + std::to_string(1u << i) + " at " : "always at ") +
                format_text("%.0f %%", 100.0 * places[i] / static_cast<double>(choice.cell_at.size()));
    return text;
}

// Mean over the places of the probability of an option.
double mean_probability(const LightChoice& choice, uint32_t option)
{
    double sum = 0;
    for (const uint32_t cell : choice.cell_at) sum += double{choice.probability(cell, option)};
    return sum / static_cast<double>(choice.cell_at.size());
}

// One row for each band of the sky from the zenith down, by longitude.
void print_sky(const LightChoice& choice)
{
    print_field("sky", "percent of the light samples to each part, zenith first, from longitude -180 to 180 about y");
    std::array<uint32_t, SkyTiles::sectors> order;
    std::iota(order.begin(), order.end(), 0u);
    const auto longitude = [](uint32_t sector) {
        const Vec3 d = SkyTiles::sample(sector, {0.5f, 0.5f});
        return std::atan2(d.z, d.x);
    };
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return longitude(a) < longitude(b); });
    for (uint32_t band = 0; band < SkyTiles::bands; ++band) {
        std::string row;
        for (const uint32_t sector : order)
            row += format_text(" %4.1f",
                               100 * mean_probability(choice, choice.lights + band * SkyTiles::sectors + sector));
        print_result("  " + row);
    }
}

void write_map(const Renderer& renderer, const Camera& camera, PictureSize size, const LightChoice& choice,
               const std::string& path)
{
    const Window all{0, 0, static_cast<int32_t>(size.width), static_cast<int32_t>(size.height)};
    Image image = make_image(all, all);
    parallel_for(size.height, [&](size_t y) {
        for (uint32_t x = 0; x < size.width; ++x) {
            const Ray ray = camera.ray({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f}, {0.5f, 0.5f});
            const Hit hit = renderer.accelerator().closest(ray);
            if (!hit) continue;
            const Surface at = surface_at(renderer.scene(), ray, hit);
            const float rate = choice.empty() ? 1 : choice.rate(choice.cell_of(at.origin, at.n));
            image.at(static_cast<int32_t>(x), static_cast<int32_t>(y)) = {rate, rate, rate};
        }
    });
    write_png(path, image);
}

}  // namespace

void print_plan(const Renderer& renderer, const CameraDescription& description, PictureSize size,
                const std::string& map)
{
    const Camera camera(description, renderer.scene().normalisation, size.width, size.height);
    const std::shared_ptr<const SamplingPlan> plan = renderer.plan(camera, size.width, size.height);
    const LightChoice& choice = plan->light_choice;
    print_field("splitting", plan->split == 1 ? "none" : "paths split into " + std::to_string(plan->split));
    print_field("roulette", plan->importance.empty()
                                ? "by the throughput"
                                : format_text("by an importance map, cells of %u pixels", plan->cell));
    print_field("mirrors", std::to_string(renderer.scene().mirrors.size()) + " by way of which lights are sampled");
    if (choice.empty()) {
        print_field("light", "sampled at every vertex; nothing was learned");
    } else {
        print_field("light", "sampled " + rates_of(choice) + format_text(" of %zu places", choice.cell_at.size()));
        for (uint32_t i = 0; i < choice.lights; ++i)
            print_result(format_text("  light %-6u %5.1f %% of the samples", i, 100 * mean_probability(choice, i)));
        if (choice.has_tiles) print_sky(choice);
    }
    if (!map.empty()) write_map(renderer, camera, size, choice, map);
}

}  // namespace lancer
