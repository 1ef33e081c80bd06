#include "core/film.h"

#include <gtest/gtest.h>

#include "support/random.h"

namespace lancer {
namespace {

Pixel sample(Color c)
{
    const double y = static_cast<double>(luminance(c));
    return {{static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b)}, y * y, 1};
}

TEST(Film, AMillionSamplesOfATenthStayATenth)
{
    Pixel whole;
    for (int block = 0; block < 1000000 / 16; ++block) {
        Pixel part;
        for (uint32_t i = 0; i < samples_per_block; ++i) part += sample({0.1f, 0.1f, 0.1f});
        whole += part;
    }
    EXPECT_EQ(whole.n, 1000000u);
    EXPECT_EQ(whole.mean(), (Color{0.1f, 0.1f, 0.1f}));
    EXPECT_NEAR(whole.sum[0], 1e6 * static_cast<double>(0.1f), 1e-8);
}

// Grouping decides the last bits, so it must be the same however the samples are split into passes.
TEST(Film, SumsInBlocksDoNotDependOnWhereAPassEnds)
{
    Random random(60);
    std::vector<Color> samples(160);
    for (Color& c : samples)
        c = {static_cast<float>(random.log_uniform(-9, 9)), static_cast<float>(random.log_uniform(-9, 9)),
             random.unit()};
    const auto sum = [&](std::initializer_list<size_t> passes) {
        Pixel film;
        size_t begin = 0;
        for (const size_t end : passes)
            for (; begin < end;) {
                Pixel block;
                for (const size_t stop = begin + samples_per_block; begin < stop; ++begin)
                    block += sample(samples[begin]);
                film += block;
            }
        return film;
    };
    const Pixel once = sum({160}), twice = sum({48, 160}), often = sum({16, 32, 128, 160});
    EXPECT_EQ(once.sum, twice.sum);
    EXPECT_EQ(once.sum, often.sum);
    EXPECT_EQ(once.sum_sq, often.sum_sq);
    Pixel flat;
    for (const Color& c : samples) flat += sample(c);
    EXPECT_NE(once.sum, flat.sum);  // the order matters, or there were nothing to keep
}

TEST(Film, KeepsTheCropOfALargerPicture)
{
    Film f(100, 80, {10, 20, 14, 23});
    ASSERT_EQ(f.pixels.size(), 12u);
    f.at(10, 20).n = 1;
    f.at(13, 22).n = 2;
    f.at(11, 21).n = 3;
    EXPECT_EQ(f.pixels[0].n, 1u);
    EXPECT_EQ(f.pixels[11].n, 2u);
    EXPECT_EQ(f.pixels[5].n, 3u);
    EXPECT_EQ(Pixel{}.mean(), Color{});
}

TEST(Film, EstimatesItsErrorFromItsSamples)
{
    // Luminance 0 or 2 with equal chance: mean 1, variance 1.
    Film f(1, 1, {0, 0, 1, 1});
    for (int i = 0; i < 100; ++i) f.pixels[0] += sample(i % 2 ? Color{2, 2, 2} : Color{});
    EXPECT_NEAR(estimate_rel_mse(f), 100.0 / 99 / 100 / 1.01, 1e-6);
    EXPECT_EQ(estimate_rel_mse(Film(2, 2, {0, 0, 2, 2})), 0);  // nothing known
    Film constant(1, 1, {0, 0, 1, 1});
    for (int i = 0; i < 10; ++i) constant.pixels[0] += sample({0.3f, 0.3f, 0.3f});
    EXPECT_NEAR(estimate_rel_mse(constant), 0, 1e-12);
}

}  // namespace
}  // namespace lancer
