// The parts of the principled material, each by what is known of it.
#include "materials/principled.h"

#include <gtest/gtest.h>

#include "materials/rough_diffuse.h"
#include "materials/samples.h"
#include "materials/thin_film.h"
#include "scene/build/material_builder.h"
#include "support/exact_ggx.h"

namespace lancer {
namespace {

constexpr float Color::*of_film[] = {&Color::r, &Color::g, &Color::b};

// Without a thickness the two faces are one: the film does not count.
TEST(ThinFilm, WithoutThicknessIsTheBareBoundary)
{
    for (const float film : {1.0f, 1.33f, 2.0f})
        for (const float base : {1.0001f, 1.5f, 2.4f})
            for (const float cos : {1.0f, 0.7f, 0.3f, 0.05f}) {
                const Color r = ThinFilm{film, 0}.on_dielectric(cos, base);
                const float bare = fresnel_dielectric(cos, base).reflectance;
                for (const auto channel : of_film) EXPECT_NEAR(r.*channel, bare, 2e-3f) << film << base << cos;
            }
}

// A quarter of a wave of the root of the index lets all through from the front.
TEST(ThinFilm, AQuarterWaveReflectsLeast)
{
    const float n = 2.25f, film = std::sqrt(n);
    const float green = ThinFilm{film, 545 / (4 * film)}.on_dielectric(1, n).g;
    EXPECT_LT(green, 0.002f) << "beside 0.148 without it";
    const float half = ThinFilm{film, 545 / (2 * film)}.on_dielectric(1, n).g;
    EXPECT_NEAR(half, fresnel_dielectric(1.0f, n).reflectance, 0.006f);
}

// Fringes fade; what is left is the sum of intensities, the same of all channels.
TEST(ThinFilm, AThickFilmHasNoColour)
{
    for (const float cos : {1.0f, 0.4f}) {
        const Color r = ThinFilm{1.5f, 5e4f}.on_dielectric(cos, 2.0f);
        EXPECT_NEAR(r.r, r.g, 1e-5f);
        EXPECT_NEAR(r.b, r.g, 1e-5f);
    }
    const auto part = [](float n) { return fresnel_dielectric(1.0f, n).reflectance; };
    const float a = part(1.5f), b = part(2.0f / 1.5f);
    EXPECT_NEAR(ThinFilm({1.5f, 5e4f}).on_dielectric(1, 2.0f).g, a + b * (1 - a) * (1 - a) / (1 - a * b), 1e-4f);
}

TEST(ThinFilm, ReflectsAPart)
{
    for (float thickness = 0; thickness < 2000; thickness += 37)
        for (const float cos : {1.0f, 0.5f, 0.1f, 1e-3f, 0.0f})
            for (const float base : {0.5f, 1.0f, 1.5f, 50.0f}) {
                for (const Color r : {ThinFilm{1.6f, thickness}.on_dielectric(cos, base),
                                      ThinFilm{0.8f, thickness}.on_metal(cos, {0.9f, 0, 1})})
                    for (const auto channel : of_film) {
                        ASSERT_GE(r.*channel, 0) << thickness << " " << cos;
                        ASSERT_LE(r.*channel, 1) << thickness << " " << cos;
                    }
            }
    EXPECT_EQ(ThinFilm({1.5f, 300}).on_metal(0.3f, {1, 1, 1}), (Color{1, 1, 1})) << "a perfect mirror stays one";
}

TEST(RoughDiffuse, IsLambertsWhereItIsSmooth)
{
    const RoughDiffuse smooth(0);
    const Color f = smooth.eval({0.8f, 0.4f, 0.2f}, {0.6f, 0, 0.8f}, {0, 0.8f, 0.6f});
    EXPECT_NEAR(f.r, 0.8f / pi, 1e-6f);
    EXPECT_NEAR(f.b, 0.2f / pi, 1e-6f);
}

// A rough surface sends more light back to where it came from, and is flatter than Lambert's.
TEST(RoughDiffuse, SendsLightBack)
{
    const RoughDiffuse rough(1);
    const Vec3 wo = normalize(Vec3{0.8f, 0, 0.6f});
    const float back = rough.eval({0.5f, 0.5f, 0.5f}, wo, wo).g;
    const float forth = rough.eval({0.5f, 0.5f, 0.5f}, wo, {-wo.x, 0, wo.z}).g;
    EXPECT_GT(back, 0.5f / pi);
    EXPECT_LT(forth, 0.8f * back);
}

TEST(Anisotropy, KeepsTheMeanOfTheSquaredAlphas)
{
    for (const float a : {0.0f, 0.3f, 0.8f}) {
        const AlphaPair alpha = alphas_of(0.6f, a);
        EXPECT_NEAR(alpha.across, (1 - a) * alpha.along, 1e-6f);
        EXPECT_NEAR(alpha.along * alpha.along + alpha.across * alpha.across, 2 * 0.36f * 0.36f, 1e-6f);
    }
    EXPECT_EQ(alphas_of(0, 0.5f).along, 0) << "a smooth surface stays smooth";
}

// Equal alphas are the isotropic facets.
TEST(Anisotropy, OfNoneIsThatOfIsotropicFacets)
{
    const Vec3d wo = normalize(Vec3d{0.3, 0.5, 0.7}), wi = normalize(Vec3d{-0.6, 0.1, 0.4});
    const FacetReflection a = eval_facets(Ggx{0.3}, wo, wi), b = eval_stretched(StretchedGgx{0.3, 0.3}, wo, wi);
    EXPECT_NEAR(a.f_cos, b.f_cos, 1e-12);
    EXPECT_NEAR(a.pdf, b.pdf, 1e-12);
    EXPECT_EQ(a.cos_h, b.cos_h);
}

// Single scattering by brushed metal of reflectance 1 against its definition in long double: Heitz 2014, equations 85
// to 87 and 99, where h and both directions are turned into the frame of the tangent.
TEST(Anisotropy, ValuesAndDensitiesAreExact)
{
    Random random(11);
    double largest = 0;
    for (int k = 0; k < 20000; ++k) {
        MaterialDescription m = default_description(MaterialType::principled);
        m.base_color = {1, 1, 1}, m.metallic = 1.0f, m.roughness = static_cast<float>(random.uniform(0.3, 1));
        m.anisotropy = 0.95f * random.unit(), m.anisotropy_rotation = random.unit();
        const auto brushed = std::get<Principled>(
            MaterialBuilder({.multiscatter = false}).make(m, [](const TextureUse&) { return no_texture; }));
        const double to_tangent = random.uniform(0, 2 * std::numbers::pi);
        const Vec2 tangent{static_cast<float>(std::cos(to_tangent)), static_cast<float>(std::sin(to_tangent))};
        const PrincipledBsdf b = brushed.at({.tangent = tangent});
        Vec3 wo = random.unit_vector();
        wo.z = std::max(1e-3f, std::abs(wo.z)), wo = normalize(wo);
        const auto sent = b.sample(wo, 0.5f, {random.unit(), random.unit()});
        if (!sent) continue;
        const AlphaPair alpha = alphas_of(m.roughness, m.anisotropy);
        const long double ax = alpha.along, ay = alpha.across;
        const long double turn = std::atan2(static_cast<long double>(tangent.y), static_cast<long double>(tangent.x)) +
                                 2 * std::numbers::pi_v<long double> * m.anisotropy_rotation;
        const auto turned = [&](Vec3 w) {
            const Long u = unit(w);
            const long double c = std::cos(turn), s = std::sin(turn);
            return Long{c * u.x + s * u.y, c * u.y - s * u.x, u.z};
        };
        const auto lambda = [&](const Long& w) {
            return (std::sqrt(1 + (ax * ax * w.x * w.x + ay * ay * w.y * w.y) / (w.z * w.z)) - 1) / 2;
        };
        const Long o = turned(wo), i = turned(sent->wi), sum{o.x + i.x, o.y + i.y, o.z + i.z};
        const long double l2 = sum.x * sum.x + sum.y * sum.y + sum.z * sum.z;
        const long double x = sum.x / ax, y = sum.y / ay, s = (x * x + y * y + sum.z * sum.z) / l2;
        const long double d = 1 / (std::numbers::pi_v<long double> * ax * ay * s * s);
        const auto f_cos = static_cast<double>(d / (4 * o.z * (1 + lambda(o) + lambda(i))));
        const auto pdf = static_cast<double>(d / (4 * o.z * (1 + lambda(o))));
        const BsdfValue f = b.eval(wo, sent->wi);
        const double off = std::max(std::abs(double{f.f_cos.g} / f_cos - 1), std::abs(double{f.pdf} / pdf - 1));
        largest = std::max(largest, off);
    }
    EXPECT_LT(largest, 1e-4);
    EXPECT_GT(largest, 1e-9);
}

// The highlight is long across the scratches: along the tangent, from either side and however the tangent is turned.
TEST(Anisotropy, FollowsTheTangent)
{
    const auto brushed = [](float rotation) {
        return make_principled([&](MaterialDescription& m) {
            m.metallic = 1.0f, m.roughness = 0.4f, m.anisotropy = 0.8f, m.anisotropy_rotation = rotation;
        });
    };
    const Vec3 wo{0, 0, 1}, to_x = normalize(Vec3{0.5f, 0, 1}), to_y = normalize(Vec3{0, 0.5f, 1});
    const auto ratio = [&](const Principled& p, ShadingPoint at) {
        const PrincipledBsdf b = p.at(at);
        return b.eval(wo, to_x).f_cos.g / b.eval(wo, to_y).f_cos.g;
    };
    const float along = ratio(brushed(0), {});
    EXPECT_GT(along, 3);
    EXPECT_NEAR(ratio(brushed(0.25f), {}), 1 / along, 1e-3f);
    EXPECT_NEAR(ratio(brushed(0), {.tangent = {0, 1}}), 1 / along, 1e-3f);
    // Turned by an eighth on the front, seen from behind, where the frame is mirrored, it is turned the other way.
    const Principled turned = brushed(0.125f);
    const Vec3 diagonal = normalize(Vec3{0.5f, 0.5f, 1}), other = normalize(Vec3{0.5f, -0.5f, 1});
    EXPECT_GT(turned.at({}).eval(wo, diagonal).f_cos.g, 3 * turned.at({}).eval(wo, other).f_cos.g);
    EXPECT_LT(turned.at({.front = false}).eval(wo, diagonal).f_cos.g,
              turned.at({.front = false}).eval(wo, other).f_cos.g / 3);
}

// What a table says of albedos is what the lobe sends.
TEST(Fuzz, HasTheAlbedoOfItsTable)
{
    FuzzTable table;
    table.need_all();
    for (const float roughness : {0.0f, 0.3f, 0.55f, 1.0f})
        for (const float z : {0.05f, 0.3f, 0.9f}) {
            const Fuzz fuzz{roughness};
            const Vec3 wo{std::sqrt(1 - z * z), 0, z};
            constexpr int n = 200;
            double sum = 0;
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    const Vec3 wi = square_to_cosine_hemisphere(
                        Vec2{(static_cast<float>(i) + 0.5f) / n, (static_cast<float>(j) + 0.5f) / n});
                    sum += static_cast<double>(fuzz.eval(wo, wi) * pi);
                }
            const FuzzTable::Row row = table.row(roughness);
            const double albedo = sum / (n * n) * static_cast<double>(row.scale());
            EXPECT_NEAR(row.albedo(z), albedo, 0.01) << roughness << " " << z;
            EXPECT_LE(row.albedo(z), 1);
        }
}

// Values of textures and points, whatever they are: nothing leaves its range.
TEST(Principled, ClampsWhatTexturesSay)
{
    const Principled p = make_principled([](MaterialDescription& m) { m.coat = m.fuzz = m.film = 0.5f; });
    Principled wild = p;
    wild.metallic.value = 3, wild.coat.value = -1, wild.fuzz.value = std::nanf("");
    const PrincipledBsdf b = wild.at({});
    EXPECT_EQ(b.metallic, 1);
    EXPECT_EQ(b.coat, 0);
    EXPECT_EQ(b.fuzz, 0);
}

}  // namespace
}  // namespace lancer
