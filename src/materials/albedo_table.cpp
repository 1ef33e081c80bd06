#include "materials/albedo_table.h"

#include <cmath>
#include <limits>
#include <utility>

#include "materials/fresnel.h"
#include "materials/microfacet.h"

namespace lancer {
namespace {

// Mean over visible normals. Half of the azimuths suffice by symmetry. Heights are denser towards both ends, as the few
// strongly tilted normals lose most.
template <class F>
double mean_loss(const Ggx& ggx, double cos, const F& reflectance)
{
    constexpr int azimuths = 8, heights = 24;
    const Vec3d wo{std::sqrt((1 - cos) * (1 + cos)), 0, cos};
    const double smooth = reflectance(cos), hidden_o = ggx.lambda(wo);
    if (!(smooth > 0)) return 0;
    const auto loss_at = [&](Vec2 v) {
        const Vec3d h = ggx.sample_visible(wo, v), wi = mirrored(wo, h);
        if (!(wi.z > 0)) return 1.0;
        // 1 - G2 / G1 without cancellation.
        const double hidden_i = ggx.lambda(wi), lost = hidden_i / (1 + hidden_o + hidden_i);
        const double ratio = reflectance(dot(wo, h)) / smooth;
        return lost * ratio + (1 - ratio);
    };
    double sum = 0, weights = 0;
    for (int j = 0; j < heights; ++j) {
        const double s = (j + 0.5) / heights, weight = s * (1 - s), v = s * s * (3 - 2 * s);
        for (int i = 0; i < azimuths; ++i)
            sum += weight * loss_at({(static_cast<float>(i) + 0.5f) / (2 * azimuths), static_cast<float>(v)});
        weights += weight * azimuths;
    }
    return sum / weights;
}

}  // namespace

void AlbedoTable::fill_row(uint32_t row)
{
    if (std::exchange(is_filled_[row], true)) return;
    const auto reflectance = [&](double cos) {
        if (std::isinf(eta_)) return 1.0;
        return fresnel_dielectric_double(std::min(1.0, cos), (1 - cos) * (1 + cos), eta_).reflectance;
    };
    const float alpha = node(least_row, row);
    for (uint32_t i = 0; i < cosines; ++i)
        loss_[row * cosines + i] =
            static_cast<float>(mean_loss(Ggx{alpha}, static_cast<double>(node(least_cos, i)), reflectance));
    mean_missing_[row] = static_cast<float>(cosine_mean([&](double cos) {
        const double smooth = reflectance(cos), lost = loss(static_cast<float>(cos), alpha);
        return (1 - smooth) + smooth * lost;
    }));
}

void AlbedoTable::need(float alpha)
{
    const uint32_t first = cell(alpha, least_row, rows).index;
    fill_row(first);
    fill_row(first + 1);
}

// In order: the last row is asked as the end of the interval before it.
void AlbedoTable::need_all()
{
    for (uint32_t row = 0; row < rows; ++row) fill_row(row);
}

const AlbedoTable& AlbedoTable::white()
{
    static const AlbedoTable table = [] {
        AlbedoTable t(std::numeric_limits<float>::infinity());
        t.need_all();
        return t;
    }();
    return table;
}

float mean_transmittance(float eta)
{
    return static_cast<float>(cosine_mean(
        [=](double cos) { return 1 - fresnel_dielectric_double(cos, (1 - cos) * (1 + cos), eta).reflectance; }));
}

}  // namespace lancer
