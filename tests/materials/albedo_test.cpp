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
        const Metal single{{1, 1, 1}, std::sqrt(alpha)}, all{{1, 1, 1}, std::sqrt(alpha), {}, table_of_reflectors()};
        const float once = directional_albedo(single.at({}), cos, 8).g;
        EXPECT_LE(once, 1 + 1e-3f) << name;
        // What the table says is missing, is.
        EXPECT_NEAR(once, 1 - table_of_reflectors()->loss(cos, alpha), 0.005) << name;
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
    const Metal copper{{0.95f, 0.64f, 0.54f}, 1}, all{{0.95f, 0.64f, 0.54f}, 1, {}, table_of_reflectors()};
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

// Whatever the index, the roughness and the side: a table that is right at its nodes alone would fail between them.
TEST(Albedo, OfWhiteGlassIsOne)
{
    for (const float ior : {0.4f, 0.7f, 1.02f, 1.1f, 1.5f, 2.5f})
        for (const bool thin : {false, true}) {
            for_each_angle([&](const std::string& name, float alpha, float cos) {
                const Glass glass = make_glass({1, 1, 1}, ior, std::sqrt(alpha), thin);
                for (const bool front : {true, false})
                    EXPECT_NEAR(directional_albedo(glass.at({.front = front}), cos).g, 1, 0.01)
                        << name << ' ' << ior << (thin ? " thin" : "") << (front ? "" : ", from the inside");
            });
        }
}

// What the tables say is missing of single scattering, is.
TEST(Albedo, TablesOfGlassSayWhatIsMissing)
{
    for (const double eta : {1.5, 1 / 1.5, 2.42})
        for_each_angle([&](const std::string& name, float alpha, float cos) {
            const bool enters = eta > 1;
            AlbedoTable boundary(FacetKind::boundary, eta);
            boundary.need(alpha);
            const Glass single{{1, 1, 1}, static_cast<float>(enters ? eta : 1 / eta), std::sqrt(alpha)};
            EXPECT_NEAR(directional_albedo(single.at({.front = enters}), cos).g, 1 - boundary.loss(cos, alpha), 0.005)
                << name << ' ' << eta;
        });
}

// In nested dielectrics the index changes with what is outside: the tables are those of the two media that touch.
TEST(Albedo, OfWhiteGlassInAMediumThatItTouchesIsOne)
{
    GlassLosses losses(1.5f, false);
    losses.need(0.64f);
    losses.touch(2.0f);
    for (const bool front : {true, false})
        for (const double inner : {1.5, 0.75})
            for (const float cos : table_cosines) {
                const double eta = front ? inner : 1 / inner;
                const GlassBsdf bsdf{.tint = {1, 1, 1},
                                     .eta = eta,
                                     .alpha = 0.64f,
                                     .multiple = losses.lobes(eta, front, 0.64f, {1, 1, 1})};
                EXPECT_NEAR(directional_albedo(bsdf, cos).g, 1, 0.01) << front << ' ' << inner << ' ' << cos;
            }
}

// A film changes what facets reflect, and with that what they lose: whatever its index and its part, the glass and the
// side, all comes back in each channel.
TEST(Albedo, OfWhiteGlassUnderAFilmIsOne)
{
    for (const float ior : {1.5f, 0.7f})
        for (const bool thin : {false, true})
            for (const float part : {1.0f, 0.4f})
                for (const float roughness : {0.3f, 1.0f}) {
                    const Principled glass = make_principled([&](MaterialDescription& m) {
                        m.transmission = 1, m.ior = ior, m.roughness = roughness, m.thin = thin;
                        m.film = part, m.film_ior = 2;
                    });
                    for (const float cos : {1.0f, 0.72f, 0.3f, 0.03f})
                        for (const bool front : {true, false}) {
                            const Color albedo = directional_albedo(glass.at({.front = front}), cos);
                            for (const auto channel : {&Color::r, &Color::g, &Color::b})
                                EXPECT_NEAR(albedo.*channel, 1, 0.01)
                                    << ior << (thin ? " thin " : " ") << part << ' ' << roughness << ' ' << cos
                                    << (front ? "" : ", from the inside");
                        }
                }
}

// What comes back has met facets more than once: it is deeper in colour, and less than what a white glass gets.
TEST(Albedo, OfColouredGlassGrowsWithMultipleScatteringAndDeepensItsColour)
{
    const Color green{0.5f, 0.9f, 0.7f};
    for (const bool thin : {false, true}) {
        const Glass all = make_glass(green, 1.5f, 1, thin);
        Glass once = all;
        once.losses.reset();
        for (const float cos : table_cosines) {
            const Color single = directional_albedo(once.at({}), cos), more = directional_albedo(all.at({}), cos);
            const Color added = more - single;
            EXPECT_GT(added.r, 0) << cos;
            EXPECT_LT(more.g, 1) << cos;
            EXPECT_LT(added.r / added.g, single.r / single.g) << cos;
        }
    }
}

// Below an index of 1 the reflectance has an edge; the cosines lie on both sides of it.
TEST(Albedo, OfWhitePlasticIsOne)
{
    for (const float ior : {0.4f, 0.5f, 0.7f, 0.95f, 1.01f, 1.5f, 2.42f}) {
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
    for (const double eta : {1.5, 0.7}) {
        AlbedoTable whole(FacetKind::coat, eta);
        whole.need_all();
        Random random(1);
        std::vector<float> some{0x1p-149f, 0x1p-14f, 0x1p-13f, 0.25f, 0.25f + 0x1p-26f, 0.875f, 1 - 0x1p-24f, 1};
        for (int i = 0; i < 20; ++i) some.push_back(std::exp2(static_cast<float>(random.uniform(-15, 0))));
        for (const float alpha : some) {
            AlbedoTable alone(FacetKind::coat, eta);
            alone.need(alpha);
            EXPECT_NE(alone.loss(0.5f, alpha), 0) << alpha;
            EXPECT_EQ(alone.mean_missing(alpha), whole.mean_missing(alpha)) << alpha;
            for (const float cos : {0x1p-149f, 0x1p-12f, 0.001f, 0.3f, 0.714f, 0.715f, 0.99f, 1.0f})
                EXPECT_EQ(alone.loss(cos, alpha), whole.loss(cos, alpha)) << alpha << ' ' << cos;
        }
    }
}

TEST(Albedo, TablesAreWithinTheirBounds)
{
    AlbedoTable coat(FacetKind::coat, 1.5), entered(FacetKind::boundary, 1.5), left(FacetKind::boundary, 1 / 1.5),
        sheet(FacetKind::sheet, 1.5), thin_coat(FacetKind::coat, 0.6), thin_sheet(FacetKind::sheet, 0.6);
    for (AlbedoTable* t : {&coat, &entered, &left, &sheet, &thin_coat, &thin_sheet}) t->need_all();
    for (const AlbedoTable* t : std::array<const AlbedoTable*, 7>{table_of_reflectors().get(), &coat, &entered, &left,
                                                                  &sheet, &thin_coat, &thin_sheet}) {
        for_each_angle([&](const std::string& name, float alpha, float cos) {
            EXPECT_LE(t->loss(cos, alpha), 1) << name;
            EXPECT_GT(t->mean_missing(alpha), 0) << name;
            EXPECT_LE(t->mean_missing(alpha), 1) << name;
        });
        for (const float alpha : table_alphas)
            EXPECT_NEAR(t->loss(0x1p-149f, alpha), t->loss(0x1p-14f, alpha), 0)
                << "below the first node its value holds";
    }
}

// By the midpoint rule over the squared sine: also where light leaves within a narrow cone alone.
TEST(Albedo, MeanTransmittanceOfAnyIndex)
{
    for (const double eta : {0.02, 0.1, 0.5, 0.75, 1.0, 1.33, 2.5}) {
        constexpr int count = 1000000;
        double sum = 0;
        for (int i = 0; i < count; ++i) {
            const double sin2 = (i + 0.5) / count;
            sum += 1 - fresnel_dielectric_double(std::sqrt(1 - sin2), sin2, eta).reflectance;
        }
        EXPECT_NEAR(mean_transmittance(eta), sum / count, 1e-5 * sum / count + 1e-7) << eta;
    }
}

}  // namespace
}  // namespace lancer
