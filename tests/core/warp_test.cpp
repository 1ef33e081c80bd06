#include "core/warp.h"

#include "core/frame.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "support/random.h"
#include "support/statistics/chi_square.h"

namespace lancer {
namespace {

constexpr uint32_t grid = 20;
constexpr int samples = 1000000;
const double level = sidak(claim_level, 6);  // six warps are tested against their densities

uint32_t cell_of(double x) { return std::min(grid - 1, static_cast<uint32_t>(std::max(0.0, x) * grid)); }
// Angle / 2 pi, in [0, 1).
double turn_of(double x, double y)
{
    const double t = std::atan2(y, x) / (2 * pi_d);
    return t < 0 ? t + 1 : t;
}

// Counts of a warp on the grid of two coordinates in [0, 1), against the integral of `density` over each cell
// (midpoints, 16 x 16 a cell).
ChiSquare test_warp(uint64_t seed, const std::function<Vec2(Vec2)>& coordinates,
                    const std::function<double(double, double)>& density)
{
    std::vector<uint64_t> observed(grid * grid);
    std::vector<double> expected(grid * grid);
    Random random(seed);
    for (int i = 0; i < samples; ++i) {
        const Vec2 c = coordinates(random.unit2());
        ++observed[cell_of(static_cast<double>(c.y)) * grid + cell_of(static_cast<double>(c.x))];
    }
    constexpr uint32_t fine = 16;
    for (uint32_t y = 0; y < grid * fine; ++y)
        for (uint32_t x = 0; x < grid * fine; ++x)
            expected[y / fine * grid + x / fine] +=
                samples * density((x + 0.5) / (grid * fine), (y + 0.5) / (grid * fine)) / (grid * fine * grid * fine);
    // Pearson's test hardly sees a density that is too large everywhere.
    EXPECT_NEAR(std::accumulate(expected.begin(), expected.end(), 0.0) / samples, 1, 1e-6);
    return chi_square_test(observed, expected);
}
Vec2 as_vec2(double x, double y) { return {static_cast<float>(x), static_cast<float>(y)}; }

TEST(Warp, DiskIsUniform)
{
    const auto r = test_warp(
        20,
        [](Vec2 u) {
            const Vec2 d = square_to_disk(u);
            const double x = static_cast<double>(d.x), y = static_cast<double>(d.y);
            return as_vec2(x * x + y * y, turn_of(x, y));
        },
        [](double, double) { return 1.0; });
    EXPECT_GT(r.p, level);
}

TEST(Warp, CosineHemisphereMatchesItsDensity)
{
    const auto r = test_warp(
        21,
        [](Vec2 u) {
            const Vec3d d = to_double(square_to_cosine_hemisphere(u));
            return as_vec2(d.z, turn_of(d.x, d.y));
        },
        [](double z, double) { return 2 * pi_d * static_cast<double>(pdf_cosine_hemisphere(static_cast<float>(z))); });
    EXPECT_GT(r.p, level);
}

TEST(Warp, SphereMatchesItsDensity)
{
    const auto r = test_warp(
        22,
        [](Vec2 u) {
            const Vec3d d = to_double(square_to_sphere(u));
            return as_vec2(0.5 * (d.z + 1), turn_of(d.x, d.y));
        },
        [](double, double) { return 4 * pi_d * static_cast<double>(pdf_sphere); });
    EXPECT_GT(r.p, level);
}

TEST(Warp, ConeMatchesItsDensity)
{
    for (const double max : {1e-9, 0.3}) {
        const auto r = test_warp(
            23,
            [&](Vec2 u) {
                return as_vec2(square_to_cone(static_cast<double>(u.x), max) / max, static_cast<double>(u.y));
            },
            [&](double, double) { return 2 * pi_d * max * pdf_cone(max); });
        EXPECT_GT(r.p, level) << max;
    }
}

TEST(Warp, TriangleIsUniform)
{
    std::vector<uint64_t> observed(grid * grid);
    std::vector<double> expected(grid * grid);
    Random random(24);
    for (int i = 0; i < samples; ++i) {
        const Vec2 b = square_to_triangle(random.unit2());
        ASSERT_GE(b.x, 0);
        ASSERT_GE(b.y, 0);
        ASSERT_LE(b.x + b.y, 1);
        ++observed[cell_of(static_cast<double>(b.y)) * grid + cell_of(static_cast<double>(b.x))];
    }
    for (uint32_t y = 0; y < grid; ++y)
        for (uint32_t x = 0; x + y < grid; ++x)
            expected[y * grid + x] = samples * (x + y + 1 == grid ? 1.0 : 2.0) / (grid * grid);
    EXPECT_GT(chi_square_test(observed, expected).p, level);
}

TEST(Warp, ResultsStayInTheirDomainAtTheEndsOfTheSquare)
{
    constexpr float last = 1 - 0x1p-24f;
    for (const float x : {0.0f, 0x1p-24f, 0.25f, 0.5f, 0.75f, last})
        for (const float y : {0.0f, 0x1p-24f, 0.25f, 0.5f, 0.75f, last}) {
            const Vec2 d = square_to_disk({x, y});
            EXPECT_LE(d.x * d.x + d.y * d.y, 1 + 4e-7f);
            for (const Vec3 v : {square_to_cosine_hemisphere({x, y}), square_to_sphere({x, y})})
                EXPECT_NEAR(length(v), 1, 4e-7f);
            EXPECT_GE(square_to_cosine_hemisphere({x, y}).z, 0);
            const Vec2 b = square_to_triangle(Vec2{x, y});
            EXPECT_TRUE(b.x >= 0 && b.y >= 0 && b.x + b.y <= 1) << x << " " << y;
        }
}

TEST(SinCos, ErrorIsBelowItsBound)
{
    double worst = 0;
    const auto check = [&](float u) {
        const long double a = 2 * std::numbers::pi_v<long double> * static_cast<long double>(u);
        const SinCos sc = sin_cos_2pi(u);
        worst = std::max(worst, static_cast<double>(std::abs(static_cast<long double>(sc.sin) - std::sin(a))));
        worst = std::max(worst, static_cast<double>(std::abs(static_cast<long double>(sc.cos) - std::cos(a))));
    };
    for (int i = 0; i <= 1000000; ++i) check(static_cast<float>(i) / 1000000);
    for (int eighth = 0; eighth <= 8; ++eighth) {
        float below = static_cast<float>(eighth) / 8, above = below;
        for (int i = 0; i < 100; ++i) {
            if (below >= 0) check(below);
            if (above <= 1) check(above);
            below = std::nextafter(below, -1.0f), above = std::nextafter(above, 2.0f);
        }
    }
    for (float u = 1e-37f; u < 1; u *= 1.7f) check(u);
    RecordProperty("worst_error", std::to_string(worst));
    EXPECT_LT(worst, 0x1p-23);
}

TEST(SinCos, QuartersAreExact)
{
    const float s[] = {0, 1, 0, -1, 0}, c[] = {1, 0, -1, 0, 1};
    for (int i = 0; i <= 4; ++i) {
        EXPECT_EQ(sin_cos_2pi(static_cast<float>(i) / 4).sin, s[i]);
        EXPECT_EQ(sin_cos_2pi(static_cast<float>(i) / 4).cos, c[i]);
    }
}

// Against -expm1(log1p(-s) / 2), another way to write 1 - sqrt(1 - s) that does not cancel.
TEST(OneMinusCos, RelativeErrorIsAFewRoundingsDownToTheSmallest)
{
    Random random(25);
    double worst_float = 0, worst_double = 0;
    for (int i = 0; i < 100000; ++i) {
        const double s = std::pow(10.0, random.uniform(-30, 0));
        const auto exact = [](long double x) { return -std::expm1(0.5L * std::log1p(-x)); };
        const auto f = static_cast<float>(s);
        const long double ef = exact(static_cast<long double>(f)), ed = exact(static_cast<long double>(s));
        worst_float =
            std::max(worst_float, static_cast<double>(std::abs(static_cast<long double>(one_minus_cos(f)) / ef - 1)));
        worst_double =
            std::max(worst_double, static_cast<double>(std::abs(static_cast<long double>(one_minus_cos(s)) / ed - 1)));
    }
    EXPECT_LT(worst_float, 4 * 0x1p-24);
    EXPECT_LT(worst_double, 4 * 0x1p-53);
    EXPECT_EQ(one_minus_cos(1.0), 1);
    EXPECT_EQ(one_minus_cos(0.0), 0);
}

// Eight at once have the bits of each alone, at the ends and where quadrants meet too.
TEST(Lanes, WarpsAndFramesAreThoseOfEach)
{
    Random random(77);
    const std::array<float, 8> ends{0, 0.125f, 0.25f, 0.375f, 0.5f, 0.75f, 0x1.fffffep-1f, 0x1p-24f};
    for (int round = 0; round < 20000; ++round) {
        Float8 u, v;
        Vec3T<Float8> n;
        std::array<Vec3, 8> normals;
        for (size_t k = 0; k < 8; ++k) {
            const auto number = [&] { return static_cast<float>(random.below(1u << 24)) * 0x1p-24f; };
            u[k] = random.below(4) ? number() : ends[random.below(8)];
            v[k] = random.below(4) ? number() : ends[random.below(8)];
            normals[k] = random.below(8) ? to_float(random.direction()) : Vec3{0, 0, random.below(2) ? -1.0f : 1.0f};
            n.x[k] = normals[k].x, n.y[k] = normals[k].y, n.z[k] = normals[k].z;
        }
        const auto h = square_to_cosine_hemisphere(u, v), w = FrameT<Float8>(n).to_world(h);
        for (size_t k = 0; k < 8; ++k) {
            const Vec3 h1 = square_to_cosine_hemisphere(Vec2{u[k], v[k]}), w1 = Frame(normals[k]).to_world(h1);
            ASSERT_EQ(h1, (Vec3{h.x[k], h.y[k], h.z[k]})) << u[k] << " " << v[k];
            ASSERT_EQ(w1, (Vec3{w.x[k], w.y[k], w.z[k]}));
        }
    }
}

}  // namespace
}  // namespace lancer
