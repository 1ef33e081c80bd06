// Estimates of a picture's error, where the truth is known because the samples are made up.
#include "report/metrics/error_estimate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/hash.h"
#include "core/parallel.h"
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

double even(size_t) { return truth; }
// As leaves are, of which none is as bright as its neighbour.
double uneven(size_t i) { return 0.4 + 0.2 * static_cast<double>(mix_bits(i) >> 11) * 0x1p-53; }

// Adds n samples of deviation sigma to each pixel; all channels alike.
void add_samples(Film& film, uint32_t n, double sigma, Random& random, uint32_t replicates = 1,
                 double (*what)(size_t) = even)
{
    for (size_t i = 0; i < film.pixels.size(); ++i)
        for (uint32_t k = 0; k < n; ++k) {
            const uint32_t number = film.pixels[i].n;
            const double x = what(i) + sigma * nearly_normal(random);
            film.pixels[i] += {{x, x, x}, x * x, 1};
            if (film.replicates.empty()) continue;
            ReplicateSum& r = film.replicates[i * replicates + number % replicates];
            for (double& sum : r.sum) sum += x;
            ++r.n;
        }
}

double true_error(const Film& film, double (*what)(size_t) = even)
{
    double sum = 0;
    for (size_t i = 0; i < film.pixels.size(); ++i) {
        const double r = what(i), d = double{film.pixels[i].mean().r} - r;
        sum += d * d / (r * r + 0.01);
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

TEST(HalfBuffers, SayTheSameOfAnyThreads)
{
    std::vector<double> said;
    for (const unsigned threads : {1u, 3u})
        with_threads(threads, [&] {
            Random random(2);
            Film film(side, side, {0, 0, side, side});
            HalfBuffers halves;
            for (int look = 0; look < 3; ++look) add_samples(film, 8, 0.1, random, 1, uneven), halves.look(film);
            said.push_back(*halves.rel_mse());
        });
    EXPECT_EQ(said[0], said[1]);
}

// Of independent samples: expected is the variance of the mean, and 1600 pixels tell it to sqrt(2 / 1600) = 3.5 %, by
// which the estimate is higher; four sigma are 14 %.
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
        EXPECT_NEAR(*halves.rel_mse() / expected, 1.035, 0.14) << n;
    }
}

// The error that there is, and the estimate, each scatter by a standard error about what is expected: the one is above
// the other, which is a standard error too high, if a normal number exceeds sqrt(1/2), in 24 of 100 runs. Of 200 more
// than 72 are with probability 1e-4; without the standard error there would be 100.
TEST(HalfBuffers, AreAnUpperBound)
{
    uint32_t below = 0;
    for (uint32_t run = 0; run < 200; ++run) {
        Random random(500 + run);
        Film film(side, side, {0, 0, side, side});
        HalfBuffers halves;
        for (int look = 0; look < 2; ++look) {
            add_samples(film, 8, 0.01, random);
            halves.look(film);
        }
        below += *halves.rel_mse() < true_error(film);
    }
    EXPECT_LE(below, 72u);
    EXPECT_GE(below, 20u);  // not high for nothing
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
    for (const auto what : {even, uneven}) {
        uint32_t missed = 0;
        double width = 0;
        for (uint32_t run = 0; run < runs; ++run) {
            Random random(100 + run);
            Film film = film_of_replicates(replicates);
            add_samples(film, 16, 0.3, random, replicates, what);
            const auto estimate = estimate_from_replicates(film, replicates);
            ASSERT_TRUE(estimate);
            missed += !estimate->interval.contains(true_error(film, what));
            width += (estimate->interval.high - estimate->interval.low) / estimate->rel_mse / runs;
        }
        EXPECT_LE(missed, 22u);
        // 2 * 1.96 * sqrt(2 (1 + 1/7) / 1600)
        EXPECT_NEAR(width, 0.148, 0.01);
    }
}

}  // namespace
}  // namespace lancer
