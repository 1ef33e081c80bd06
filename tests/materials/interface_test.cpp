// What an interface does to light, by closed forms; its laws are those of every material.
#include "materials/interface.h"

#include <gtest/gtest.h>

#include "core/ray.h"
#include "materials/samples.h"
#include "support/statistics/chi_square.h"
#include "support/statistics/significance.h"

namespace lancer {
namespace {

// f(name, sample, bsdf, wo) from both sides and from above to grazing.
template <class F>
void for_each_interface(const F& f)
{
    for_each_bsdf<Interface>([&](const std::string& name, const Sample<Interface>& s, const Place& p,
                                 const InterfaceBsdf& bsdf) { f(name, s, bsdf, p); });
}

// The two lobes that an integrator may follow at once are those that chance picks from, each as often as it says.
TEST(Interface, WhatIsChosenByChanceIsOnTheMeanWhatGoesBothWays)
{
    int reflected = 0, refracted = 0;
    for_each_interface([&](const std::string& name, const auto&, const InterfaceBsdf& bsdf, const Place& p) {
        std::array<std::optional<BsdfSample>, 2> sampled;
        float chance = 0;
        for (int i = 0; i < 4096; ++i) {
            const auto s = bsdf.sample(p.wo, (static_cast<float>(i) + 0.5f) / 4096, {0.3f, 0.7f});
            if (s && s->delta) sampled[s->wi.z < 0] = s;
        }
        const std::array<std::optional<BsdfSample>, 2> whole{bsdf.reflection(p.wo), bsdf.refraction(p.wo)};
        for (size_t i = 0; i < 2; ++i) {
            // 4096 numbers may miss what is rarer.
            if (!sampled[i]) {
                EXPECT_TRUE(!whole[i] || max_component(whole[i]->weight) < 4e-3f) << name;
                continue;
            }
            ASSERT_TRUE(whole[i]) << name;
            EXPECT_EQ(whole[i]->pdf, 1);
            EXPECT_TRUE(whole[i]->delta);
            EXPECT_EQ(whole[i]->wi, sampled[i]->wi) << name;
            EXPECT_EQ(whole[i]->eta, sampled[i]->eta) << name;
            for (const auto channel : {&Color::r, &Color::g, &Color::b})
                EXPECT_NEAR(sampled[i]->weight.*channel * sampled[i]->pdf, whole[i]->weight.*channel,
                            gamma(8) * whole[i]->weight.*channel)
                    << name;
            chance += sampled[i]->pdf;
            ++(i ? refracted : reflected);
        }
        EXPECT_LE(chance, 1 + gamma(8)) << name;
    });
    EXPECT_GT(reflected, 100);
    EXPECT_GT(refracted, 50);
}

// By the textbook's two amplitudes, with the angle beyond from Snell's law.
double fresnel_by_hand(double theta, double eta)
{
    const double cos_i = std::cos(theta), sin_t = std::sin(theta) / eta;
    if (sin_t >= 1) return 1;
    const double cos_t = std::sqrt(1 - sin_t * sin_t);
    const double s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t), p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    return (s * s + p * p) / 2;
}

TEST(Interface, SplitsLightAsFresnelSaysFromNormalToGrazingBothWays)
{
    const Color blue{0.2f, 0.4f, 0.9f}, red{0.9f, 0.3f, 0.1f};
    int totally = 0;
    for (const float outside : {1.0f, 1.33f})
        for (const float inside : {1.5f, 2.42f, 1.0f})
            for (const bool front : {true, false}) {
                const InterfaceBsdf bsdf({.diffuse = blue,
                                          .specular = red,
                                          .diffusion = 0,
                                          .refraction = 1,
                                          .inside_ior = inside,
                                          .outside_ior = outside},
                                         front);
                const double ratio = static_cast<double>(inside) / static_cast<double>(outside),
                             eta = front ? ratio : 1 / ratio;
                for (int i = 0; i <= 900; ++i) {
                    const double theta = std::min(89.99, 0.1 * i) * std::numbers::pi / 180;
                    const double r = fresnel_by_hand(theta, eta);
                    // About the critical angle the reflectance has an infinite slope.
                    const double past = std::abs(std::sin(theta) / eta - 1);
                    const double bound = 1e-6 + (eta < 1 ? 1e-6 / std::sqrt(past) : 0);
                    const Vec3 wo = to_float(Vec3d{std::sin(theta), 0, std::cos(theta)});
                    const auto back = bsdf.reflection(wo), through = bsdf.refraction(wo);
                    EXPECT_NEAR(back ? static_cast<double>(back->weight.r) / 0.9 : 0, r, bound) << theta << " " << eta;
                    if (back) {
                        EXPECT_EQ(back->wi, (Vec3{-wo.x, -wo.y, wo.z}));
                    }
                    totally += r == 1;
                    if (r == 1) {
                        EXPECT_FALSE(through) << theta;
                    }
                    if (!through) {
                        EXPECT_GT(r, 1 - bound);
                        continue;
                    }
                    EXPECT_NEAR(static_cast<double>(through->weight.b) / 0.9 * eta * eta, 1 - r, bound);
                    EXPECT_NEAR(static_cast<double>(through->wi.x) * eta, -std::sin(theta), 1e-6);
                    EXPECT_NEAR(static_cast<double>(through->eta), eta, 1e-6);
                }
            }
    EXPECT_GT(totally, 1000);
}

TEST(Interface, OneFactorKeepsTheProportionsOfItsParts)
{
    const Phong bronze = find_preset("bronze")->phong;
    const InterfaceBsdf bsdf(bronze, true);
    const Vec3 wo{0.6f, 0, 0.8f}, mirrored{-0.6f, 0, 0.8f}, back = normalize(Vec3{0.99f, 0, 0.1f});
    // Diffuse and highlight 0.807, mirror 0.675 of red: together more than all.
    const float factor = 1 / (0.5f * (0.714f + 0.9f) + 0.75f * 0.9f);
    EXPECT_NEAR(bsdf.reflection(wo)->weight.g, 0.75f * 0.8f * factor, 1e-6);
    EXPECT_NEAR(bsdf.reflection(wo)->weight.b, 0.75f * 0.7f * factor, 1e-6);
    // More than a right angle from the mirror image there is no highlight.
    EXPECT_NEAR(bsdf.eval(wo, back).f_cos.g, 0.5f * 0.4284f * factor * back.z / pi, 1e-7);
    const float lobe = 58 / (2 * pi) * 0.8f;
    EXPECT_NEAR(bsdf.eval(wo, mirrored).f_cos.g, factor * 0.5f * (0.4284f * 0.8f / pi + 0.8f * lobe), 1e-5);
    EXPECT_NEAR(max_component(bsdf.reflectance()), 1, 1e-6);
}

// What never reached 1 is not touched.
TEST(Interface, WhatConservesEnergyIsLeftAsItIs)
{
    const Phong p{.diffuse = {0.5f, 0.2f, 0.1f}, .specular = {0.3f, 0.3f, 0.3f}, .diffusion = 0.8f, .reflexion = 0.4f};
    const InterfaceBsdf bsdf(p, true);
    EXPECT_EQ(bsdf.reflection({0, 0, 1})->weight, p.specular * 0.4f);
    EXPECT_FALSE(bsdf.refraction({0, 0, 1}));
    EXPECT_NEAR(bsdf.reflectance().r, 0.8f * 0.8f + 0.3f * 0.4f, 1e-6);
}

TEST(Interface, ThatOnlyDiffusesIsLambertBitForBit)
{
    Random random(7);
    for (const Color c : {Color{1, 1, 1}, Color{0.8f, 0.3f, 0.05f}})
        for (const Place& p : places()) {
            const auto lambert = Lambert{c}.at(p.point);
            const auto bsdf = Interface{c, {}}.at(p.point);
            for (int i = 0; i < 1000; ++i) {
                const float u = random.unit();
                const Vec2 v = random.unit2();
                const auto a = lambert.sample(p.wo, u, v), b = bsdf.sample(p.wo, u, v);
                ASSERT_TRUE(a && b);
                ASSERT_EQ(a->wi, b->wi);
                ASSERT_EQ(a->weight, b->weight);
                ASSERT_EQ(a->pdf, b->pdf);
                const Vec3 wi = random.unit_vector();
                ASSERT_EQ(lambert.eval(p.wo, wi).f_cos, bsdf.eval(p.wo, wi).f_cos);
                ASSERT_EQ(lambert.eval(p.wo, wi).pdf, bsdf.eval(p.wo, wi).pdf);
            }
            EXPECT_FALSE(bsdf.reflection(p.wo) || bsdf.refraction(p.wo));
        }
}

// Textures may bring numbers outside [0, 1].
TEST(Interface, TakesAnyColour)
{
    const Phong p{
        .diffuse = {-1, 3, 0.5f}, .specular = {2, -2, 1}, .shininess = 9, .diffusion = 0.5f, .reflexion = 0.5f};
    const InterfaceBsdf bsdf(p, true), black({.diffuse = {-1, -1, -1}, .specular = {-1, -1, -1}}, true);
    const Color sum = bsdf.reflectance();
    EXPECT_LE(max_component(sum), 1 + gamma(4));
    EXPECT_GE(std::min({sum.r, sum.g, sum.b}), 0);
    EXPECT_FALSE(black.sample({0, 0, 1}, 0.5f, {0.5f, 0.5f}));
    EXPECT_TRUE(black.only_delta());
}

// Too narrow for the cells of the laws: in cells of the part of the lobe that lies nearer to the mirror image, which is
// uniform whatever the exponent, and of the turn about it.
TEST(Interface, HighlightsOfAnyExponentAreSampledWithTheirDensity)
{
    constexpr size_t rings = 12, turns = 8, inner = 8;
    constexpr int count = 40000;
    stats::Family family;
    Random random(8);
    for (const float exponent : {0.0f, 3.0f, 80.0f, 1e4f, 1e6f, 1e9f})
        for (const double cos : {1.0, 0.7, 0.2}) {
            const std::string name = std::to_string(exponent) + " at " + std::to_string(cos);
            const InterfaceBsdf bsdf({.specular = {1, 1, 1}, .shininess = exponent}, true);
            const double r = std::sqrt(1 - cos * cos), power = 1 / (static_cast<double>(exponent) + 1);
            const Vec3 wo = to_float(Vec3d{-r, 0, cos});
            // An exact frame about the mirror image, which lies in the plane of x and z.
            const Vec3d z = normalize(Vec3d{-to_double(wo).x, 0, to_double(wo).z}), x{z.z, 0, -z.x};
            const auto direction = [&](double part, double turn) {
                const double away = -std::expm1(std::log(part) * power), s = std::sqrt(away * (2 - away));
                const double a = s * std::cos(2 * std::numbers::pi * turn),
                             b = s * std::sin(2 * std::numbers::pi * turn);
                return Vec3d{a * x.x + (1 - away) * z.x, b, a * x.z + (1 - away) * z.z};
            };
            std::vector<double> expected(rings * turns + 1);
            double energy = 0, all = 0;
            for (size_t i = 0; i < rings * inner; ++i)
                for (size_t j = 0; j < turns * inner; ++j) {
                    const double part = (static_cast<double>(i) + 0.5) / (rings * inner),
                                 turn = (static_cast<double>(j) + 0.5) / (turns * inner);
                    const Vec3d wi = direction(part, turn);
                    if (wi.z <= 0) continue;
                    // part = cos^(n + 1): the solid angle of a cell is its size over the density of the lobe.
                    const double c = dot(wi, z), density = std::pow(part, 1 - power) / (2 * std::numbers::pi * power);
                    const double solid_angle = 1.0 / (rings * inner * turns * inner) / density;
                    ASSERT_GT(c, 0);
                    const BsdfValue f = bsdf.eval(wo, to_float(wi));
                    expected[i / inner * turns + j / inner] += static_cast<double>(f.pdf) * solid_angle * count;
                    energy += static_cast<double>(f.f_cos.g) * solid_angle;
                    all += static_cast<double>(f.pdf) * solid_angle;
                }
            expected.back() = std::max(1e-3, count * (1 - all));
            std::vector<uint64_t> observed(expected.size());
            stats::Tally weights;
            for (int i = 0; i < count; ++i) {
                const auto s = bsdf.sample(wo, 0.5f, random.unit2());
                weights.add(s ? static_cast<double>(s->weight.g) : 0);
                if (!s) {
                    ++observed.back();
                    continue;
                }
                const Vec3d wi = normalize(to_double(s->wi)), d = wi - z;
                const double part = std::pow(1 - 0.5 * dot(d, d), 1 / power);
                const double turn = std::atan2(wi.y, dot(wi, x)) / (2 * std::numbers::pi);
                const auto at = [](double t, size_t n) {
                    return std::min(n - 1, static_cast<size_t>(t * static_cast<double>(n)));
                };
                ++observed[at(part, rings) * turns + at(turn < 0 ? turn + 1 : turn, turns)];
            }
            // Whole lobes give back the cosine of their middle; none gives back more than it got.
            EXPECT_NEAR(weights.mean, energy, 0.005 + 5 * weights.error()) << name;
            EXPECT_LE(weights.mean, 1 + 1e-6 + 5 * weights.error()) << name;
            if (exponent >= 1e4f) {
                EXPECT_NEAR(weights.mean, cos, 1e-3 + 5 * weights.error()) << name;
            }
            // Cells that the horizon cuts are not resolved by the nodes above.
            if (exponent >= 80) family.add(chi_square_test(observed, expected).p, name);
        }
}

}  // namespace
}  // namespace lancer
