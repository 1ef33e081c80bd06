#include "materials/film_table.h"

#include <algorithm>
#include <cmath>

#include "materials/albedo_nodes.h"
#include "materials/microfacet.h"
#include "materials/thin_film.h"

namespace lancer {
namespace {

constexpr uint32_t film_cosines = 25;
constexpr float film_root_step = 1.0f / (film_cosines - 1);

}  // namespace

float FilmSteps::at(uint32_t i) const
{
    return count == 1 ? least : mix(least, most, static_cast<float>(i) / static_cast<float>(count - 1));
}

uint32_t FilmSteps::below(float x, float& part) const
{
    part = 0;
    if (count == 1) return 0;
    const float place = std::clamp((x - least) / (most - least), 0.0f, 1.0f) * static_cast<float>(count - 1);
    const uint32_t i = std::min(static_cast<uint32_t>(place), count - 2);
    part = place - static_cast<float>(i);
    return i;
}

void FilmTable::need(float least_roughness, float most_roughness, float least_thickness, float most_thickness)
{
    roughness_ = FilmSteps::of_roughness(least_roughness, most_roughness);
    thickness_ = FilmSteps::of_thickness(least_thickness, most_thickness);
    albedo_.resize(size_t{roughness_.count} * thickness_.count * film_cosines);
    Color* row = albedo_.data();
    for (uint32_t r = 0; r < roughness_.count; ++r)
        for (uint32_t t = 0; t < thickness_.count; ++t, row += film_cosines)
            fill(row, roughness_.at(r), thickness_.at(t));
}

void FilmTable::fill(Color* row, float roughness, float thickness) const
{
    // Half of the azimuths, by symmetry.
    constexpr int turns = 10, heights = 20;
    const Ggx ggx{double{std::max(least_alpha, alpha_of_roughness(roughness))}};
    const ThinFilm film{film_ior_, thickness};
    for (uint32_t c = 0; c < film_cosines; ++c) {
        const double root = std::max(2e-3, static_cast<double>(static_cast<float>(c) * film_root_step));
        const double cos = root * root;
        const Vec3d wo{std::sqrt((1 - cos) * (1 + cos)), 0, cos};
        Color sum{};
        float weights = 0;
        for (int j = 0; j < heights; ++j) {
            const auto [v, weight] = height_node<float>(static_cast<size_t>(j), heights);
            for (int i = 0; i < turns; ++i) {
                const Vec3d h = ggx.sample_visible(wo, {(static_cast<float>(i) + 0.5f) / (2 * turns), v});
                const Vec3d wi = mirrored(wo, h);
                weights += weight;
                if (!(wi.z > 0)) continue;
                const FacetReflection f = eval_facets(ggx, wo, wi);
                const auto seen = static_cast<float>(f.f_cos / f.pdf);
                sum += film.on_dielectric(static_cast<float>(dot(wo, h)), base_ior_) * (weight * seen);
            }
        }
        row[c] = sum / weights;
    }
}

Color FilmTable::albedo(float cos, float roughness, float thickness) const
{
    float rough = 0, thick = 0;
    const uint32_t r = roughness_.below(roughness, rough), t = thickness_.below(thickness, thick);
    const float place = std::sqrt(std::clamp(cos, 0.0f, 1.0f)) / film_root_step;
    const uint32_t c = std::min(static_cast<uint32_t>(place), film_cosines - 2);
    const float part = place - static_cast<float>(c);
    const auto row = [&](uint32_t i, uint32_t j) {
        const Color* at = &albedo_[(size_t{i} * thickness_.count + j) * film_cosines + c];
        return mix(at[0], at[1], part);
    };
    const auto by_thickness = [&](uint32_t i) { return thick > 0 ? mix(row(i, t), row(i, t + 1), thick) : row(i, t); };
    return rough > 0 ? mix(by_thickness(r), by_thickness(r + 1), rough) : by_thickness(r);
}

}  // namespace lancer
