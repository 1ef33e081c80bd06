#include "render/filter.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "support/random.h"
#include "support/statistics/chi_square.h"

namespace lancer {
namespace {

constexpr int samples = 1000000;
const double level = sidak(claim_level, 8);  // four filters, two axes

// Counts of offsets in 60 cells over [-1.5, 1.5] against the integral of the density, on each axis.
void expect_density(FilterKind kind, const std::function<double(double)>& density)
{
    constexpr size_t cells = 60, fine = 200;
    std::vector<double> expected(cells);
    double total = 0;
    for (size_t i = 0; i < cells * fine; ++i) {
        const double v = density(3 * (static_cast<double>(i) + 0.5) / (cells * fine) - 1.5);
        expected[i / fine] += v;
        total += v;
    }
    for (double& e : expected) e *= samples / total;
    const Filter filter(kind);
    Random random(70);
    std::vector<uint64_t> x(cells), y(cells);
    const auto cell = [](float v) { return static_cast<size_t>((static_cast<double>(v) + 1.5) / 3 * cells); };
    for (int i = 0; i < samples; ++i) {
        const Vec2 o = filter.sample(random.unit2());
        ASSERT_TRUE(std::abs(o.x) <= 1.5f && std::abs(o.y) <= 1.5f);
        ++x[std::min(cells - 1, cell(o.x))];
        ++y[std::min(cells - 1, cell(o.y))];
    }
    EXPECT_GT(chi_square_test(x, expected).p, level);
    EXPECT_GT(chi_square_test(y, expected).p, level);
}

TEST(Filter, BoxIsOnePixelWide)
{
    expect_density(FilterKind::box, [](double x) { return std::abs(x) < 0.5 ? 1 : 0; });
}

TEST(Filter, GaussianHasItsShape)
{
    expect_density(FilterKind::gaussian, [](double x) { return std::exp(-2 * x * x); });
}

TEST(Filter, BlackmanHarrisHasItsShape)
{
    expect_density(FilterKind::blackman_harris, [](double x) {
        const double t = std::numbers::pi * (x / 1.5 + 1);
        return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) - 0.01168 * std::cos(3 * t);
    });
}

TEST(Filter, NarrowGaussianHasItsShape)
{
    expect_density(FilterKind::narrow_gaussian, [](double x) { return std::exp(-x * x / 0.18); });
}

TEST(Filter, CentreIsTheMiddleOfThePixel)
{
    const Filter filter(FilterKind::centre);
    Random random(71);
    for (int i = 0; i < 1000; ++i) EXPECT_EQ(filter.sample(random.unit2()), (Vec2{0, 0}));
}

TEST(Filter, OfEightNumbersIsThatOfEach)
{
    Random random(72);
    for (const FilterKind kind : {FilterKind::box, FilterKind::gaussian, FilterKind::blackman_harris,
                                  FilterKind::narrow_gaussian, FilterKind::centre}) {
        const Filter filter(kind);
        for (int round = 0; round < 100; ++round) {
            Vec2x8 u;
            for (uint32_t i = 0; i < float_lanes; ++i) {
                const Vec2 one = random.unit2();
                u.x[i] = one.x, u.y[i] = one.y;
            }
            const Vec2x8 of = filter.sample(u);
            for (uint32_t i = 0; i < float_lanes; ++i)
                EXPECT_EQ((Vec2{of.x[i], of.y[i]}), filter.sample(Vec2{u.x[i], u.y[i]}));
        }
    }
}

TEST(Filter, IsMonotoneSymmetricAndWithinItsRadiusAtTheEnds)
{
    constexpr float last = 1 - 0x1p-24f;
    for (const FilterKind kind :
         {FilterKind::box, FilterKind::gaussian, FilterKind::blackman_harris, FilterKind::narrow_gaussian}) {
        const Filter f(kind);
        const float radius = kind == FilterKind::box ? 0.5f : 1.5f;
        EXPECT_FLOAT_EQ(f.sample(Vec2{0, 0.5f}).x, -radius);
        EXPECT_NEAR(f.sample(Vec2{0, 0.5f}).y, 0, 1e-6);
        EXPECT_LE(f.sample(Vec2{last, 0}).x, radius);
        float before = -2;
        for (int i = 0; i <= 10000; ++i) {
            const float u = std::min(last, static_cast<float>(i) / 10000), x = f.sample(Vec2{u, 0}).x;
            ASSERT_GE(x, before);
            before = x;
            ASSERT_NEAR(x, -f.sample(Vec2{1 - u, 0}).x, 2e-4) << u;
        }
    }
}

}  // namespace
}  // namespace lancer
