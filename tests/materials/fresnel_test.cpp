// The reflectance of a boundary against the textbook formula in long double, over indices that make it cancel.
#include "materials/fresnel.h"

#include <gtest/gtest.h>

#include <complex>
#include <vector>

#include "support/exact_fresnel.h"

namespace lancer {
namespace {

// Half an ulp, and a little for what is rounded before.
constexpr double one_rounding = 0x1.01p-24;

const std::vector<float> indices{1,    1.000001f, 1.0001f, 1.01f, 1.5f,     2.42f, 1e3f,
                                 1e6f, 0.999999f, 0.9999f, 0.75f, 1 / 1.5f, 1e-3f};

std::vector<float> many_cosines()
{
    std::vector<float> all{1, 1 - 0x1p-24f, 0.999f, 1e-3f, 1e-5f, 1e-7f, 1e-10f, 1e-20f};
    for (int i = 1; i < 1000; ++i) all.push_back(static_cast<float>(i) / 1000);
    return all;
}

TEST(Fresnel, IsTheExactReflectanceRoundedOnce)
{
    for (const float eta : indices)
        for (const float c : many_cosines()) {
            const Fresnel f = fresnel_dielectric(c, eta);
            const ExactFresnel e = exact_fresnel(c, eta);
            ASSERT_TRUE(f.reflectance >= 0 && f.reflectance <= 1) << eta << " " << c;
            const auto error = static_cast<double>(std::abs(f.reflectance - e.reflectance));
            EXPECT_LE(error, one_rounding * static_cast<double>(e.reflectance)) << eta << " " << c;
            EXPECT_LE(std::abs(f.cos_t - e.cos_t), one_rounding * e.cos_t) << eta << " " << c;
        }
}

TEST(Fresnel, IsSoundAroundTheCriticalAngle)
{
    for (const float eta : {0.999999f, 0.9999f, 0.75f, 1 / 1.5f, 0.5f, 0.1f, 1e-3f}) {
        auto c = static_cast<float>(std::sqrt((1 - static_cast<double>(eta)) * (1 + static_cast<double>(eta))));
        for (int i = 0; i < 8; ++i) c = std::nextafter(c, 0.0f);
        for (int i = -8; i <= 8; ++i, c = std::min(1.0f, std::nextafter(c, 2.0f))) {
            const Fresnel f = fresnel_dielectric(c, eta);
            const ExactFresnel e = exact_fresnel(c, eta);
            ASSERT_TRUE(f.reflectance >= 0 && f.reflectance <= 1) << eta << " " << i;
            ASSERT_TRUE(f.cos_t >= 0 && f.cos_t <= 1) << eta << " " << i;
            EXPECT_EQ(f.cos_t == 0, e.cos_t == 0) << eta << " " << i;
            EXPECT_NEAR(f.reflectance, static_cast<double>(e.reflectance), one_rounding) << eta << " " << i;
            EXPECT_NEAR(f.cos_t, static_cast<double>(e.cos_t), one_rounding) << eta << " " << i;
            if (f.cos_t == 0) {
                EXPECT_EQ(f.reflectance, 1);
            }
        }
    }
}

TEST(Fresnel, NormalIncidence)
{
    for (const float eta : indices) {
        const double r = (static_cast<double>(eta) - 1) / (static_cast<double>(eta) + 1);
        const Fresnel f = fresnel_dielectric(1, eta);
        EXPECT_NEAR(f.reflectance, r * r, one_rounding * r * r) << eta;
        EXPECT_FLOAT_EQ(f.cos_t, 1) << eta;
    }
}

// At Brewster's angle the p-polarised half vanishes: R = r_s^2 / 2 with r_s = (1 - eta^2) / (1 + eta^2).
TEST(Fresnel, BrewstersAngle)
{
    for (const double eta : {1.0001, 1.5, 2.42, 1000.0, 1 / 1.5}) {
        const double cos_i = 1 / std::sqrt(1 + eta * eta), s = (1 - eta) * (1 + eta) / (1 + eta * eta);
        EXPECT_NEAR(fresnel_dielectric(static_cast<float>(cos_i), static_cast<float>(eta)).reflectance, 0.5 * s * s,
                    // cos and eta themselves are rounded; R falls like (eta - 1)^2.
                    1e-7 * s * s + 4e-7 * std::abs(s) * eta / (1 + eta))
            << eta;
    }
}

TEST(Fresnel, SameFromBothSides)
{
    for (const float eta : {1.0001f, 1.5f, 2.42f})
        for (const float c : many_cosines()) {
            if (c < 1e-3f) continue;
            const Fresnel in = fresnel_dielectric(c, eta);
            const Fresnel out = fresnel_dielectric(in.cos_t, 1 / eta);
            // cos_t is rounded; near grazing on the way out R changes by 4 / cos times that.
            EXPECT_NEAR(in.reflectance, out.reflectance, 1e-6 / static_cast<double>(c * c)) << eta << " " << c;
        }
}

// Amplitudes of Fresnel's equations with a complex index, as books have them.
double exact_conductor(double cos_i, double eta, double k)
{
    using Complex = std::complex<long double>;
    const long double c = cos_i;
    const Complex n{eta, k}, n2 = n * n, root = std::sqrt((n - Complex(1)) * (n + Complex(1)) + c * c);
    const Complex s = (c - root) / (c + root), p = (n2 * c - root) / (n2 * c + root);
    return static_cast<double>((std::norm(s) + std::norm(p)) / 2);
}

TEST(FresnelConductor, IsExact)
{
    for (const double eta : {0.05, 0.143, 0.999999, 1.0, 1.5, 4.0, 100.0})
        for (const double k : {0.0, 1e-6, 0.1, 1.6, 4.0, 10.0, 300.0})
            for (const float c : many_cosines()) {
                const double r = fresnel_conductor(static_cast<double>(c), eta, k);
                ASSERT_TRUE(r >= 0 && r <= 1) << eta << " " << k << " " << c;
                ASSERT_NEAR(r, exact_conductor(static_cast<double>(c), eta, k), 1e-9) << eta << " " << k << " " << c;
            }
}

TEST(FresnelConductor, WithoutAbsorptionIsADielectric)
{
    for (const float eta : {1.0f, 1.5f, 2.42f, 1 / 1.5f, 0.1f})
        for (const float c : many_cosines()) {
            const double metal = fresnel_conductor(static_cast<double>(c), static_cast<double>(eta), 0);
            EXPECT_NEAR(metal, static_cast<double>(fresnel_dielectric(c, eta).reflectance), 1e-7) << eta << " " << c;
        }
}

TEST(FresnelConductor, IsANumberEvenForNothing)
{
    for (const double eta : {0.0, 1e-30, 1.0, 1e10})
        for (const double k : {0.0, 1e-30, 1.0, 1e10})
            for (const double c : {0.0, 1e-45, 0.5, 1.0}) {
                const double r = fresnel_conductor(c, eta, k);
                EXPECT_TRUE(r >= 0 && r <= 1) << eta << " " << k << " " << c;
            }
}

TEST(Schlick, FromNormalToGrazingAndItsMean)
{
    const Color f0{0.04f, 0.5f, 1};
    EXPECT_EQ(fresnel_schlick(f0, 1.0), f0);
    EXPECT_EQ(fresnel_schlick(f0, 0.0), (Color{1, 1, 1}));
    EXPECT_NEAR(fresnel_schlick(f0, 0.5).r, 0.04 + 0.96 / 32, 1e-7);
    Color mean{};
    constexpr int n = 1000;
    for (int i = 0; i < n; ++i) {
        const double c = (i + 0.5) / n;
        mean += fresnel_schlick(f0, c) * static_cast<float>(2 * c / n);
    }
    for (const auto channel : {&Color::r, &Color::g, &Color::b})
        EXPECT_NEAR(mean.*channel, mean_schlick(f0).*channel, 1e-5);
}

}  // namespace
}  // namespace lancer
