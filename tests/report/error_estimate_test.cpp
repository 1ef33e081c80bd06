// Estimates of a picture's error, where the truth is known because the samples are made up.
#include "report/error_estimate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random.h"

namespace lancer {
namespace {

constexpr uint32_t side = 40;
constexpr double truth = 0.5;

Film film_of_replicates(uint32_t replicates)
{
    Film film(side, side, {0, 0, side, side});
    film.replicates.resize(film.pixels.size() * replicates);
    return film;
}

// Sum of twelve: mean 0, variance 1, nearly normal.
double nearly_normal(Random& random)
{
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += random.uniform();
    return sum;
}

// Adds n samples of deviation sigma to each pixel; all channels alike.
void add_samples(Film& film, uint32_t n, double sigma, Random& random, uint32_t replicates = 1)
{
    for (size_t i = 0; i < film.pixels.size(); ++i)
        for (uint32_t k = 0; k < n; ++k) {
            const uint32_t number = film.pixels[i].n;
            const double x = truth + sigma * nearly_normal(random);
            film.pixels[i] += {{x, x, x}, x * x, 1};
            if (film.replicates.empty()) continue;
            ReplicateSum& r = film.replicates[i * replicates + number % replicates];
            for (double& sum : r.sum) sum += x;
            ++r.n;
        }
}

double true_error(const Film& film)
{
    double sum = 0;
    for (const Pixel& p : film.pixels) {
        const double d = double{p.mean().r} - truth;
        sum += d * d / (truth * truth + 0.01);
    }
    return sum / static_cast<double>(film.pixels.size());
}

TEST(HalfBuffers, KnowNothingBeforeTheSecondLook)
{
    Random random(1);
    Film film(side, side, {0, 0, side, side});
    HalfBuffers halves;
    halves.look(film);
    EXPECT_FALSE(halves.rel_mse());
    add_samples(film, 8, 0.1, random);
    halves.look(film);
    EXPECT_FALSE(halves.rel_mse());
    add_samples(film, 8, 0.1, random);
    halves.look(film);
    EXPECT_TRUE(halves.rel_mse());
}

// Of independent samples: expected is the variance of the mean, and 1600 pixels tell it to 2 / sqrt(1600) = 5 %, four
// sigma being 20 %.
TEST(HalfBuffers, TellTheErrorOfIndependentSamples)
{
    for (const std::vector<uint32_t>& looks :
         {std::vector<uint32_t>{8, 8}, {8, 8, 16, 32}, {8, 8, 16, 32, 20}, {1, 1, 2, 4, 8}, {8, 4}}) {
        Random random(7);
        Film film(side, side, {0, 0, side, side});
        HalfBuffers halves;
        uint32_t n = 0;
        for (const uint32_t more : looks) {
            add_samples(film, more, 0.1, random);
            halves.look(film);
            n += more;
        }
        const double expected = 0.01 / n / (truth * truth + 0.01);
        EXPECT_NEAR(*halves.rel_mse() / expected, 1, 0.2) << n;
    }
}

// Pixels that have no more samples than before keep the estimate that they had.
TEST(HalfBuffers, PixelsThatEndedKeepWhatWasKnown)
{
    Random random(9);
    Film film(side, side, {0, 0, side, side});
    HalfBuffers halves;
    add_samples(film, 8, 0.1, random);
    halves.look(film);
    add_samples(film, 8, 0.1, random);
    halves.look(film);
    const double before = *halves.rel_mse();
    halves.look(film);
    EXPECT_DOUBLE_EQ(*halves.rel_mse(), before);
}

TEST(Replicates, NeedTwoWithSamples)
{
    Film film = film_of_replicates(4);
    EXPECT_FALSE(estimate_from_replicates(film, 4));
    Random random(3);
    add_samples(film, 3, 0.1, random, 4);  // the last replicate has none
    EXPECT_FALSE(estimate_from_replicates(film, 4));
    add_samples(film, 1, 0.1, random, 4);
    EXPECT_TRUE(estimate_from_replicates(film, 4));
}

// Of 200 intervals of 95 % more than 22 miss with probability 2e-4 (binomial). Nor must they be wide for nothing: half
// of one is 1.96 deviations.
TEST(Replicates, TheIntervalHoldsTheErrorThatThePictureHas)
{
    constexpr uint32_t runs = 200, replicates = 8;
    uint32_t missed = 0;
    double width = 0;
    for (uint32_t run = 0; run < runs; ++run) {
        Random random(100 + run);
        Film film = film_of_replicates(replicates);
        add_samples(film, 16, 0.2, random, replicates);
        const auto estimate = estimate_from_replicates(film, replicates);
        ASSERT_TRUE(estimate);
        missed += !estimate->interval.contains(true_error(film));
        width += (estimate->interval.high - estimate->interval.low) / estimate->rel_mse / runs;
    }
    EXPECT_LE(missed, 22u);
    // 2 * 1.96 * sqrt(2 (1 + 1/7) / 1600)
    EXPECT_NEAR(width, 0.148, 0.01);
}

}  // namespace
}  // namespace lancer
