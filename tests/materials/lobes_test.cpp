// The lobes of rough surfaces, however narrow: are they sampled with their density, and does that add up?
#include <gtest/gtest.h>

#include "support/facet_cells.h"

namespace lancer {
namespace {

constexpr float alphas[] = {1, 0.5f, 0.1f, 0.01f, 0.001f, 1e-4f};
constexpr float cosines[] = {1, 0.7f, 0.1f, 0.01f};

template <class B>
void expect_sampled(const B& bsdf, float alpha, float cos, const std::string& name, stats::Family& family)
{
    const LobeSample lobe = sample_lobe(bsdf, alpha, cos, 50000, 1);
    EXPECT_LE(lobe.total, 1 + 2e-3) << name;
    // What is sampled is also what is there.
    EXPECT_NEAR(lobe.energy.mean, lobe.there, 0.01 * lobe.there + 5 * lobe.energy.error()) << name;
    family.add(lobe.p, name);
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
        const Metal metal{{0.9f, 0.6f, 0.3f}, std::sqrt(alpha), {}, table_of_reflectors()};
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
