// How fast pictures become better: the error falls as the root of the number of independent samples, and faster of
// Sobol' points.
#include <gtest/gtest.h>

#include "support/shoot.h"

namespace lancer {
namespace {

// How far two pictures lie apart that have nothing in common but what they show: the root of twice the variance.
double apart(const Film& a, const Film& b)
{
    double sum = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        const double d = tally(a.pixels[i]).mean - tally(b.pixels[i]).mean;
        sum += d * d;
    }
    return std::sqrt(sum);
}

// Light from a ball, a point and the sky on a bumpy thing and a floor; what shines is not in the picture, as few pixels
// at its edge would have most of the error.
SceneDescription matt_scene()
{
    SceneDescription d = lights_scene();
    d.meshes.pop_back();
    return d;
}

// Exponents of the error as a power of the number of samples, from 4 to 64; each of other random numbers.
stats::Tally exponents(uint32_t max_depth, SamplerKind sampler)
{
    stats::Tally found;
    for (uint64_t pair = 0; pair < 8; ++pair) {
        const auto error = [&](uint32_t spp) {
            // The pictures of 4 samples are no part of those of 64.
            const auto film = [&](uint64_t seed) {
                return shoot(matt_scene(), {.integrator = without_roulette({.max_depth = max_depth}),
                                            .width = 24,
                                            .height = 24,
                                            .spp = spp,
                                            .sampler = sampler,
                                            .seed = 1000 * spp + seed});
            };
            return apart(film(2 * pair), film(2 * pair + 1));
        };
        found.add(std::log(error(64) / error(4)) / std::log(16.0));
    }
    return found;
}

constexpr double student_99 = 3.5;  // two-sided, 7 degrees of freedom

TEST(Slope, IndependentSamplesGoByTheRoot)
{
    stats::Family family;
    for (const uint32_t max_depth : {1u, 3u}) {
        const stats::Tally t = exponents(max_depth, SamplerKind::independent);
        EXPECT_LT(student_99 * t.error(), 0.03) << "too unsure, at depth " << max_depth;
        family.add(stats::mean_p(t, -0.5), "depth " + std::to_string(max_depth));
    }
}

TEST(Slope, SobolPointsAreSteeper)
{
    for (const uint32_t max_depth : {1u, 3u}) {
        const stats::Tally t = exponents(max_depth, SamplerKind::sobol);
        EXPECT_LT(t.mean + student_99 * t.error(), -0.53) << "depth " << max_depth << ": " << t.mean;
    }
}

}  // namespace
}  // namespace lancer
