// Henyey and Greenstein's phase function: it is a density, its samples follow it, and it knows no direction of time.
#include "materials/phase_function.h"

#include <gtest/gtest.h>

#include "support/random.h"
#include "support/statistics/significance.h"

namespace lancer {
namespace {

const std::vector<float> asymmetries{-0.999f, -0.9f, -0.4f, -1e-3f, 0, 1e-7f, 1e-4f, 0.3f, 0.8f, 0.999f};

// In long double, by its formula.
long double exact_phase(long double g, long double cosine)
{
    return (1 - g * g) / (4 * std::numbers::pi_v<long double> * std::pow(1 + g * g - 2 * g * cosine, 1.5L));
}

TEST(PhaseFunction, IsTheFormulaAndTheSameBothWays)
{
    Random random(1);
    for (const float g : asymmetries)
        for (int i = 0; i < 200; ++i) {
            const Vec3 from = normalize(Vec3{random.unit() - 0.5f, random.unit() - 0.5f, random.unit() - 0.5f});
            // Close to where the lobe is as often as anywhere.
            const Vec3 off{random.unit() - 0.5f, random.unit() - 0.5f, random.unit() - 0.5f};
            const Vec3 to = normalize(i % 2 ? off : (g < 0 ? -from : from) + off * 0.02f);
            const HenyeyGreenstein phase{g};
            const Vec3d a = to_double(from), b = to_double(to);
            const long double cosine = dot(a, b) / (length(a) * length(b));
            const auto expected = static_cast<double>(exact_phase(static_cast<long double>(g), cosine));
            EXPECT_NEAR(double{phase.eval(from, to)} / expected, 1, 2e-3) << g;
            EXPECT_EQ(phase.eval(from, to), phase.eval(to, from)) << g;
            EXPECT_EQ(phase.eval(from, to), phase.eval(-to, -from)) << g;
        }
}

// Cells of equal probability in the cosine, by the inverse of the distribution in long double, times eight in azimuth.
TEST(PhaseFunction, SamplesFollowIt)
{
    stats::Family family;
    Random random(2);
    for (const float g : asymmetries) {
        constexpr size_t rings = 40, turns = 8;
        const HenyeyGreenstein phase{g};
        const Vec3 from = normalize(Vec3{0.3f, -0.7f, 0.2f});
        const Vec3 axis = g < 0 ? -from : from;  // of the lobe
        const Frame frame(axis);
        std::vector<uint64_t> counts(rings * turns);
        const long double h = std::abs(static_cast<long double>(g));
        for (int i = 0; i < 80000; ++i) {
            const Vec3 to = phase.sample(from, {random.unit(), random.unit()});
            ASSERT_NEAR(length(to), 1, 1e-6f);
            const Vec3d apart = to_double(to) - to_double(axis);
            const long double cosine = 1 - dot(apart, apart) / 2;
            // Part of the light that is deflected by more.
            const long double below =
                std::abs(h) < 1e-6L ? (1 + cosine) / 2
                                    : (1 - h * h) / (2 * h) * (1 / std::sqrt(1 + h * h - 2 * h * cosine) - 1 / (1 + h));
            const Vec3 local = frame.to_local(to);
            const float turn = std::atan2(local.y, local.x) / (2 * pi) + 0.5f;
            const auto cell = [](long double x, size_t n) {
                return std::min(n - 1, static_cast<size_t>(std::max(0.0L, x) * static_cast<long double>(n)));
            };
            ++counts[cell(below, rings) * turns + cell(static_cast<long double>(turn), turns)];
        }
        family.add(chi_square_uniform(counts).p, "g = " + std::to_string(g));
    }
}

}  // namespace
}  // namespace lancer
