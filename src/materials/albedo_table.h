// Table of the light that single scattering from GGX facets loses by shadowing and masking, by cosine and alpha, for
// perfect reflectors and for each index of a dielectric. Metal compensates for it (Kulla and Conty, "Revisiting
// Physically Based Shading at Imageworks", SIGGRAPH 2017 courses); plastic uses it to scale its base. Computed by a
// fixed quadrature, so that the bits are always the same.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "core/lanes/lanes.h"

namespace lancer {

class AlbedoTable {
    // Nodes have few leading bits, four per power of two, as losses vary with cos / alpha near grazing and with cos
    // elsewhere. Below the first node its values are used.
    static constexpr uint32_t bits_below_node = 21;
    static constexpr float least_cos = 0x1p-12f, least_row = 0x1p-14f;
    static constexpr uint32_t cosines = 49, rows = 57;

public:
    // For a perfect reflector; built on first use and shared.
    static const AlbedoTable& white();
    // For a dielectric; eta: index beyond the surface over index before it, finite, > 0. Nothing may be asked of it
    // before need() or need_all().
    explicit AlbedoTable(float eta) : eta_(eta) {}
    // From now on row() and mean_missing() answer for this alpha in (0, 1]. The bits do not depend on what else was
    // needed. About half a millisecond.
    void need(float alpha);
    // The same for every alpha: 28 times as long.
    void need_all();

    // The row of one alpha; default-constructed: no loss. The table must outlive it.
    class Row {
    public:
        Row() = default;
        explicit operator bool() const { return losses_ != none.data(); }
        // L, where F(cos) (1 - L) is the directional albedo and F the reflectance of the smooth surface; in [0, 1] for
        // a perfect reflector, and then 1 - albedo. cos in (0, 1]. 0 of a row that is none.
        float loss(float cos) const
        {
            const Cell c = cell(cos, least_cos, cosines);
            const auto at = [&](const float* l) { return l[0] + c.part * (l[1] - l[0]); };
            const float low = at(losses_ + c.index), high = at(losses_ + cosines + c.index);
            return low + part_ * (high - low);
        }
        // Four rows, each at its own cosine.
        static Float4 losses(const std::array<Row, 4>& four, Float4 cos)
        {
            const Float4 x = max(min(cos, broadcast_to<Float4>(1)), broadcast_to<Float4>(least_cos));
            const UInt4 offset = reinterpret_cast<UInt4>(x) - std::bit_cast<uint32_t>(least_cos);
            const UInt4 index = min(offset >> bits_below_node, UInt4{} + (cosines - 2));
            const Int4 rest = reinterpret_cast<Int4>(offset - (index << bits_below_node));
            const Float4 part = to_float(rest) * (1.0f / (uint32_t{1} << bits_below_node));
            alignas(16) std::array<uint32_t, 4> first;
            store4_aligned(first.data(), index);
            const auto ends = [&](size_t i) {
                const float* low = four[i].losses_ + first[i];
                return load2x2(low, low + cosines);
            };
            const auto [a, b, c, d] = transpose4x4(std::array<Float4, 4>{ends(0), ends(1), ends(2), ends(3)});
            const Float4 low = a + part * (b - a), high = c + part * (d - c);
            return low + Float4{four[0].part_, four[1].part_, four[2].part_, four[3].part_} * (high - low);
        }

    private:
        friend AlbedoTable;
        Row(const float* losses, float part) : losses_(losses), part_(part) {}

        static constexpr std::array<float, 2 * cosines> none{};

        const float* losses_ = none.data();  // of two alphas, one behind the other
        float part_ = 0;                     // interpolation weight of the second
    };
    // alpha: in (0, 1].
    Row row(float alpha) const
    {
        const Cell a = cell(alpha, least_row, rows);
        return {&loss_[a.index * cosines], a.part};
    }
    float loss(float cos, float alpha) const { return row(alpha).loss(cos); }
    // 1 - the hemispherical albedo (the cosine-weighted mean), exactly that of the interpolated loss().
    float mean_missing(float alpha) const
    {
        const Cell a = cell(alpha, least_row, rows);
        return mean_missing_[a.index] + a.part * (mean_missing_[a.index + 1] - mean_missing_[a.index]);
    }

private:
    void fill_row(uint32_t row);

    static constexpr float node(float least, uint32_t i)
    {
        return std::bit_cast<float>(std::bit_cast<uint32_t>(least) + (i << bits_below_node));
    }
    struct Cell {
        uint32_t index;
        float part;
    };
    static Cell cell(float x, float least, uint32_t nodes)
    {
        const uint32_t first = std::bit_cast<uint32_t>(least);
        const uint32_t offset = std::bit_cast<uint32_t>(std::clamp(x, least, 1.0f)) - first;
        const uint32_t index = std::min(offset >> bits_below_node, nodes - 2);
        const auto rest = static_cast<float>(offset - (index << bits_below_node));
        return {index, rest * (1.0f / (uint32_t{1} << bits_below_node))};
    }

    std::array<float, rows * cosines> loss_{};  // row by row
    std::array<float, rows> mean_missing_{};
    float eta_;  // infinite: a perfect reflector
    std::array<bool, rows> is_filled_{};
};

// 1 - the hemispherical albedo of a smooth dielectric. eta as above.
float mean_transmittance(float eta);

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
