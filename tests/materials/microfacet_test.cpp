// GGX against its definition in long double, what of it integrates to 1, and what sampling visible normals gives.
#include "materials/microfacet.h"

#include <gtest/gtest.h>

#include "materials/samples.h"
#include "support/significance.h"

namespace lancer {
namespace {

constexpr float alphas[] = {1, 0.5f, 0.1f, 0.01f, 0.001f, 1e-4f, 1e-5f};

Vec3 direction(double cos, double phi)
{
    const double r = std::sqrt((1 - cos) * (1 + cos));
    return to_float(Vec3d{r * std::cos(phi), r * std::sin(phi), cos});
}

struct Long {
    long double x, y, z;
};
Long unit(Vec3 w)
{
    const long double x = w.x, y = w.y, z = w.z, l = std::sqrt(x * x + y * y + z * z);
    return {x / l, y / l, z / l};
}

// Walter et al. 2007, equations 33 and 34, with tangents of angles.
long double exact_density(Long h, long double alpha)
{
    const long double tan2 = (h.x * h.x + h.y * h.y) / (h.z * h.z), cos4 = h.z * h.z * h.z * h.z;
    const long double s = alpha * alpha + tan2;
    return alpha * alpha / (std::numbers::pi_v<long double> * cos4 * s * s);
}
long double exact_lambda(Long w, long double alpha)
{
    const long double tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
    return (std::sqrt(1 + alpha * alpha * tan2) - 1) / 2;
}

struct Pair {
    Vec3 wo, wi;
};
// wi a few widths of the lobe around the mirrored direction. In memory, and only then looked at: g++ 12 optimises away
// a rounding to float between two calculations in double.
std::vector<Pair> pairs(float alpha)
{
    Random random(1);
    std::vector<Pair> all;
    for (const double cos : {1.0, 0.7, 0.1, 0.01, 1e-4})
        for (int i = 0; i < 2000; ++i) {
            const Vec3 wo = direction(cos, 1.0);
            const double lean = random.log_uniform(-2, 1) * static_cast<double>(alpha), turn = random.uniform(0, 7);
            const Vec3d h = normalize(Vec3d{lean * std::cos(turn), lean * std::sin(turn), 1});
            const Vec3 wi = to_float(mirrored(to_double(wo), h));
            if (wi.z > 0) all.push_back({wo, wi});
        }
    return all;
}

TEST(Ggx, ValuesAndDensitiesAreExact)
{
    for (const float alpha : alphas) {
        const std::vector<Pair> all = pairs(alpha);
        EXPECT_GT(all.size(), 5000u);
        for (const auto& [wo, wi] : all) {
            const float cos = wo.z;
            const Long o = unit(wo), w = unit(wi), sum{o.x + w.x, o.y + w.y, o.z + w.z};
            const long double l = std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
            const long double d = exact_density({sum.x / l, sum.y / l, sum.z / l}, alpha);
            const long double lambda_o = exact_lambda(o, alpha), lambda_i = exact_lambda(w, alpha);
            const FacetReflection f = eval_facets({alpha}, unit_in_double(wo), unit_in_double(wi));
            const auto f_cos = static_cast<double>(d / (4 * o.z * (1 + lambda_o + lambda_i)));
            const auto pdf = static_cast<double>(d / (4 * o.z * (1 + lambda_o)));
            ASSERT_NEAR(f.f_cos, f_cos, 1e-6 * f_cos) << alpha << " " << cos;
            ASSERT_NEAR(f.pdf, pdf, 1e-6 * pdf) << alpha << " " << cos;
            // As a BSDF in float.
            const BsdfValue v = MetalBsdf({1, 1, 1}, nullptr, alpha, nullptr).eval(wo, wi);
            ASSERT_NEAR(v.pdf, pdf, 1e-6 * pdf) << alpha << " " << cos;
            ASSERT_NEAR(v.f_cos.g, f_cos, 1e-6 * f_cos) << alpha << " " << cos;
        }
    }
}

// The facets of a unit of surface have a unit of shadow, straight down and, those that are seen, from everywhere.
TEST(Ggx, NormalsAddUp)
{
    for (const float alpha : alphas)
        for (const double cos : {1.0, 0.7, 0.1, 0.01}) {
            const Ggx ggx{alpha};
            const Vec3d wo = unit_in_double(direction(cos, 0.5));
            double shadow = 0, seen = 0;
            constexpr int n = 600, m = 200;
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < m; ++j) {
                    // Leaning by alpha times the tangent of an angle.
                    const double a = 0.5 * std::numbers::pi * (i + 0.5) / n, phi = 2 * std::numbers::pi * (j + 0.5) / m;
                    const double lean = static_cast<double>(alpha) * std::tan(a), c = 1 / std::sqrt(1 + lean * lean);
                    const Vec3d h{lean * c * std::cos(phi), lean * c * std::sin(phi), c};
                    // d(solid angle) = cos^3 lean d(lean) d(phi)
                    const double d_lean = static_cast<double>(alpha) / (std::cos(a) * std::cos(a));
                    const double w =
                        c * c * c * lean * d_lean * (0.5 * std::numbers::pi / n) * (2 * std::numbers::pi / m);
                    shadow += ggx.density(h) * c * w;
                    seen += 2 * ggx.density(h) / (wo.z + ggx.spread(wo)) * std::max(0.0, dot(wo, h)) * w;
                }
            EXPECT_NEAR(shadow, 1, 1e-4) << alpha;
            EXPECT_NEAR(seen, 1, 1e-3) << alpha << " " << cos;
        }
}

TEST(Ggx, SampledNormalsAreSeen)
{
    for (const float alpha : alphas)
        for (const double cos : {1.0, 0.7, 0.1, 0.01, 1e-7, 1e-30, 0x1p-149}) {
            const Vec3d wo = unit_in_double(direction(cos, 2.0));
            const auto check = [&](Vec2 v) {
                const Vec3d h = Ggx{alpha}.sample_visible(wo, v);
                ASSERT_TRUE(is_finite(h)) << alpha << " " << cos;
                ASSERT_NEAR(length(h), 1, 1e-14);
                ASSERT_GT(h.z, 0) << alpha << " " << cos;
                ASSERT_GT(dot(wo, h), 0) << alpha << " " << cos;
            };
            for_each_extreme_number([&](float, Vec2 v) { check(v); });
            Random random(3);
            for (int i = 0; i < 10000; ++i) check(random.unit2());
        }
}

TEST(Ggx, AlphaIsTheSquareOfRoughness)
{
    EXPECT_EQ(alpha_of_roughness(0.5f), 0.25f);
    EXPECT_EQ(alpha_of_roughness(1), 1);
    EXPECT_EQ(alpha_of_roughness(7), 1);
    EXPECT_EQ(alpha_of_roughness(-1), 0);
    EXPECT_EQ(alpha_of_roughness(std::nanf("")), 0);
    EXPECT_EQ(alpha_of_roughness(0.003f), 0);
    EXPECT_GT(alpha_of_roughness(0.0032f), 0);
}

// A surface of alpha 0.001 looks like a smooth one: its albedo, and what it shows of surroundings that change slowly.
template <class M>
void expect_continuous(const std::string& name, const M& rough, const M& smooth)
{
    const auto sky = [](Vec3 w) {
        return 1 + 0.5 * static_cast<double>(w.x) + 0.3 * static_cast<double>(w.y * w.z) +
               0.2 * static_cast<double>(w.z);
    };
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
        const auto a = shown(rough), b = shown(smooth);
        for (const size_t i : {0, 1}) EXPECT_NEAR(a[i], b[i], 0.02 * b[i]) << name << ", " << p.name;
    }
}
TEST(Ggx, IsContinuousTowardsSmooth)
{
    const float r = std::sqrt(1e-3f);
    expect_continuous<Metal>("metal", {{1, 0.6f, 0.2f}, r}, {{1, 0.6f, 0.2f}, 0});
    expect_continuous<Metal>("gold", {{1, 1, 1}, r, gold()}, {{1, 1, 1}, 0, gold()});
    expect_continuous<Metal>("compensated", {{1, 1, 1}, r, gold(), &AlbedoTable::white()}, {{1, 1, 1}, 0, gold()});
    expect_continuous<Glass>("glass", {{1, 1, 1}, 1.5f, r}, {{1, 1, 1}, 1.5f});
    expect_continuous<Glass>("bubble", {{1, 1, 1}, 0.75f, r}, {{1, 1, 1}, 0.75f});
    expect_continuous<Plastic>("plastic", make_plastic({0.8f, 0.4f, 0.4f}, r, 1.5f),
                               make_plastic({0.8f, 0.4f, 0.4f}, 0, 1.5f));
}

}  // namespace
}  // namespace lancer
