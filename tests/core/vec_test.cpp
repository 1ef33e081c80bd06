#include "core/vec.h"

#include <gtest/gtest.h>

#include "core/bounds.h"
#include "core/color.h"
#include "support/random.h"

namespace lancer {
namespace {

TEST(Vec, CompoundOperatorsAreTheBinaryOnes)
{
    const Vec3 a{1.5f, -2.25f, 7}, b{4, 0.5f, -8};
    Vec3 v = a;
    EXPECT_EQ(v += b, a + b);
    v = a;
    EXPECT_EQ(v -= b, a - b);
    v = a;
    EXPECT_EQ(v *= 3.0f, a * 3.0f);
    v = a;
    EXPECT_EQ(v /= 3.0f, a / 3.0f);
    EXPECT_EQ(a / 3.0f, (Vec3{1.5f / 3, -2.25f / 3, 7.0f / 3}));
    EXPECT_EQ(3.0f * a, a * 3.0f);
    EXPECT_EQ(-a, (Vec3{-1.5f, 2.25f, -7}));
    for (int i = 0; i < 3; ++i) EXPECT_EQ((a + b)[i], a[i] + b[i]);
}

// A number divided by itself is 1; multiplied by its reciprocal it need not be.
TEST(Vec, DivisionIsDivision)
{
    Random random(2);
    for (int i = 0; i < 10000; ++i) {
        const auto s = static_cast<float>(random.log_uniform(-20, 20));
        Vec3 v{s, s, s};
        EXPECT_EQ(v / s, (Vec3{1, 1, 1}));
        v /= s;
        EXPECT_EQ(v, (Vec3{1, 1, 1}));
        Color c{s, s, s};
        c /= s;
        EXPECT_EQ(c, (Color{1, 1, 1}));
    }
}

TEST(Vec, CrossIsPerpendicularRightHandedAndAsLongAsTheArea)
{
    EXPECT_EQ(cross(Vec3{1, 0, 0}, Vec3{0, 1, 0}), (Vec3{0, 0, 1}));
    EXPECT_EQ(cross(Vec3{0, 1, 0}, Vec3{0, 0, 1}), (Vec3{1, 0, 0}));
    EXPECT_EQ(cross(Vec3{0, 0, 1}, Vec3{1, 0, 0}), (Vec3{0, 1, 0}));
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
        const Vec3d a = random.point(-1, 1), b = random.point(-1, 1), c = cross(a, b);
        EXPECT_NEAR(dot(a, c), 0, 1e-15);
        EXPECT_NEAR(dot(b, c), 0, 1e-15);
        EXPECT_EQ(cross(b, a), -c);
        EXPECT_NEAR(dot(c, c) + dot(a, b) * dot(a, b), dot(a, a) * dot(b, b), 1e-14);  // Lagrange
    }
}

TEST(Vec, IsFiniteLooksAtEachComponent)
{
    const float bad[] = {NAN, INFINITY, -INFINITY};
    EXPECT_TRUE(is_finite(Vec3{1, 2, 3}));
    for (const float x : bad) {
        EXPECT_FALSE(is_finite(Vec3{x, 0, 0}));
        EXPECT_FALSE(is_finite(Vec3{0, x, 0}));
        EXPECT_FALSE(is_finite(Vec3{0, 0, x}));
        EXPECT_FALSE(is_finite(Color{x, 0, 0}));
        EXPECT_FALSE(is_finite(Color{0, x, 0}));
        EXPECT_FALSE(is_finite(Color{0, 0, x}));
    }
}

TEST(Color, ArithmeticIsByComponent)
{
    const Color a{1, 2, 4}, b{8, 0.5f, 0.25f};
    Color c = a;
    EXPECT_EQ(c *= b, a * b);
    EXPECT_EQ(a * b, (Color{8, 1, 1}));
    c = a;
    EXPECT_EQ(c += b, (Color{9, 2.5f, 4.25f}));
    EXPECT_EQ(a / 2.0f, (Color{0.5f, 1, 2}));
    EXPECT_FLOAT_EQ(luminance({1, 1, 1}), 1);
    EXPECT_EQ(max_component(b), 8);
    EXPECT_TRUE(is_black(Color{}));
    EXPECT_FALSE(is_black(Color{0, 0, 1e-30f}));
}

TEST(Bounds, GrowsFromEmptyAndIgnoresTheEmpty)
{
    Bounds b;
    EXPECT_TRUE(b.empty());
    EXPECT_EQ(b.extent(), 0);
    EXPECT_EQ(b.radius(), 0);
    b.grow(Bounds{});
    EXPECT_TRUE(b.empty());
    b.grow(Vec3d{1, -2, 3});
    EXPECT_FALSE(b.empty());
    EXPECT_EQ(b.extent(), 0);
    EXPECT_EQ(b.center(), (Vec3d{1, -2, 3}));
    b.grow(Vec3d{-1, 2, 3.5});
    EXPECT_EQ(b.lower, (Vec3d{-1, -2, 3}));
    EXPECT_EQ(b.upper, (Vec3d{1, 2, 3.5}));
    EXPECT_EQ(b.extent(), 4);
    EXPECT_DOUBLE_EQ(b.radius(), 0.5 * std::sqrt(4 + 16 + 0.25));
    Bounds other;
    other.grow(Vec3d{0, 9, 0});
    other.grow(b);
    EXPECT_EQ(other.upper, (Vec3d{1, 9, 3.5}));
    EXPECT_EQ(other.lower, (Vec3d{-1, -2, 0}));
}

}  // namespace
}  // namespace lancer
