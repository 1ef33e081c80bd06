#include "materials/albedo_table.h"

#include <cmath>
#include <utility>

#include "materials/fresnel.h"
#include "materials/microfacet.h"
#include "materials/thin_sheet.h"

namespace lancer {
namespace {

using Normals = Vec3T<Double4>;  // or directions: four at a time, each with the bits that it has alone

// Mean of f(four normals) over visible normals of `wo`. Half of the azimuths suffice by symmetry. finer: how many times
// as many of each, at most most_finer, for what has an edge.
constexpr size_t most_finer = 3;
size_t fineness(double eta) { return FacetReflectance::has_edge(eta) ? most_finer : 1; }
template <class F>
double mean_over_normals(const Ggx& ggx, const Normals& wo, const F& f, size_t finer = 1)
{
    const GgxT<Double4> facets{broadcast(ggx.alpha)};
    const auto azimuths = static_cast<float>(8 * finer);
    std::array<SinCosT<Double4>, 2 * most_finer> phi;
    for (size_t i = 0; i < finer; ++i) {
        const Float8 step = Float8{0.5f, 1.5f, 2.5f, 3.5f, 4.5f, 5.5f, 6.5f, 7.5f} + static_cast<float>(8 * i);
        const SinCosT<Float8> eight = sin_cos_2pi(step / (2 * azimuths));
        phi[2 * i] = {to_double(lower(eight.sin)), to_double(lower(eight.cos))};
        phi[2 * i + 1] = {to_double(upper(eight.sin)), to_double(upper(eight.cos))};
    }
    const size_t heights = 24 * finer;
    double sum = 0, weights = 0;
    for (size_t j = 0; j < heights; ++j) {
        const auto [v, weight] = height_node<double>(j, heights);
        const Double4 height = broadcast(static_cast<double>(static_cast<float>(v)));
        for (size_t i = 0; i < 2 * finer; ++i) {
            const Double4 value = f(facets.sample_visible(wo, height, phi[i]));
            for (size_t lane = 0; lane < double_lanes; ++lane) sum += weight * value[lane];
        }
        weights += weight * static_cast<double>(azimuths);
    }
    return sum / weights;
}

Double4 stopped(const Ggx& ggx, double hidden_o, const Normals& wi)
{
    return GgxT<Double4>{broadcast(ggx.alpha)}.stopped(broadcast(hidden_o), wi);
}

// L of a reflector or coat.
double loss_of_reflection(const Ggx& ggx, Vec3d wo, const FacetReflectance& reflectance)
{
    const double smooth = reflectance.whole(wo.z), hidden_o = ggx.lambda(wo);
    if (!(smooth > 0)) return 0;
    const Normals from = in_four_lanes(wo);
    return mean_over_normals(
        ggx, from,
        [&](const Normals& h) {
            const Normals wi = mirrored(from, h);
            const Double4 ratio = reflectance(dot(from, h)) / smooth;
            return select(wi.z > 0.0, stopped(ggx, hidden_o, wi) * ratio + (1 - ratio), broadcast(1.0));
        },
        fineness(reflectance.kind == FacetKind::coat ? reflectance.eta : 1));
}

double loss_of_boundary(const Ggx& ggx, Vec3d wo, double eta)
{
    const double hidden_o = ggx.lambda(wo);
    const Normals from = in_four_lanes(wo);
    const Double4 one = broadcast(1.0);
    return mean_over_normals(
        ggx, from,
        [&](const Normals& h) {
            const Double4 cos = smaller(one, dot(from, h));
            const auto [reflectance, cos_t] = fresnel_dielectric_double(cos, (1 - cos) * (1 + cos), broadcast(eta));
            const Normals back = mirrored(from, h), through = refracted(from, h, cos, cos_t, eta);
            const Double4 of_back = select(back.z > 0.0, stopped(ggx, hidden_o, back), one);
            const Double4 of_through =
                select((reflectance < 1.0) & (through.z < 0.0), stopped(ggx, hidden_o, through), one);
            return reflectance * of_back + (1 - reflectance) * of_through;
        },
        fineness(eta));
}

// The lobes of a sheet carry what it sends that way for wo or wi, whichever is less; see GlassBsdf.
double loss_of_sheet(double alpha, Vec3d wo, double eta)
{
    const auto part = [eta]<class D>(D cos, bool through) {
        return part_of_sheet(fresnel_dielectric_double(cos, (1 - cos) * (1 + cos), D{} + eta).reflectance, through);
    };
    const Normals from = in_four_lanes(wo);
    double lost = 0;
    for (const bool through : {false, true}) {
        const Ggx ggx{alpha_of_sheet(alpha, eta, through)};
        const double of_wo = part(wo.z, through), hidden_o = ggx.lambda(wo);
        const Double4 all = broadcast(of_wo);
        lost += mean_over_normals(
            ggx, from,
            [&](const Normals& h) {
                const Normals wi = mirrored(from, h);
                const Double4 carried = smaller(all, part(smaller(broadcast(1.0), wi.z), through));
                return select(wi.z > 0.0, carried * stopped(ggx, hidden_o, wi) + (all - carried), all);
            },
            fineness(eta));
    }
    return lost;
}

}  // namespace

float FacetReflectance::edge() const
{
    if (kind == FacetKind::reflector || kind == FacetKind::boundary || !has_edge(eta)) return 0;
    const auto critical = static_cast<float>(std::sqrt((1 - eta) * (1 + eta)));
    return critical < 1 ? critical : 0;
}

AlbedoTable::AlbedoTable(FacetKind kind, double eta) : eta_(eta), edge_(FacetReflectance{kind, eta}.edge()), kind_(kind)
{
    loss_.resize(size_t{rows} * cosines_of(edge_));
    cumulative_.resize(loss_.size());
}

void AlbedoTable::fill_row(uint32_t row)
{
    if (std::exchange(is_filled_[row], true)) return;
    const FacetReflectance reflectance{kind_, eta_};
    const float alpha = node_from(least_row, row);
    const Ggx ggx{static_cast<double>(alpha)};
    const uint32_t cosines = cosines_of(edge_);
    const size_t first = size_t{row} * cosines;
    for (uint32_t i = 0; i < cosines; ++i) {
        const auto cos = static_cast<double>(cosine_node(edge_, i));
        const Vec3d wo{std::sqrt((1 - cos) * (1 + cos)), 0, cos};
        loss_[first + i] = static_cast<float>(kind_ == FacetKind::boundary ? loss_of_boundary(ggx, wo, eta_)
                                              : kind_ == FacetKind::sheet  ? loss_of_sheet(ggx.alpha, wo, eta_)
                                                                           : loss_of_reflection(ggx, wo, reflectance));
    }
    double sum = 0;
    for (uint32_t i = 0; i + 1 < cosines; ++i) {
        // L is linear between the nodes, and constant below the first one.
        const float* l = &loss_[first + i];
        const double low = static_cast<double>(cosine_node(edge_, i)),
                     high = static_cast<double>(cosine_node(edge_, i + 1));
        const double l0 = static_cast<double>(l[0]), rise = static_cast<double>(l[1]) - l0;
        const double slope = high > low ? rise / (high - low) : 0;
        const auto integral = [&](double x) { return (l0 - slope * low) * x * x + slope * (2.0 / 3) * x * x * x; };
        sum += integral(high) - integral(low) + (i == 0 ? l0 * low * low : 0);
        cumulative_[first + i + 1] = static_cast<float>(sum);
    }
    // The pieces of cosine_mean() are the intervals between the nodes where there is no edge.
    mean_missing_[row] = edge_ > 0 ? static_cast<float>(sum) : static_cast<float>(cosine_mean([&](double cos) {
        const double smooth = reflectance.whole(cos), lost = loss(static_cast<float>(cos), alpha);
        return (1 - smooth) + smooth * lost;
    }));
}

void AlbedoTable::need(float alpha)
{
    const uint32_t first = cell_from(alpha, least_row, rows).index;
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
