// GGX against its definition in long double, what of it integrates to 1, and what sampling visible normals gives.
#include "materials/microfacet.h"

#include <gtest/gtest.h>

#include "support/exact_ggx.h"
#include "support/facet_cells.h"

namespace lancer {
namespace {

constexpr float alphas[] = {1, 0.5f, 0.1f, 0.01f, 0.001f, 1e-4f, 1e-5f};

TEST(Ggx, ValuesAndDensitiesAreExact)
{
    for (const float alpha : alphas) {
        const std::vector<Pair> all = pairs_of(alpha);
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

template <class M>
void expect_continuous(const std::string& name, const M& rough, const M& smooth)
{
    EXPECT_LE(largest_difference(rough, smooth), 0.02) << name;
}
TEST(Ggx, IsContinuousTowardsSmooth)
{
    const float r = std::sqrt(1e-3f);
    expect_continuous<Metal>("metal", {{1, 0.6f, 0.2f}, r}, {{1, 0.6f, 0.2f}, 0});
    expect_continuous<Metal>("gold", {{1, 1, 1}, r, gold()}, {{1, 1, 1}, 0, gold()});
    expect_continuous<Metal>("compensated", {{1, 1, 1}, r, gold(), table_of_reflectors()}, {{1, 1, 1}, 0, gold()});
    expect_continuous<Glass>("glass", {{1, 1, 1}, 1.5f, r}, {{1, 1, 1}, 1.5f});
    expect_continuous<Glass>("bubble", {{1, 1, 1}, 0.75f, r}, {{1, 1, 1}, 0.75f});
    expect_continuous<Plastic>("plastic", make_plastic({0.8f, 0.4f, 0.4f}, r, 1.5f),
                               make_plastic({0.8f, 0.4f, 0.4f}, 0, 1.5f));
}

}  // namespace
}  // namespace lancer
