// The part of the light that single reflection off GGX facets loses: what facets shadow and what leaves below the
// surface. By cosine and alpha, once for facets that reflect all and once for each index of a dielectric. Metal makes
// up for it (Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017 courses); plastic
// learns from it what is left for its base.
// Computed by a fixed quadrature: always the same bits.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace lancer {

class AlbedoTable {
public:
    // Of a perfect reflector; built on first use, for everyone.
    static const AlbedoTable& white();
    // Of a dielectric; eta: index beyond the surface over index before it, finite, > 0. Takes some milliseconds.
    explicit AlbedoTable(float eta);

    // What it says of one alpha; of none where it is not taken from a table. The table must live as long.
    class Row {
    public:
        Row() = default;
        explicit operator bool() const { return losses_ != nullptr; }
        // L, where F(cos) (1 - L) is the directional albedo and F the reflectance of the smooth surface; in [0, 1] for
        // a perfect reflector, and then 1 - albedo. cos in (0, 1]. Only of a row that is one.
        float loss(float cos) const
        {
            const Cell c = cell(cos, least_cos, cosines);
            const auto at = [&](const float* l) { return l[0] + c.part * (l[1] - l[0]); };
            const float low = at(losses_ + c.index), high = at(losses_ + cosines + c.index);
            return low + part_ * (high - low);
        }

    private:
        friend AlbedoTable;
        Row(const float* losses, float part) : losses_(losses), part_(part) {}

        const float* losses_ = nullptr;  // of two alphas, the second's behind the first's
        float part_ = 0;                 // how far alpha is on the way from the first to the second
    };
    // alpha: in (0, 1].
    Row row(float alpha) const
    {
        const Cell a = cell(alpha, least_row, rows);
        return {&loss_[a.index * cosines], a.part};
    }
    float loss(float cos, float alpha) const { return row(alpha).loss(cos); }
    // 1 - the albedo under even light (its mean weighted by the cosine), exactly that of what loss() interpolates.
    float mean_missing(float alpha) const
    {
        const Cell a = cell(alpha, least_row, rows);
        return mean_missing_[a.index] + a.part * (mean_missing_[a.index + 1] - mean_missing_[a.index]);
    }

private:
    AlbedoTable() = default;
    template <class F>
    void fill(const F& reflectance);

    // Nodes are numbers of few leading bits, four to each power of two: the scale on which losses change is that of
    // cos / alpha, near grazing, and that of cos elsewhere. Below the first node its values hold.
    static constexpr uint32_t bits_below_node = 21;
    static constexpr float least_cos = 0x1p-12f, least_row = 0x1p-14f;
    static constexpr uint32_t cosines = 49, rows = 57;
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
};

// 1 - the albedo of a smooth dielectric under even light. eta as above.
float mean_transmittance(float eta);

// Integral over [a, b] by the five points of Gauss and Legendre.
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

// Mean of f(cos) over the hemisphere, weighted by the cosine. f: may change on any scale as cos tends to 0. The pieces
// are those between the nodes of the table.
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
