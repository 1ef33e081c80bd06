// Grids, rims and waves: their values at points, and their means over footprints against numeric integration.
#include "materials/textures/procedural.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "support/random.h"

namespace lancer {
namespace {

double fraction(double x) { return x - std::floor(x); }
double number(float x) { return static_cast<double>(x); }

// The mean of f over n x n places of a square.
double mean_over_square(Vec2 middle, double side, int n, const std::function<double(double, double)>& f)
{
    double sum = 0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            sum += f(number(middle.x) + side * ((i + 0.5) / n - 0.5), number(middle.y) + side * ((j + 0.5) / n - 0.5));
    return sum / (n * n);
}

TEST(Grid, IsABandAtTheLowerEdgesOfEveryCell)
{
    const Grid grid{.band = {1, 2, 3}, .ground = {0.5f, 0, 0}, .width = 0.25f};
    for (const float cell : {0.0f, 7.0f, -3.0f, 4096.0f}) {
        for (const float other : {0.3f, 0.5f, 0.99f}) {
            EXPECT_EQ(grid.eval({cell, cell + other}, 0), grid.band);
            EXPECT_EQ(grid.eval({cell + 0.2f, cell + other}, 0), grid.band);
            EXPECT_EQ(grid.eval({cell + other, cell + 0.2f}, 0), grid.band);
            EXPECT_EQ(grid.eval({cell + other, cell + 0.26f}, 0), grid.ground);
            EXPECT_EQ(grid.eval({cell + 0.26f, cell + other}, 0), grid.ground);
        }
    }
    EXPECT_EQ((Grid{.width = 0}.eval({0, 0}, 0)), Color{});
    EXPECT_EQ((Grid{.width = 1}.eval({0.999f, 0.5f}, 0).r), 1);
    EXPECT_EQ((Grid{.width = 0.25f, .scale = {4, 2}, .offset = {0.5f, 0.5f}}.eval({0.15f, 0.3f}, 0).r), 1);
    EXPECT_EQ((Grid{.width = 0.25f, .scale = {4, 2}, .offset = {0.5f, 0.5f}}.eval({0.04f, 0.04f}, 0).r), 0);
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
        EXPECT_EQ(grid.eval({bad, 0.5f}, 0), grid.ground);
}

TEST(Grid, IsAveragedOverTheSquareOfTheFootprint)
{
    Random random(1);
    for (int k = 0; k < 200; ++k) {
        const auto width = static_cast<float>(random.uniform()), side = static_cast<float>(random.log_uniform(-3, 0.6));
        const float size = std::abs(side);
        const auto u = static_cast<float>(random.uniform(-4, 4)), v = static_cast<float>(random.uniform(-4, 4));
        const Grid grid{.width = width, .scale = {1.5f, -0.75f}, .offset = {0.2f, 0}};
        const auto inside = [&](double x, double y) {
            return fraction(1.5 * x + number(0.2f)) < number(width) || fraction(-0.75 * y) < number(width) ? 1 : 0;
        };
        constexpr int n = 400;
        EXPECT_NEAR(number(grid.eval({u, v}, size).r), mean_over_square({u, v}, number(size), n, inside),
                    1e-6 + 2.0 * (2 + 2 * number(size)) / n)
            << width << ' ' << size;
    }
}

// A slanted footprint counts as the upright box of the same variances.
TEST(Grid, AlongARayTheFootprintIsLonger)
{
    const Grid grid{.width = 0.1f};
    const float mean = 1 - 0.9f * 0.9f;
    EXPECT_NEAR(grid.eval({0.5f, 0.5f}, {0.1f, {0, 3}}).r, 0.1f, 0.02f) << "across the lines of v alone";
    EXPECT_EQ(grid.eval({0.5f, 0.5f}, {0.3f, {0, 0.4f}}).r, grid.eval({0.5f, 0.5f}, {0.3f, {0, -0.4f}}).r);
    for (const float far : {1e3f, 1e10f, 1e30f, std::numeric_limits<float>::infinity()}) {
        EXPECT_NEAR(grid.eval({0.2f, 12345.6f}, {far, {}}).r, mean, 1e-3f) << far;
        EXPECT_NEAR(grid.eval({0.2f, 12345.6f}, {10, {far, far}}).r, mean, 0.02f) << far;
    }
    for (const float tiny : {1e-7f, 1e-20f, 1e-40f}) {
        EXPECT_EQ(grid.eval({1000.5f, 0.5f}, tiny).r, 0) << tiny;
        EXPECT_EQ(grid.eval({1000.5f, 0.05f}, tiny).r, 1) << tiny;
    }
}

TEST(Grid, OfOldFadesWithTheDistanceFromTheOrigin)
{
    const Grid grid{.width = 0.1f, .faded = true};
    Random random(2);
    for (int k = 0; k < 1000; ++k) {
        const auto u = static_cast<float>(random.log_uniform(-1, 3)), v = static_cast<float>(random.log_uniform(-1, 3));
        const double x = number(u), y = number(v);
        const double near = std::max(20 - std::pow(x * x + y * y, 0.3), 0.0) / 20;
        const bool band = fraction(x) < number(0.1f) || fraction(y) < number(0.1f);
        EXPECT_NEAR(number(grid.eval({u, v}, 5).r), near * band + (1 - near) * 0.1, 1e-6);
    }
}

// The pattern of a triangle a, b, c at a + x (b - a) + y (c - a).
float rim(const Rim& r, double x, double y, float footprint)
{
    return r.eval({static_cast<float>(x), static_cast<float>(1 - y)}, footprint).r;
}

TEST(Rim, RunsAlongTheThreeSides)
{
    const Rim r{.width = 0.125f};
    Random random(3);
    for (int k = 0; k < 10000; ++k) {
        const double x = number(random.unit()), y = number(random.unit());
        if (x + y > 1) continue;
        EXPECT_EQ(rim(r, x, y, 0), x < 0.125 || y < 0.125 || 1 - x - y < 0.125 ? 1 : 0) << x << ' ' << y;
    }
}

TEST(Rim, IsAveragedOverWhatOfTheFootprintLiesInTheTriangle)
{
    Random random(4);
    for (int k = 0; k < 200; ++k) {
        const double x = random.uniform(), y = random.uniform(0, 1 - x), w = random.uniform(0, 0.36);
        const auto size = static_cast<float>(std::abs(random.log_uniform(-2, 0.7)));
        const auto width = static_cast<float>(w);
        double whole = 0, band = 0;
        mean_over_square({static_cast<float>(x), static_cast<float>(y)}, number(size), 300, [&](double a, double b) {
            if (a < 0 || b < 0 || a + b > 1) return 0.0;
            whole += 1;
            band += a < w || b < w || 1 - a - b < w ? 1 : 0;
            return 0.0;
        });
        EXPECT_NEAR(number(rim({.width = width}, x, y, size)), band / whole, 300 * 8 / whole) << x << ' ' << y;
        EXPECT_EQ(rim({.width = width, .faded = true}, x, y, size), rim({.width = width}, x, y, 0));
    }
    EXPECT_NEAR(rim({.width = 0.1f}, 0.3, 0.3, 1000), 1 - 0.7f * 0.7f, 1e-6f);
    EXPECT_EQ(rim({.width = 0.4f}, 0.33, 0.33, 0.5f), 1);
}

const std::vector<Wave> some_waves{{0.2, 0.15, 1.6, 0.3}, {0.18, 2.0, 2.1, 0.5}, {1, -0.44, 15.2, 0.1}};

double height(double u, double v)
{
    double h = 0;
    for (const Wave& w : some_waves)
        h += w.amplitude *
             std::cos(2 * pi_d * (u * std::cos(w.direction_rad) + v * std::sin(w.direction_rad)) / w.wavelength +
                      w.phase_rad);
    return h;
}
struct Slope {
    double u, v;
};
Slope difference(double u, double v)
{
    constexpr double h = 1e-5;
    return {(height(u + h, v) - height(u - h, v)) / (2 * h), (height(u, v + h) - height(u, v - h)) / (2 * h)};
}

TEST(Waves, SlopeIsTheDerivativeOfTheHeight)
{
    const Waves waves(some_waves, {1, 1}, {0, 0}), moved(some_waves, {2, -0.5f}, {0.25f, 3});
    Random random(5);
    for (int k = 0; k < 1000; ++k) {
        const auto u = static_cast<float>(random.uniform(-50, 50)), v = static_cast<float>(random.uniform(-50, 50));
        EXPECT_NEAR(number(waves.eval({u, v}, 0).r), height(number(u), number(v)), 1e-6);
        const Slope exact = difference(number(u), number(v));
        const Vec2 s = waves.slope({u, v}, 0);
        EXPECT_NEAR(number(s.x), exact.u, 1e-6);
        EXPECT_NEAR(number(s.y), exact.v, 1e-6);
        const Slope there = difference(2 * number(u) + 0.25, -0.5 * number(v) + 3);
        const Vec2 t = moved.slope({u, v}, 0);
        EXPECT_NEAR(number(t.x), 2 * there.u, 1e-6);
        EXPECT_NEAR(number(t.y), -0.5 * there.v, 1e-6);
    }
}

TEST(Waves, AreAveragedOverAGaussianWithTheVarianceOfTheFootprint)
{
    const Waves waves(some_waves, {1, 1}, {0, 0});
    Random random(6);
    for (int k = 0; k < 15; ++k) {
        const double u = random.uniform(-9, 9), v = random.uniform(-9, 9), side = random.uniform(0.1, 2);
        const Vec2 along{static_cast<float>(random.uniform(-2, 2)), static_cast<float>(random.uniform(-2, 2))};
        // Three independent numbers: one for each axis of the square, one for what is more of it.
        constexpr int n = 24;
        constexpr double reach = 5;  // sigmas
        double sum_u = 0, sum_v = 0, weight = 0;
        const double sigma = std::sqrt(1 / 12.0);
        const auto at = [&](int i) { return reach * ((i + 0.5) / n * 2 - 1); };
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                for (int l = 0; l < n; ++l) {
                    const double a = at(i), b = at(j), c = at(l), w = std::exp(-0.5 * (a * a + b * b + c * c));
                    const Slope s = difference(u + sigma * (side * a + number(along.x) * c),
                                               v + sigma * (side * b + number(along.y) * c));
                    sum_u += w * s.u, sum_v += w * s.v, weight += w;
                }
        const Vec2 s = waves.slope({static_cast<float>(u), static_cast<float>(v)}, {static_cast<float>(side), along});
        EXPECT_NEAR(number(s.x), sum_u / weight, 1e-5);
        EXPECT_NEAR(number(s.y), sum_v / weight, 1e-5);
    }
}

TEST(Waves, AreGoneWhereTheFootprintIsFarLonger)
{
    const Waves waves(some_waves, {1, 1}, {0, 0});
    for (const float far : {1e3f, 1e20f, std::numeric_limits<float>::infinity()}) {
        EXPECT_EQ(waves.slope({3, 4}, far), Vec2{}) << far;
        EXPECT_EQ(waves.slope({3, 4}, {0.1f, {far, far}}), Vec2{}) << far;
    }
}

TEST(Waves, OfOldAreFlatterAndFadeWithTheDistanceFromTheOrigin)
{
    const Waves waves(some_waves, {1, 1}, {0, 0}, true);
    Random random(7);
    for (int k = 0; k < 1000; ++k) {
        const double size = std::pow(10, random.uniform(0, 4));
        const auto u = static_cast<float>(random.uniform(-size, size)),
                   v = static_cast<float>(random.uniform(-size, size));
        const double x = number(u), y = number(v), near = std::max(100 - std::pow(x * x + y * y, 0.3), 0.0) / 100;
        const Slope exact = difference(x, y);
        const Vec2 s = waves.slope({u, v}, 3);
        EXPECT_NEAR(number(s.x), exact.u * near / (2 * pi_d), 1e-6);
        EXPECT_NEAR(number(s.y), exact.v * near / (2 * pi_d), 1e-6);
    }
    EXPECT_EQ(waves.slope({1.5e3f, 1.5e3f}, 0) == Vec2{}, false);
    EXPECT_EQ(waves.slope({1.6e3f, 1.6e3f}, 0), Vec2{}) << "beyond 10^(10/3) of the origin";
}

}  // namespace
}  // namespace lancer
