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

// A lamp in the left half. Beside it the denoised picture has light of it that is not there, which is much for what is
// dark there.
TEST(HeldOutError, IsRelativeToWhatIsDarkBesideALamp)
{
    constexpr uint32_t width = 96, height = 64, edge = 48;
    Film film(width, height, {0, 0, width, height});
    film.keep_sets({.replicates = 4});
    std::vector<Color> denoised(film.pixels.size());
    double truth = 0;
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            const size_t i = film.index(x, y);
            const double light = x < edge ? 20 : 0.5, off = x == edge ? 0.4 : 0;
            film.pixels[i] += {{light, light, light}, light * light, 1};
            for (size_t k = 2; k < 4; ++k) film.sets[4 * i + k].n = 1, film.sets[4 * i + k].sum = {light, light, light};
            const auto shown = static_cast<float>(light + off);
            denoised[i] = {shown, shown, shown};
            truth += off * off / (light * light + 0.01) / (width * height);
        }
    const auto error = held_out_error(film, denoised);
    ASSERT_TRUE(error);
    EXPECT_NEAR(error->rel_mse, truth, 0.01 * truth);
}

TEST(HeldOutError, IsNotKnownWithoutSamples)
{
    Film film(4, 4, {0, 0, 4, 4});
    film.keep_sets({.replicates = 4});
    EXPECT_FALSE(held_out_error(film, std::vector<Color>(16)));
}

}  // namespace
}  // namespace lancer
