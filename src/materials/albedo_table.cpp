#include "materials/albedo_table.h"

#include <cmath>

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

template <class F>
void AlbedoTable::fill(const F& reflectance)
{
    for (uint32_t row = 0; row < rows; ++row) {
        const float alpha = node(least_row, row);
        for (uint32_t i = 0; i < cosines; ++i) {
            const Ggx ggx{alpha};
            loss_[row * cosines + i] =
                static_cast<float>(mean_loss(ggx, static_cast<double>(node(least_cos, i)), reflectance));
        }
        mean_missing_[row] = static_cast<float>(cosine_mean([&](double cos) {
            const double smooth = reflectance(cos), lost = loss(static_cast<float>(cos), alpha);
            return (1 - smooth) + smooth * lost;
        }));
    }
}

const AlbedoTable& AlbedoTable::white()
{
    static const AlbedoTable table = [] {
        AlbedoTable t;
        t.fill([](double) { return 1.0; });
        return t;
    }();
    return table;
}

AlbedoTable::AlbedoTable(float eta)
{
    fill([=](double cos) {
        return fresnel_dielectric_double(std::min(1.0, cos), (1 - cos) * (1 + cos), eta).reflectance;
    });
}

float mean_transmittance(float eta)
{
    return static_cast<float>(cosine_mean(
        [=](double cos) { return 1 - fresnel_dielectric_double(cos, (1 - cos) * (1 + cos), eta).reflectance; }));
}

}  // namespace lancer
