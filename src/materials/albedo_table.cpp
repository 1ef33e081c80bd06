#include "materials/albedo_table.h"

#include <cmath>
#include <utility>

#include "materials/fresnel.h"
#include "materials/microfacet.h"
#include "materials/thin_sheet.h"

namespace lancer {
namespace {

// Mean of f(normal) over visible normals of `wo`. Half of the azimuths suffice by symmetry. Heights are denser towards
// both ends, as the few strongly tilted normals lose most. finer: how many times as many of each, for
// what has an edge.
template <class F>
double mean_over_normals(const Ggx& ggx, Vec3d wo, const F& f, int finer = 1)
{
    const int azimuths = 8 * finer, heights = 24 * finer;
    double sum = 0, weights = 0;
    for (int j = 0; j < heights; ++j) {
        const double s = (j + 0.5) / heights, weight = s * (1 - s), v = s * s * (3 - 2 * s);
        for (int i = 0; i < azimuths; ++i)
            sum += weight * f(ggx.sample_visible(wo, {(static_cast<float>(i) + 0.5f) / static_cast<float>(2 * azimuths),
                                                      static_cast<float>(v)}));
        weights += weight * azimuths;
    }
    return sum / weights;
}

// Part of the light that other facets stop on its way to wi: 1 - G2 / G1 without cancellation. hidden_o: lambda(wo).
double stopped(const Ggx& ggx, double hidden_o, Vec3d wi)
{
    const double hidden_i = ggx.lambda(wi);
    return hidden_i / (1 + hidden_o + hidden_i);
}

// L of a reflector or coat; reflectance(cos): of a facet.
template <class F>
double loss_of_reflection(const Ggx& ggx, Vec3d wo, const F& reflectance)
{
    const double smooth = reflectance(wo.z), hidden_o = ggx.lambda(wo);
    if (!(smooth > 0)) return 0;
    return mean_over_normals(ggx, wo, [&](Vec3d h) {
        const Vec3d wi = mirrored(wo, h);
        if (!(wi.z > 0)) return 1.0;
        const double ratio = reflectance(dot(wo, h)) / smooth;
        return stopped(ggx, hidden_o, wi) * ratio + (1 - ratio);
    });
}

double loss_of_boundary(const Ggx& ggx, Vec3d wo, double eta)
{
    const double hidden_o = ggx.lambda(wo);
    return mean_over_normals(
        ggx, wo,
        [&](Vec3d h) {
            const double cos = std::min(1.0, dot(wo, h));
            const auto [reflectance, cos_t] = fresnel_dielectric_double(cos, (1 - cos) * (1 + cos), eta);
            const Vec3d back = mirrored(wo, h), through = refracted(wo, h, cos, cos_t, eta);
            const double of_back = back.z > 0 ? stopped(ggx, hidden_o, back) : 1;
            const double of_through = reflectance < 1 && through.z < 0 ? stopped(ggx, hidden_o, through) : 1;
            return reflectance * of_back + (1 - reflectance) * of_through;
        },
        eta < 1 ? 3 : 1);  // total reflection begins at an edge
}

// The lobes of a sheet carry what it sends that way for wo or wi, whichever is less; see GlassBsdf.
double loss_of_sheet(double alpha, Vec3d wo, double eta)
{
    const auto part = [eta](double cos, bool through) {
        return part_of_sheet(fresnel_dielectric_double(cos, (1 - cos) * (1 + cos), eta).reflectance, through);
    };
    double lost = 0;
    for (const bool through : {false, true}) {
        const Ggx ggx{alpha_of_sheet(alpha, eta, through)};
        const double of_wo = part(wo.z, through), hidden_o = ggx.lambda(wo);
        lost += mean_over_normals(ggx, wo, [&](Vec3d h) {
            const Vec3d wi = mirrored(wo, h);
            if (!(wi.z > 0)) return of_wo;
            const double carried = std::min(of_wo, part(std::min(1.0, wi.z), through));
            return carried * stopped(ggx, hidden_o, wi) + (of_wo - carried);
        });
    }
    return lost;
}

}  // namespace

void AlbedoTable::fill_row(uint32_t row)
{
    if (std::exchange(is_filled_[row], true)) return;
    const auto reflectance = [&](double cos) {
        if (kind_ != FacetKind::coat) return 1.0;
        return fresnel_dielectric_double(std::min(1.0, cos), (1 - cos) * (1 + cos), eta_).reflectance;
    };
    const float alpha = node(least_row, row);
    const Ggx ggx{static_cast<double>(alpha)};
    for (uint32_t i = 0; i < cosines; ++i) {
        const auto cos = static_cast<double>(node(least_cos, i));
        const Vec3d wo{std::sqrt((1 - cos) * (1 + cos)), 0, cos};
        loss_[row * cosines + i] =
            static_cast<float>(kind_ == FacetKind::boundary ? loss_of_boundary(ggx, wo, eta_)
                               : kind_ == FacetKind::sheet  ? loss_of_sheet(ggx.alpha, wo, eta_)
                                                            : loss_of_reflection(ggx, wo, reflectance));
    }
    double sum = 0;
    for (uint32_t i = 0; i + 1 < cosines; ++i) {
        // L is linear between the nodes, and constant below the first one.
        const float* l = &loss_[row * cosines + i];
        const double low = static_cast<double>(node(least_cos, i)), high = static_cast<double>(node(least_cos, i + 1));
        const double l0 = static_cast<double>(l[0]), slope = (static_cast<double>(l[1]) - l0) / (high - low);
        const auto integral = [&](double x) { return (l0 - slope * low) * x * x + slope * (2.0 / 3) * x * x * x; };
        sum += integral(high) - integral(low) + (i == 0 ? l0 * low * low : 0);
        cumulative_[row * cosines + i + 1] = static_cast<float>(sum);
    }
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

double mean_transmittance(double eta)
{
    // Within a narrow cone alone light leaves a dense medium; what enters by it, from everywhere, leaves by it.
    if (eta < 1) return mean_transmittance(1 / eta) * (eta * eta);
    return cosine_mean(
        [=](double cos) { return 1 - fresnel_dielectric_double(cos, (1 - cos) * (1 + cos), eta).reflectance; });
}

}  // namespace lancer
