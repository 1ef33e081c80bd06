// A thin sheet against the series that it stands for.
#include <gtest/gtest.h>

#include "materials/samples.h"

namespace lancer {
namespace {

// What a slab of two smooth faces sends back and lets through, order by order: each meeting with a face multiplies by
// the tint.
struct Slab {
    double back, through = 0;
};
Slab series(double r, double tint)
{
    Slab s{tint * r};
    double between = tint * (1 - r);
    for (int face = 1; face < 20000; ++face) {
        (face % 2 == 1 ? s.through : s.back) += between * (1 - r) * tint;
        between *= r * tint;
    }
    return s;
}

TEST(ThinSheet, IsTheSumOfAllReflectionsBetweenItsFaces)
{
    const Color tint{1, 0.7f, 0.05f};
    for (const float ior : {1.0f, 1.33f, 1.5f, 2.42f, 0.75f})
        for (const Place& p : places()) {
            const auto sheet = Glass{.tint = tint, .ior = ior, .thin = true}.at(p.point);
            const double r = double{fresnel_dielectric(p.wo, double{ior}).reflectance};
            const auto back = sheet.sample(p.wo, 0, {}), through = sheet.sample(p.wo, 1 - 0x1p-24f, {});
            for (const auto channel : {&Color::r, &Color::g, &Color::b}) {
                const Slab expected = series(r, double{tint.*channel});
                if (back->wi.z > 0) {
                    EXPECT_NEAR(double{back->weight.*channel * back->pdf}, expected.back, 1e-6) << ior << p.name;
                }
                if (through->wi.z < 0) {
                    EXPECT_NEAR(double{through->weight.*channel * through->pdf}, expected.through, 1e-6)
                        << ior << p.name;
                }
            }
            EXPECT_EQ(back->wi.z > 0, r > 0) << ior << p.name;
            EXPECT_EQ(through->wi.z < 0, r < 1) << ior << p.name;
        }
}

TEST(ThinSheet, TurnsNothing)
{
    for (const Place& p : places()) {
        const auto sheet = Glass{.tint = {1, 1, 1}, .ior = 1.5f, .thin = true}.at(p.point);
        const auto back = sheet.sample(p.wo, 0, {}), through = sheet.sample(p.wo, 1 - 0x1p-24f, {});
        ASSERT_TRUE(back && through);
        EXPECT_EQ(back->wi, (Vec3{-p.wo.x, -p.wo.y, p.wo.z}));
        EXPECT_EQ(through->wi, -p.wo);
        EXPECT_EQ(through->eta, 1);
        EXPECT_EQ(through->weight, (Color{1, 1, 1}));
        EXPECT_EQ(back->weight, (Color{1, 1, 1}));
    }
}

TEST(ThinSheet, WithoutFresnelOnlyTints)
{
    const auto sheet = Glass{.tint = {0.5f, 1, 1}, .ior = 1.5f, .fresnel = false, .thin = true}.at({});
    for (const float u : {0.0f, 0.5f, 1 - 0x1p-24f}) {
        const auto s = sheet.sample({0.6f, 0, 0.8f}, u, {});
        ASSERT_TRUE(s);
        EXPECT_EQ(s->wi, (Vec3{-0.6f, 0, -0.8f}));
        EXPECT_EQ(s->weight, (Color{0.25f, 1, 1}));
    }
}

// The slopes of light that went through a rough sheet: two faces, each of which turns it by (index - 1) times the slope
// of its facets. Compared with refraction at two faces in turn.
TEST(ThinSheet, SpreadsAboutAsFarAsItsTwoFaces)
{
    Random random(5);
    const float roughness = std::sqrt(0.05f);
    const Glass solid{.tint = {1, 1, 1}, .ior = 1.5f, .roughness = roughness};
    const Glass thin{.tint = {1, 1, 1}, .ior = 1.5f, .roughness = roughness, .thin = true};
    const auto median = [&](const auto& through) {
        std::vector<double> slopes;
        for (int i = 0; i < 40000; ++i)
            if (const std::optional<Vec3> wi = through()) slopes.push_back(std::hypot(wi->x, wi->y) / std::abs(wi->z));
        std::nth_element(slopes.begin(), slopes.begin() + slopes.size() / 2, slopes.end());
        return slopes[slopes.size() / 2];
    };
    const auto sent = [&](const GlassBsdf& bsdf, Vec3 wo) -> std::optional<Vec3> {
        const float u = random.unit();
        const auto s = bsdf.sample(wo, u, random.unit2());
        if (!s || s->wi.z > 0) return {};
        return s->wi;
    };
    const Vec3 above{0, 0, 1};
    const double of_thin = median([&] { return sent(thin.at({}), above); });
    const double of_solid = median([&]() -> std::optional<Vec3> {
        const auto inside = sent(solid.at({}), above);
        if (!inside) return {};
        // At the other face, seen from within: z points inwards.
        return sent(solid.at({.front = false}), {-inside->x, inside->y, -inside->z});
    });
    EXPECT_NEAR(of_thin / of_solid, 1, 0.1);
}

}  // namespace
}  // namespace lancer
