// Cells in which a lobe of facets of any roughness and from any angle is as wide as any other: those of the normal of
// the facet that sends wo to wi, whose leaning is measured in units of alpha. What leans further than most is one cell
// with what is absorbed.
#pragma once

#include "materials/samples.h"
#include "support/statistics/significance.h"

namespace lancer {

inline constexpr uint32_t leanings = 12, turns = 16;
inline constexpr size_t outside = 2 * leanings * turns;

// Over a cell.
struct Integral {
    double pdf = 0, f_cos = 0;
    void add(const BsdfValue& v, double size)
    {
        pdf += static_cast<double>(v.pdf) * size, f_cos += static_cast<double>(v.f_cos.g) * size;
    }
};

// Between wo and wi, one of them possibly below the surface. eta: index beyond the surface over index before it.
struct Facets {
    double alpha, eta;
    Vec3d wo;
    static constexpr double most = 0.95;  // of the normals, seen from above, that lean less than the cells reach

    // In front of the surface or beyond it, leaning, turn.
    size_t cell_of(Vec3 w) const
    {
        const Vec3d wi = normalize(to_double(w));
        const Vec3d sum = wi.z > 0 ? wo + wi : wo + eta * wi, h = sum.z > 0 ? sum : -sum;
        const double lean = std::hypot(h.x, h.y) / (h.z * alpha), turn = std::atan2(h.y, h.x) / (2 * std::numbers::pi);
        const double part = lean * lean / (1 + lean * lean) / most;
        if (part >= 1) return outside;
        const auto at = [](double x, size_t n) {
            return std::min(n - 1, static_cast<size_t>(x * static_cast<double>(n)));
        };
        const size_t cell = at(part, leanings) * turns + at(turn < 0 ? turn + 1 : turn, turns);
        return cell + (wi.z > 0 ? 0 : leanings * turns);
    }
    // Integral of f over the directions of each cell: over its normals, n x n of them, each with its two directions.
    template <class F>
    std::vector<Integral> integrate(const F& f, uint32_t n) const
    {
        std::vector<Integral> cells(2 * leanings * turns);
        for (uint32_t i = 0; i < leanings * n; ++i)
            for (uint32_t j = 0; j < turns * n; ++j) {
                const double part = most * (static_cast<double>(i) + 0.5) / (leanings * n),
                             phi = 2 * std::numbers::pi * (static_cast<double>(j) + 0.5) / (turns * n);
                const double lean = alpha * std::sqrt(part / (1 - part)), z = 1 / std::sqrt(1 + lean * lean);
                const Vec3d h{lean * z * std::cos(phi), lean * z * std::sin(phi), z};
                // d(solid angle) = z^3 lean d(lean) d(phi), and lean^2 = alpha^2 part / (1 - part).
                const double size = most * z * z * z * 0.5 * alpha * alpha / ((1 - part) * (1 - part)) /
                                    (leanings * n) * (2 * std::numbers::pi / (turns * n));
                const double cos_o = dot(wo, h);
                if (cos_o <= 0) continue;
                const size_t cell = size_t{i / n} * turns + j / n;
                const Vec3d reflected = 2 * cos_o * h - wo;
                if (reflected.z > 0) cells[cell].add(f(to_float(reflected)), 4 * cos_o * size);
                const double cos2 = 1 - (1 - cos_o * cos_o) / (eta * eta);
                if (eta == 1 || cos2 <= 0) continue;
                const double cos_t = std::sqrt(cos2);
                const Vec3d refracted = (cos_o / eta - cos_t) * h - wo / eta;
                const double sum = cos_o - eta * cos_t;
                if (refracted.z < 0)
                    cells[leanings * turns + cell].add(f(to_float(refracted)), sum * sum / (eta * eta * cos_t) * size);
            }
        return cells;
    }
};

// What of a lobe was sampled, against its density.
struct LobeSample {
    double total = 0;     // probability that its density says
    double there = 0;     // its albedo within the cells
    stats::Tally energy;  // the same, sampled
    double p = 0;         // of frequencies so far from the density, by chance
};
// cos: of wo. Along an axis: else the steps of float are felt by the narrowest lobes at grazing. nodes: along each side
// of a cell; where the horizon cuts cells, a million samples feel that 20 are few.
template <class B>
LobeSample sample_lobe(const B& bsdf, float alpha, float cos, int count, uint64_t seed, uint32_t nodes = 20)
{
    const double r = std::sqrt((1 - static_cast<double>(cos)) * (1 + static_cast<double>(cos)));
    const Vec3 wo = to_float(Vec3d{r, 0, static_cast<double>(cos)});
    const Facets facets{alpha, eta_through(bsdf), normalize(to_double(wo))};
    LobeSample lobe;
    std::vector<double> expected;
    for (const Integral& cell : facets.integrate([&](Vec3 wi) { return bsdf.eval(wo, wi); }, nodes)) {
        expected.push_back(cell.pdf);
        lobe.total += cell.pdf, lobe.there += cell.f_cos;
    }
    std::vector<uint64_t> observed(outside + 1);
    Random random(seed);
    for (int i = 0; i < count; ++i) {
        const float u = random.unit();
        const auto s = bsdf.sample(wo, u, random.unit2());
        const size_t cell = s ? facets.cell_of(s->wi) : outside;
        lobe.energy.add(cell == outside ? 0 : static_cast<double>(s->weight.g));
        ++observed[cell];
    }
    expected.push_back(std::max(0.0, 1 - lobe.total));
    // The nodes of the integrals may miss the sliver of a cell that is above the horizon.
    for (double& e : expected) e = std::max(1e-3, e * count);
    lobe.p = chi_square_test(observed, expected).p;
    return lobe;
}

// How differently two materials look at most: in their albedo and in what they show of surroundings that change slowly,
// from all places.
template <class M>
double largest_difference(const M& one, const M& other)
{
    const auto sky = [](Vec3 w) {
        return 1 + 0.5 * static_cast<double>(w.x) + 0.3 * static_cast<double>(w.y * w.z) +
               0.2 * static_cast<double>(w.z);
    };
    double largest = 0;
    for (const Place& p : places()) {
        const auto shown = [&](const M& material) {
            const auto bsdf = material.at(p.point);
            std::array<double, 2> sums{};
            constexpr int n = 64;
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    // The lobes by a third, lower-discrepancy coordinate.
                    const auto u = static_cast<float>(std::fmod((i * n + j) * 0.618033988749895, 1.0));
                    const auto s =
                        bsdf.sample(p.wo, u, {(static_cast<float>(i) + 0.5f) / n, (static_cast<float>(j) + 0.5f) / n});
                    if (!s) continue;
                    const double w = static_cast<double>(s->weight.g) / (n * n);
                    sums[0] += w, sums[1] += w * sky(s->wi);
                }
            return sums;
        };
        const auto a = shown(one), b = shown(other);
        for (const size_t i : {0, 1}) largest = std::max(largest, std::abs(a[i] / b[i] - 1));
    }
    return largest;
}

}  // namespace lancer
