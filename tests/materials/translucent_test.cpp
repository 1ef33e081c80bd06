// The two lobes of a translucent sheet, by closed forms; its laws are those of every material.
#include "materials/translucent.h"

#include <gtest/gtest.h>

#include "core/ray.h"
#include "support/random.h"

namespace lancer {
namespace {

constexpr Color reflected{0.1f, 0.3f, 0.5f}, transmitted{0.8f, 0.2f, 0.1f};

void expect_near(Color a, Color b, const std::string& what = {})
{
    for (const auto channel : {&Color::r, &Color::g, &Color::b})
        EXPECT_NEAR(a.*channel, b.*channel, gamma(8) * b.*channel) << what;
}

TEST(Translucent, IsLambertOnBothSides)
{
    const TranslucentBsdf bsdf(reflected, transmitted);
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        Vec3 wo = random.unit_vector();
        const Vec3 wi = random.unit_vector();
        wo.z = std::abs(wo.z);
        const float cos = std::abs(wi.z) / pi, chance = wi.z > 0 ? 0.5f / 1.3f : 0.8f / 1.3f;
        const BsdfValue f = bsdf.eval(wo, wi);
        expect_near(f.f_cos, (wi.z > 0 ? reflected : transmitted) * cos);
        EXPECT_NEAR(f.pdf, chance * cos, gamma(8) * f.pdf);
    }
    EXPECT_EQ(bsdf.reflectance(), reflected + transmitted);
    EXPECT_TRUE(bsdf.transmits());
}

TEST(Translucent, ThatLetsNothingThroughIsLambertBitForBit)
{
    const TranslucentBsdf bsdf(reflected, {});
    const LambertBsdf lambert{reflected};
    EXPECT_FALSE(bsdf.transmits());
    EXPECT_EQ(bsdf.reflectance(), lambert.reflectance());
    Random random(2);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 wo = random.unit_vector(), wi = random.unit_vector();
        EXPECT_EQ(bsdf.eval(wo, wi).f_cos, lambert.eval(wo, wi).f_cos);
        EXPECT_EQ(bsdf.eval(wo, wi).pdf, lambert.eval(wo, wi).pdf);
        const float u = random.unit();
        const Vec2 v = random.unit2();
        const auto a = bsdf.sample(wo, u, v), b = lambert.sample(wo, u, v);
        ASSERT_EQ(a.has_value(), b.has_value());
        if (!a) continue;
        EXPECT_EQ(a->wi, b->wi);
        EXPECT_EQ(a->weight, b->weight);
        EXPECT_EQ(a->pdf, b->pdf);
    }
}

// By the largest sum of a channel, so that the hues stay; what is negative is nothing.
TEST(Translucent, IsScaledWhereItWouldMakeLight)
{
    const Vec3 wo{0, 0, 1};
    const auto lobes = [&](Color r, Color t) {
        const TranslucentBsdf bsdf(r, t);
        return std::pair{bsdf.eval(wo, {0, 0, 1}).f_cos * pi, bsdf.eval(wo, {0, 0, -1}).f_cos * pi};
    };
    const auto [r, t] = lobes({1, 0.5f, 0.2f}, {0.6f, 1, 0.1f});
    expect_near(r, Color{1, 0.5f, 0.2f} / 1.6f);
    expect_near(t, Color{0.6f, 1, 0.1f} / 1.6f);
    const auto [same_r, same_t] = lobes({1, 0, 0.5f}, {0, 1, 0.5f});
    expect_near(same_r, {1, 0, 0.5f});
    expect_near(same_t, {0, 1, 0.5f});
    const auto [dark, rest] = lobes({-1, -2, -3}, {-0.5f, 0.5f, 0.5f});
    expect_near(dark, {0, 0, 0});
    expect_near(rest, {0, 0.5f, 0.5f});
    EXPECT_TRUE(is_black(TranslucentBsdf({-1, -1, -1}, {-1, -1, -1}).reflectance()));
}

TEST(Translucent, TakesBothColoursFromTheirTextures)
{
    const std::vector<Texture> textures{Checker{.even = {0.5f, 0.25f, 1}, .odd = {0.5f, 0.25f, 1}},
                                        Checker{.even = {0.25f, 1, 0.5f}, .odd = {0.25f, 1, 0.5f}}};
    const Translucent leaf{{reflected, 0}, {transmitted, 1}};
    const TranslucentBsdf bsdf = leaf.at({.textures = textures.data(), .vertex_color = {1, 0.5f, 1}});
    expect_near(bsdf.reflected(), reflected * Color{0.5f, 0.125f, 1});
    expect_near(bsdf.reflectance(), reflected * Color{0.5f, 0.125f, 1} + transmitted * Color{0.25f, 1, 0.5f});
    expect_near(leaf.phong({.textures = textures.data()}).diffuse, reflected * Color{0.5f, 0.25f, 1});
}

}  // namespace
}  // namespace lancer
