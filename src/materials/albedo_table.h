// Table of the light that single scattering from GGX facets loses by shadowing and masking, by cosine and alpha, for
// perfect reflectors and for each index of a dielectric. Metal and glass compensate for it (Kulla and Conty,
// "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017 courses); plastic uses it to scale its base.
// Computed by a fixed quadrature, so that the bits are always the same.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <type_traits>
#include <vector>

#include "core/lanes/lanes.h"
#include "materials/albedo_nodes.h"
#include "materials/fresnel.h"
#include "materials/spectrum.h"

namespace lancer {

// What the facets are of. reflector: reflectance 1. coat: a dielectric of which only the reflection counts. boundary: a
// dielectric, with what it lets through. sheet: a rough thin sheet of glass, see thin_sheet.h.
enum class FacetKind { reflector, coat, boundary, sheet };

// Of one facet of a reflector or coat, or of the smooth surface. eta: index beyond the surface over index before it.
struct FacetReflectance {
    FacetKind kind;
    double eta;

    // cos: in [0, 1], or rounded to above it. D: double or a vector of them.
    template <class D>
    D operator()(D cos) const
    {
        const D one = D{} + 1.0;
        if (kind != FacetKind::coat) return one;
        return fresnel_dielectric_double(smaller(one, cos), (1.0 - cos) * (1.0 + cos), eta + D{}).reflectance;
    }
    // What the albedo of rough facets is counted from.
    double whole(double cos) const { return kind == FacetKind::coat && has_edge(eta) ? 1 : (*this)(cos); }
    // Whether the reflectance has an edge, where all of it begins.
    static bool has_edge(double eta) { return eta < 1; }
    // The critical cosine where few values miss that edge, as in albedo_nodes.h; 0 elsewhere. What a boundary loses has
    // none.
    float edge() const;
};
// The same as whole() of a coat of any roughness. smooth: its reflectance if it were smooth. Up to an edge that varies
// with the angle as the albedo does, so that few values of their quotient tell all; facets smear the edge.
template <class T>
inline T whole_of_coat(T smooth, std::type_identity_t<T> eta, std::type_identity_t<T> alpha)
{
    return select((alpha > 0.0f) & (eta < 1.0f), T{} + 1.0f, smooth);
}

class AlbedoTable {
    static constexpr float least_row = 0x1p-14f;
    static constexpr uint32_t rows = 57;

public:
    // eta: index beyond the surface over index before it, finite, > 0; of a sheet that of its glass; of a reflector it
    // does not count. Nothing may be asked of a table before need() or need_all().
    explicit AlbedoTable(FacetKind kind, double eta = 1);
    // From now on row() and mean_missing() answer for this alpha in (0, 1]. The bits do not depend on what else was
    // needed. About half a millisecond; a boundary or sheet takes twice as long, with an edge some fifteen times as
    // long.
    void need(float alpha);
    // The same for every alpha: 28 times as long.
    void need_all();

    template <class T>
    class EvenLobeT;
    using EvenLobe = EvenLobeT<float>;
    // The row of one alpha; default-constructed: no loss. The table must outlive it.
    class Row {
    public:
        Row() = default;
        explicit operator bool() const { return losses_ != none.data(); }
        // L, where F(cos) (1 - L) is the directional albedo and F is whole_of_coat() of a coat, else 1. Where F is 1, L
        // is in [0, 1]. cos in (0, 1]. 0 of a row that is none.
        float loss(float cos) const
        {
            const NodeCell c = cosine_cell(edge_, cos);
            return table_square(losses_ + c.index, cosines_of(edge_)).at(c.part, part_);
        }
        static bool have_edge(const std::array<Row, 4>& four)
        {
            return four[0].edge_ + four[1].edge_ + four[2].edge_ + four[3].edge_ > 0;
        }
        // Four rows, each at its own cosine.
        [[gnu::always_inline]] static Float4 losses(const std::array<Row, 4>& four, Float4 cos)
        {
            if (have_edge(four))
                return Float4{four[0].loss(cos[0]), four[1].loss(cos[1]), four[2].loss(cos[2]), four[3].loss(cos[3])};
            const NodeCellT<Float4> c = cell_from(cos, least_cos, plain_cosines);
            alignas(16) std::array<uint32_t, 4> first;
            store4_aligned(first.data(), c.index);
            const auto at = [&](size_t i) { return four[i].losses_ + first[i]; };
            return table_square(std::array{at(0), at(1), at(2), at(3)}, plain_cosines)
                .at(c.part, Float4{four[0].part_, four[1].part_, four[2].part_, four[3].part_});
        }

    private:
        friend AlbedoTable;
        Row(const float* losses, float part, float edge) : losses_(losses), part_(part), edge_(edge) {}

        static constexpr std::array<float, 2 * plain_cosines> none{};

        const float* losses_ = none.data();  // of two alphas, one behind the other
        float part_ = 0;                     // interpolation weight of the second
        float edge_ = 0;                     // as in albedo_nodes.h
    };
    // alpha: in (0, 1]. Not of a coat.
    EvenLobe even_lobe(float alpha) const;
    // alpha: in (0, 1].
    Row row(float alpha) const
    {
        const NodeCell a = cell_from(alpha, least_row, rows);
        return {&loss_[a.index * size_t{cosines_of(edge_)}], a.part, edge_};
    }
    float loss(float cos, float alpha) const { return row(alpha).loss(cos); }
    // 1 - the hemispherical albedo (the cosine-weighted mean), exactly that of the interpolated loss().
    float mean_missing(float alpha) const
    {
        const NodeCell a = cell_from(alpha, least_row, rows);
        return mean_missing_[a.index] + a.part * (mean_missing_[a.index + 1] - mean_missing_[a.index]);
    }

private:
    void fill_row(uint32_t row);

    std::vector<float> loss_;  // row by row
    // Likewise: integral of 2 x L(x) from 0 to each node, the first one standing for 0.
    std::vector<float> cumulative_;
    std::array<float, rows> mean_missing_{};
    double eta_;
    float edge_;  // as in albedo_nodes.h
    FacetKind kind_;
    std::array<bool, rows> is_filled_{};
};

// Facet losses of each lane.
inline float loss_of(const AlbedoTable::Row& row, float cos) { return row.loss(cos); }
[[gnu::always_inline]] inline Float4 loss_of(const std::array<AlbedoTable::Row, 4>& rows, Float4 cos)
{
    return AlbedoTable::Row::losses(rows, cos);
}

// The directions in which light that was lost comes back: by L(cos) cos / (pi M), with the mean M of L under even
// light. Default-constructed: none. The table must outlive it. T: float, or Float4 for the lobes of four points.
template <class T>
class AlbedoTable::EvenLobeT {
public:
    explicit operator bool() const { return movemask(mean_ > 0.0f) != 0; }  // some lobe
    T loss(T cos) const { return loss_of(row_, cos); }
    T mean() const { return mean_; }  // M
    // The density of sample_cos() with an even azimuth, per solid angle. Between two nodes it has the mean of L there.
    // cos in [0, 1].
    T pdf(T cos) const
    {
        if constexpr (std::is_same_v<T, float>) {
            if (row_.edge_ > 0) {
                const uint32_t i = cosine_cell(row_.edge_, cos).index;
                const auto square = table_square(cumulative_ + i, cosines_of(row_.edge_));
                return pdf_between(square, lower_end(i), cosine_node(row_.edge_, i + 1), cos);
            }
            const uint32_t i = cell_from(cos, least_cos, plain_cosines).index;
            return pdf_between(table_square(cumulative_ + i, plain_cosines), i, cos);
        } else {
            if (Row::have_edge(row_))
                return T{of(0).pdf(cos[0]), of(1).pdf(cos[1]), of(2).pdf(cos[2]), of(3).pdf(cos[3])};
            const auto i = cell_from(cos, least_cos, plain_cosines).index;
            const std::array at{cumulative_[0] + i[0], cumulative_[1] + i[1], cumulative_[2] + i[2],
                                cumulative_[3] + i[3]};
            return pdf_between(table_square(at, plain_cosines), i, cos);
        }
    }
    // Of one lobe. u: in [0, 1).
    float sample_cos(float u) const
    {
        uint32_t first = 0, count = cosines_of(row_.edge_) - 1;
        const float at = u * up_to(count);
        while (count > 1) {  // the last node whose integral is at most `at`
            const uint32_t half = count / 2;
            if (up_to(first + half) <= at) first += half;
            count -= half;
        }
        const float from = up_to(first), mass = up_to(first + 1) - from;
        const float part = mass > 0 ? std::clamp((at - from) / mass, 0.0f, 1.0f) : 0;
        const float low = lower_end(first), high = cosine_node(row_.edge_, first + 1);
        return std::sqrt(low * low + part * ((high - low) * (high + low)));
    }
    // Lobe i of four.
    EvenLobe of(size_t i) const
    {
        EvenLobe lobe;
        lobe.row_ = row_[i], lobe.cumulative_ = cumulative_[i];
        lobe.part_ = part_[i], lobe.mean_ = mean_[i], lobe.whole_ = whole_[i];
        return lobe;
    }
    void set(size_t i, const EvenLobe& lobe)
    {
        row_[i] = lobe.row_, cumulative_[i] = lobe.cumulative_;
        part_[i] = lobe.part_, mean_[i] = lobe.mean_, whole_[i] = lobe.whole_;
    }

private:
    friend AlbedoTable;
    template <class>
    friend class AlbedoTable::EvenLobeT;
    float lower_end(uint32_t i) const { return i == 0 ? 0 : cosine_node(row_.edge_, i); }
    float up_to(uint32_t i) const
    {
        return cumulative_[i] + part_ * (cumulative_[cosines_of(row_.edge_) + i] - cumulative_[i]);
    }
    // From node i on, without an edge.
    template <class Index>
    T pdf_between(const TableSquare<T>& integrals, Index i, T cos) const
    {
        const Index bits = (i << bits_below_node) + std::bit_cast<uint32_t>(least_cos);
        return pdf_between(integrals, select(i == 0u, T{}, with_bits(bits)), with_bits(bits + (1u << bits_below_node)),
                           cos);
    }
    T pdf_between(const TableSquare<T>& integrals, T low, T high, T cos) const
    {
        const T from = integrals.a + part_ * (integrals.c - integrals.a);
        const T mean_here = (integrals.b + part_ * (integrals.d - integrals.b) - from) / ((high - low) * (high + low));
        return mean_here * cos * (std::numbers::inv_pi_v<float> / whole_);
    }

    RowsOf<T, Row> row_{};
    RowsOf<T, const float*> cumulative_ = none();  // of two alphas, one behind the other
    T part_{}, mean_{}, whole_ = T{} + 1.0f;       // whole: the last integral
    static constexpr RowsOf<T, const float*> none()
    {
        if constexpr (std::is_same_v<T, float>)
            return Row::none.data();
        else
            return {Row::none.data(), Row::none.data(), Row::none.data(), Row::none.data()};
    }
};
inline AlbedoTable::EvenLobe AlbedoTable::even_lobe(float alpha) const
{
    const NodeCell a = cell_from(alpha, least_row, rows);
    EvenLobe lobe;
    lobe.row_ = row(alpha), lobe.cumulative_ = &cumulative_[a.index * size_t{cosines_of(edge_)}];
    lobe.part_ = a.part, lobe.mean_ = mean_missing(alpha), lobe.whole_ = lobe.up_to(cosines_of(edge_) - 1);
    return lobe.mean_ > 0 ? lobe : EvenLobe{};
}

// The light of multiple scattering over that lost by single scattering, of facets that each send on the part x of what
// they get and lose `missing` under even light: all orders but the first. Both in [0, 1], not both 1.
inline float all_further_orders(float x, float missing) { return x * x * (1 - missing) / (1 - x * missing); }

// The probability of sampling the even lobe, by what it sends of light from wo: the part `lost` by single scattering
// times `further`, beside the rest times `first`. 0 where it sends none.
template <class T>
T chance_of_even_lobe(T lost, T further, T first)
{
    const T even = lost * further;
    return select(even > 0.0f, even / (even + (1.0f - lost) * first), T{});
}

// 1 - the hemispherical albedo of a smooth dielectric. eta as above.
double mean_transmittance(double eta);

// Integral over [a, b] by five-point Gauss-Legendre quadrature.
template <class F>
double integrate(double a, double b, const F& f)
{
    constexpr double node[] = {0, 0.53846931010568309, 0.90617984593866399};
    constexpr double weight[] = {0.56888888888888889, 0.47862867049936647, 0.23692688505618909};
    const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
    double sum = weight[0] * f(middle);
    for (int i = 1; i < 3; ++i) sum += weight[i] * (f(middle - half * node[i]) + f(middle + half * node[i]));
    return half * sum;
}

// Cosine-weighted mean of f(cos) over the hemisphere. f may vary on any scale as cos tends to 0. The pieces are the
// intervals between the nodes of the table.
template <class F>
double cosine_mean(const F& f)
{
    const auto weighted = [&](double cos) { return 2 * cos * f(cos); };
    constexpr double least = 0x1p-20;
    double sum = integrate(0, least, weighted);
    for (double a = least; a < 1; a *= 2)
        for (int i = 0; i < 4; ++i) sum += integrate(a * (1 + 0.25 * i), a * (1.25 + 0.25 * i), weighted);
    return sum;
}

}  // namespace lancer
