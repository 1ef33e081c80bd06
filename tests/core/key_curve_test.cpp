// Curves and turns between key frames against closed forms.
#include "core/key_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/quaternion.h"

namespace lancer {
namespace {

TEST(KeyCurve, APlaceIsBetweenItsKeys)
{
    const std::vector<double> times{1, 3, 4};
    for (const auto& [time, at, u] : {std::tuple{0.0, size_t{0}, 0.0},
                                      {1.0, size_t{0}, 0.0},
                                      {1.5, size_t{0}, 0.25},
                                      {3.0, size_t{1}, 0.0},
                                      {3.75, size_t{1}, 0.75},
                                      {4.0, size_t{2}, 0.0},
                                      {9.0, size_t{2}, 0.0}}) {
        const KeyPlace place = place_among(times, time);
        EXPECT_EQ(place.at, at) << time;
        EXPECT_EQ(place.u, u) << time;
    }
}

TEST(KeyCurve, KeysAtConstantSpeedStayAtConstantSpeed)
{
    const std::vector<double> times{1, 3, 4, 10}, values{5, 1, -1, -13};  // 7 - 2 t
    for (double time = 1; time <= 10; time += 0.125) {
        const KeyPlace place = place_among(times, time);
        EXPECT_NEAR(smooth_at(times, values, place), 7 - 2 * time, 1e-14) << time;
        EXPECT_NEAR(linear_at(values, place), 7 - 2 * time, 1e-14) << time;
    }
}

// Catmull and Rom's matrix for keys at equal distances, and continuous slopes for others.
TEST(KeyCurve, TheSmoothCurveIsThatOfCatmullAndRom)
{
    const std::vector<double> times{0, 1, 2, 3}, p{2, -1, 4, 3};
    for (double u = 0; u < 1; u += 0.0625) {
        const double known = 0.5 * (2 * p[1] + (p[2] - p[0]) * u + (2 * p[0] - 5 * p[1] + 4 * p[2] - p[3]) * u * u +
                                    (3 * p[1] - p[0] - 3 * p[2] + p[3]) * u * u * u);
        EXPECT_NEAR(smooth_at(times, p, place_among(times, 1 + u)), known, 1e-14) << u;
    }
    const std::vector<double> uneven{0, 1, 5, 6};
    constexpr double h = 1e-6;
    for (const double key : {1.0, 5.0}) {
        const auto at = [&](double time) { return smooth_at(uneven, p, place_among(uneven, time)); };
        EXPECT_NEAR((at(key) - at(key - h)) / h, (at(key + h) - at(key)) / h, 1e-4) << key;
    }
}

Vec3d unit(std::mt19937_64& random)
{
    std::normal_distribution<double> normal;
    const double x = normal(random), y = normal(random), z = normal(random);
    return normalize(Vec3d{x, y, z});
}

struct Axes {
    Vec3d x, y, z;
};
Axes axes(std::mt19937_64& random)
{
    const Vec3d x = unit(random), z = normalize(cross(x, unit(random)));
    return {x, cross(z, x), z};
}

TEST(Quaternion, RotatesTheAxesToWhatItIsMadeOf)
{
    std::mt19937_64 random(1);
    std::vector<Axes> all{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                          {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
                          {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
                          {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}}};
    for (int i = 0; i < 200; ++i) all.push_back(axes(random));
    for (const Axes& a : all) {
        const Quaternion q = rotation_to(a.x, a.y, a.z);
        EXPECT_NEAR(dot(q, q), 1, 1e-14);
        EXPECT_LT(length(rotate(q, {1, 0, 0}) - a.x), 1e-14);
        EXPECT_LT(length(rotate(q, {0, 1, 0}) - a.y), 1e-14);
        EXPECT_LT(length(rotate(q, {0, 0, 1}) - a.z), 1e-14);
    }
}

// The angle from the start grows by the same amount in each step, and never beyond half a turn in all.
TEST(Quaternion, SlerpTurnsEvenlyTheShortWay)
{
    std::mt19937_64 random(2);
    for (int i = 0; i < 200; ++i) {
        const Axes a = axes(random), b = axes(random);
        const Quaternion from = rotation_to(a.x, a.y, a.z), to = rotation_to(b.x, b.y, b.z);
        const auto angle = [](const Quaternion& p, const Quaternion& q) {
            return 2 * std::acos(std::min(1.0, std::abs(dot(p, q))));
        };
        const double whole = angle(from, to);
        EXPECT_LE(whole, pi_d + 1e-12);
        for (int step = 1; step < 8; ++step) {
            const Quaternion q = slerp(from, to, step / 8.0);
            EXPECT_NEAR(dot(q, q), 1, 1e-13);
            EXPECT_NEAR(angle(from, q), whole * step / 8, 1e-7);
        }
    }
    // A quarter turn about z, halfway.
    const Quaternion quarter = rotation_to({0, 1, 0}, {-1, 0, 0}, {0, 0, 1});
    EXPECT_LT(length(rotate(slerp({}, quarter, 0.5), {1, 0, 0}) - Vec3d{std::sqrt(0.5), std::sqrt(0.5), 0}), 1e-15);
}

TEST(Quaternion, DirectionsTurnEvenly)
{
    std::mt19937_64 random(3);
    for (int i = 0; i < 200; ++i) {
        const Vec3d a = unit(random), b = unit(random);
        const double whole = std::atan2(length(cross(a, b)), dot(a, b));
        for (int step = 0; step <= 8; ++step) {
            const Vec3d d = slerp(a, b, step / 8.0);
            EXPECT_NEAR(length(d), 1, 1e-13);
            EXPECT_NEAR(std::atan2(length(cross(a, d)), dot(a, d)), whole * step / 8, 1e-12);
        }
    }
    EXPECT_EQ(slerp(Vec3d{0, 1, 0}, Vec3d{0, 1, 0}, 0.3), (Vec3d{0, 1, 0}));
    EXPECT_NEAR(dot(slerp(Vec3d{0, 1, 0}, Vec3d{0, -1, 0}, 0.5), Vec3d{0, 1, 0}), 0, 1e-15);
}

}  // namespace
}  // namespace lancer
