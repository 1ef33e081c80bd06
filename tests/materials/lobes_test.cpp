// The lobes of rough surfaces, however narrow: are they sampled with their density, and does that add up? In cells of
// the normal of the facet that sends wo to wi, whose leaning is measured in units of alpha, since in such cells a lobe
// of any alpha and angle is as wide as any other. What leans further than most is one cell with what is absorbed.
#include <gtest/gtest.h>

#include "materials/samples.h"
#include "support/significance.h"

namespace lancer {
namespace {

constexpr float alphas[] = {1, 0.5f, 0.1f, 0.01f, 0.001f, 1e-4f};
constexpr float cosines[] = {1, 0.7f, 0.1f, 0.01f};
constexpr size_t leanings = 12, turns = 16;
constexpr size_t outside = 2 * leanings * turns;

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
    // Integral of f over the directions of each cell: over its normals, each with its two directions.
    template <class F>
    std::vector<Integral> integrate(const F& f) const
    {
        std::vector<Integral> cells(2 * leanings * turns);
        constexpr size_t n = 20;
        for (size_t i = 0; i < leanings * n; ++i)
            for (size_t j = 0; j < turns * n; ++j) {
                const double part = most * (static_cast<double>(i) + 0.5) / (leanings * n),
                             phi = 2 * std::numbers::pi * (static_cast<double>(j) + 0.5) / (turns * n);
                const double lean = alpha * std::sqrt(part / (1 - part)), z = 1 / std::sqrt(1 + lean * lean);
                const Vec3d h{lean * z * std::cos(phi), lean * z * std::sin(phi), z};
                // d(solid angle) = z^3 lean d(lean) d(phi), and lean^2 = alpha^2 part / (1 - part).
                const double size = most * z * z * z * 0.5 * alpha * alpha / ((1 - part) * (1 - part)) /
                                    (leanings * n) * (2 * std::numbers::pi / (turns * n));
                const double cos_o = dot(wo, h);
                if (cos_o <= 0) continue;
                const size_t cell = i / n * turns + j / n;
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

template <class B>
void expect_sampled(const B& bsdf, float alpha, float cos, const std::string& name, stats::Family& family)
{
    constexpr int count = 50000;
    const double r = std::sqrt((1 - static_cast<double>(cos)) * (1 + static_cast<double>(cos)));
    // Along an axis: else the steps of float are felt by the narrowest lobes at grazing.
    const Vec3 wo = to_float({r, 0, static_cast<double>(cos)});
    const Facets facets{alpha, eta_through(bsdf), normalize(to_double(wo))};
    std::vector<double> expected;
    double total = 0, there = 0;
    for (const Integral& cell : facets.integrate([&](Vec3 wi) { return bsdf.eval(wo, wi); })) {
        expected.push_back(cell.pdf);
        total += cell.pdf, there += cell.f_cos;
    }
    EXPECT_LE(total, 1 + 2e-3) << name;
    std::vector<uint64_t> observed(outside + 1);
    Random random(1);
    stats::Tally energy;
    for (int i = 0; i < count; ++i) {
        const float u = random.unit();
        const auto s = bsdf.sample(wo, u, random.unit2());
        const size_t cell = s ? facets.cell_of(s->wi) : outside;
        energy.add(cell == outside ? 0 : static_cast<double>(s->weight.g));
        ++observed[cell];
    }
    // What is sampled is also what is there.
    EXPECT_NEAR(energy.mean, there, 0.01 * there + 5 * energy.error()) << name;
    expected.push_back(std::max(0.0, 1 - total));
    // The nodes of the integrals may miss the sliver of a cell that is above the horizon.
    for (double& e : expected) e = std::max(1e-3, e * count);
    family.add(chi_square_test(observed, expected).p, name);
}

// f(alpha, cos, name)
template <class F>
void for_each_lobe(const F& f)
{
    for (const float alpha : alphas)
        for (const float cos : cosines) f(alpha, cos, "alpha " + std::to_string(alpha) + " cos " + std::to_string(cos));
}

TEST(Lobes, OfMetal)
{
    stats::Family family;
    for_each_lobe([&](float alpha, float cos, const std::string& name) {
        const Metal metal{{0.9f, 0.6f, 0.3f}, std::sqrt(alpha)};
        expect_sampled(metal.at({}), alpha, cos, name, family);
    });
}

TEST(Lobes, OfCompensatedMetal)
{
    stats::Family family;
    for_each_lobe([&](float alpha, float cos, const std::string& name) {
        const Metal metal{{0.9f, 0.6f, 0.3f}, std::sqrt(alpha), {}, &AlbedoTable::white()};
        expect_sampled(metal.at({}), alpha, cos, name, family);
    });
}

TEST(Lobes, OfGlass)
{
    stats::Family family;
    for (const float ior : {1.5f, 1.05f})
        for (const bool front : {true, false})
            for_each_lobe([&](float alpha, float cos, const std::string& name) {
                const auto bsdf = Glass{{1, 1, 1}, ior, std::sqrt(alpha)}.at({.front = front});
                if (bsdf.only_delta()) return;
                expect_sampled(bsdf, alpha, cos, name + (front ? " front " : " back ") + std::to_string(ior), family);
            });
}

TEST(Lobes, OfPlastic)
{
    stats::Family family;
    const Plastic rough = make_plastic({0.8f, 0.2f, 0.1f}, 1, 1.5f);
    for_each_lobe([&](float alpha, float cos, const std::string& name) {
        Plastic plastic = rough;
        plastic.roughness = std::sqrt(alpha);
        expect_sampled(plastic.at({}), alpha, cos, name, family);
    });
}

}  // namespace
}  // namespace lancer
