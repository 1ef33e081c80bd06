// How much light rough materials send back, by every roughness and angle: never more than they get, all of it where
// they promise to lose none, and what the closed forms say.
#include "materials/albedo_table.h"

#include <gtest/gtest.h>

#include "materials/samples.h"

namespace lancer {
namespace {

constexpr float table_alphas[] = {1, 0.8f, 0.5f, 0.22f, 0.1f, 0.03f, 0.01f, 0.001f, 1e-4f};
constexpr float table_cosines[] = {1, 0.95f, 0.7f, 0.45f, 0.3f, 0.1f, 0.03f, 0.01f};

// Energy that comes back from one direction, by samples that are shaken in the cells of a grid: those few that lean far
// count. `lobes`: layers of u.
template <class B>
Color directional_albedo(const B& bsdf, float cos, int lobes = 16)
{
    const Vec3 wo{std::sqrt((1 - cos) * (1 + cos)), 0, cos};
    Random random(1);
    constexpr int n = 40;
    std::array<double, 3> sum{};
    for (int k = 0; k < lobes; ++k)
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const float u = random.unit(), x = random.unit(), y = random.unit();
                const auto at = [](int cell, float part, int of) {
                    return std::min(1 - 0x1p-24f, (static_cast<float>(cell) + part) / static_cast<float>(of));
                };
                const auto s = bsdf.sample(wo, at(k, u, lobes), {at(i, x, n), at(j, y, n)});
                if (!s) continue;
                const Color c = s->weight * (s->eta * s->eta);
                sum[0] += static_cast<double>(c.r), sum[1] += static_cast<double>(c.g),
                    sum[2] += static_cast<double>(c.b);
            }
    const double scale = 1.0 / (lobes * n * n);
    return {static_cast<float>(sum[0] * scale), static_cast<float>(sum[1] * scale), static_cast<float>(sum[2] * scale)};
}

// f(name, alpha, cos)
template <class F>
void for_each_angle(const F& f)
{
    for (const float alpha : table_alphas)
        for (const float cos : table_cosines)
            f("alpha " + std::to_string(alpha) + ", cos " + std::to_string(cos), alpha, cos);
}

TEST(Albedo, OfWhiteMetal)
{
    for_each_angle([](const std::string& name, float alpha, float cos) {
        const Metal single{{1, 1, 1}, std::sqrt(alpha)}, all{{1, 1, 1}, std::sqrt(alpha), {}, &AlbedoTable::white()};
        const float once = directional_albedo(single.at({}), cos, 8).g;
        EXPECT_LE(once, 1 + 1e-3f) << name;
        // What the table says is missing, is.
        EXPECT_NEAR(once, 1 - AlbedoTable::white().loss(cos, alpha), 0.005) << name;
        const float albedo = directional_albedo(all.at({}), cos).g;
        EXPECT_GE(albedo, 0.99f) << name;
        EXPECT_LE(albedo, 1.01f) << name;
    });
}

// The rougher, the more is lost without compensation.
TEST(Albedo, OfRoughMetalIsFarFromOneWithoutCompensation)
{
    EXPECT_NEAR(directional_albedo(Metal{{1, 1, 1}, 1}.at({}), 1).g, 0.307f, 0.003f);
}

TEST(Albedo, OfColouredMetalGrowsWithCompensationAndDeepensItsColour)
{
    const Metal copper{{0.95f, 0.64f, 0.54f}, 1}, all{{0.95f, 0.64f, 0.54f}, 1, {}, &AlbedoTable::white()};
    for (const float cos : table_cosines) {
        const Color once = directional_albedo(copper.at({}), cos), more = directional_albedo(all.at({}), cos);
        for (const auto channel : {&Color::r, &Color::g, &Color::b}) {
            EXPECT_GT(more.*channel, once.*channel);
            EXPECT_LT(more.*channel, 1);
        }
        const Color added = more - once;
        EXPECT_LT(added.b / added.r, once.b / once.r);
    }
}

TEST(Albedo, OfGlassIsAtMostOne)
{
    for_each_angle([](const std::string& name, float alpha, float cos) {
        for (const float ior : {1.5f, 1 / 1.5f}) {
            const float albedo = directional_albedo(Glass{{1, 1, 1}, ior, std::sqrt(alpha)}.at({}), cos).g;
            EXPECT_LE(albedo, 1 + 1e-3f) << name << " " << ior;
            if (alpha <= 0.001f) {
                EXPECT_GE(albedo, 0.99f) << name << " " << ior;
            }
        }
    });
}

TEST(Albedo, OfWhitePlasticIsOne)
{
    for (const float ior : {1.01f, 1.5f, 2.42f}) {
        const Plastic rough = make_plastic({1, 1, 1}, 1, ior);
        for_each_angle([&](const std::string& name, float alpha, float cos) {
            Plastic plastic = rough;
            plastic.roughness = std::sqrt(alpha);
            EXPECT_NEAR(directional_albedo(plastic.at({}), cos).g, 1, 0.01) << name << " " << ior;
        });
    }
}

// Of the light that crosses a smooth coat the base returns what its colour says.
TEST(Albedo, OfSmoothPlasticIsItsColourOfWhatCrosses)
{
    for (const float ior : {1.1f, 1.5f, 2.0f})
        for (const float rho : {0.1f, 0.5f, 0.9f})
            for (const float cos : table_cosines) {
                const auto reflectance = [&](double c) {
                    return static_cast<double>(fresnel_dielectric(static_cast<float>(c), ior).reflectance);
                };
                double smooth = 0;
                const Plastic plastic = make_plastic({rho, rho, rho}, 0, ior);
                const auto bsdf = plastic.at({});
                const Vec3 wo{std::sqrt((1 - cos) * (1 + cos)), 0, cos};
                constexpr int count = 2000;
                for (int i = 0; i < count; ++i) {
                    const double c = (i + 0.5) / count;
                    const Vec3 wi = to_float(Vec3d{0, std::sqrt((1 - c) * (1 + c)), c});
                    smooth += 2 * std::numbers::pi * static_cast<double>(bsdf.eval(wo, wi).f_cos.g) / count;
                }
                const double in = 1 - reflectance(static_cast<double>(cos));
                EXPECT_NEAR(smooth, in * static_cast<double>(rho), 2e-4) << ior << " " << rho << " " << cos;
                const auto coat = bsdf.sample(wo, 0, {});
                ASSERT_TRUE(coat && coat->delta);
                EXPECT_NEAR(coat->weight.g * coat->pdf, 1 - in, 1e-6);
            }
}

// The mean of the directional albedo, weighted by the cosine, is what denoisers are told.
TEST(Albedo, OfPlasticUnderEvenLight)
{
    for (const float roughness : {0.0f, 0.3f, 0.8f}) {
        const Plastic plastic = make_plastic({0.8f, 0.4f, 0.1f}, roughness, 1.5f, {1, 0.5f, 0.9f});
        Color sum{};
        constexpr int n = 64;
        for (int i = 0; i < n; ++i) {
            const float cos = (static_cast<float>(i) + 0.5f) / n;
            sum += directional_albedo(plastic.at({}), cos) * (2 * cos / n);
        }
        const Color said = plastic.at({}).reflectance();
        for (const auto channel : {&Color::r, &Color::g, &Color::b})
            EXPECT_NEAR(sum.*channel, said.*channel, 0.01) << roughness;
    }
}

// Of a table that has what one alpha needs the answers are those of the whole, to the bit; at nodes and at both ends
// too.
TEST(Albedo, TablesDoNotDependOnWhatElseWasNeeded)
{
    AlbedoTable whole(1.5f);
    whole.need_all();
    Random random(1);
    std::vector<float> some{0x1p-149f, 0x1p-14f, 0x1p-13f, 0.25f, 0.25f + 0x1p-26f, 0.875f, 1 - 0x1p-24f, 1};
    for (int i = 0; i < 20; ++i) some.push_back(std::exp2(static_cast<float>(random.uniform(-15, 0))));
    for (const float alpha : some) {
        AlbedoTable alone(1.5f);
        alone.need(alpha);
        EXPECT_NE(alone.loss(0.5f, alpha), 0) << alpha;
        EXPECT_EQ(alone.mean_missing(alpha), whole.mean_missing(alpha)) << alpha;
        for (const float cos : {0x1p-149f, 0x1p-12f, 0.001f, 0.3f, 0.99f, 1.0f})
            EXPECT_EQ(alone.loss(cos, alpha), whole.loss(cos, alpha)) << alpha << ' ' << cos;
    }
}

TEST(Albedo, TablesAreWithinTheirBounds)
{
    AlbedoTable coat(1.5f);
    coat.need_all();
    for (const AlbedoTable* t : std::array<const AlbedoTable*, 2>{&AlbedoTable::white(), &coat}) {
        for_each_angle([&](const std::string& name, float alpha, float cos) {
            EXPECT_LE(t->loss(cos, alpha), 1) << name;
            EXPECT_GT(t->mean_missing(alpha), 0) << name;
            EXPECT_LE(t->mean_missing(alpha), 1) << name;
        });
        for (const float alpha : table_alphas)
            EXPECT_NEAR(t->loss(0x1p-149f, alpha), t->loss(0x1p-12f, alpha), 0)
                << "below the first node its value holds";
    }
}

}  // namespace
}  // namespace lancer
