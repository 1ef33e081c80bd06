// The error that samples held out tell of a denoised picture.
#include "report/metrics/held_out_error.h"

#include <gtest/gtest.h>

#include "support/random.h"

namespace lancer {
namespace {

// A picture of radiance 0.5 whose held-out sets have noise of 0.2, and a denoised one that is off by `bias`.
std::optional<HeldOutError> told(float bias, uint64_t seed)
{
    Film film(96, 64, {0, 0, 96, 64});
    film.keep_sets({.replicates = 4});
    Random random(seed);
    for (size_t i = 0; i < film.pixels.size(); ++i) {
        film.pixels[i] += {{0.5, 0.5, 0.5}, 0.25, 1};
        for (size_t k = 2; k < 4; ++k) {
            SampleSet& set = film.sets[4 * i + k];
            set.n = 2;
            for (double& s : set.sum) s = 2 * (0.5 + random.uniform(-0.35, 0.35));
        }
    }
    return held_out_error(film, std::vector<Color>(film.pixels.size(), Color{0.5f + bias, 0.5f, 0.5f}));
}

TEST(HeldOutError, IsTheSquaredErrorWithoutTheNoiseOfTheSets)
{
    int contained = 0;
    for (uint64_t seed = 0; seed < 40; ++seed) {
        const auto error = told(0.3f, seed);
        ASSERT_TRUE(error);
        const double truth = 0.3 * 0.3 / 0.26 / 3;
        EXPECT_NEAR(error->rel_mse, truth, 0.01);
        contained += error->interval.contains(truth);
    }
    EXPECT_GE(contained, 33);  // 38 of 40 are expected; fewer than 34 have a chance of 1 %
    EXPECT_NEAR(told(0, 1)->rel_mse, 0, 0.01);
}

TEST(HeldOutError, IsNotKnownWithoutSamples)
{
    Film film(4, 4, {0, 0, 4, 4});
    film.keep_sets({.replicates = 4});
    EXPECT_FALSE(held_out_error(film, std::vector<Color>(16)));
}

}  // namespace
}  // namespace lancer
