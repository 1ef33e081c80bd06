// Powers and angles are those of the C library to a few float steps, and the same in every lane.
#include "core/elementary.h"

#include <gtest/gtest.h>

#include "support/random.h"

namespace lancer {
namespace {

// The relative error of f at x, for numbers of any sign.
void expect_near(float found, double wanted, double relative)
{
    EXPECT_NEAR(static_cast<double>(found), wanted, relative * std::abs(wanted));
}

TEST(Elementary, PowersAndLogarithmsAreThoseOfTheLibrary)
{
    Random random(1);
    for (int i = 0; i < 100000; ++i) {
        const float x = 252 * random.unit() - 125;
        expect_near(power_of_two(x), std::exp2(double{x}), 0x1p-21);
        const float y = std::exp2(x), near = 1 + 0.1f * (random.unit() - 0.5f);
        EXPECT_NEAR(double{binary_log(y)}, std::log2(double{y}), 0x1p-22 * std::abs(double{x}) + 0x1p-23);
        expect_near(binary_log(near), std::log2(double{near}), 0x1p-21);
        const float base = random.unit(), exponent = 20 * random.unit();
        const double wanted = std::pow(double{base}, double{exponent});
        if (base > 0 && wanted > 1e-30)
            expect_near(power(base, exponent), wanted, 0x1p-21 + 0x1p-22 * std::abs(std::log2(wanted)));
    }
    EXPECT_EQ(power_of_two(0.0f), 1);
    EXPECT_EQ(power_of_two(-3.0f), 0.125f);
    EXPECT_EQ(power_of_two(-1e30f), 0);
    EXPECT_EQ(binary_log(1.0f), 0);
    EXPECT_EQ(binary_log(0.25f), -2);
    EXPECT_EQ(power(1.0f, 1e30f), 1);
    EXPECT_EQ(power(0.5f, 1e30f), 0);
    EXPECT_EQ(power(0.0f, 0.01f), 0);
}

TEST(Elementary, AnglesAreThoseOfTheLibrary)
{
    Random random(2);
    for (int i = 0; i < 100000; ++i) {
        const float x = random.unit(), y = random.unit();
        EXPECT_NEAR(double{arc_cosine(x)}, std::acos(double{x}), 0x1p-22);
        EXPECT_NEAR(double{part_of_quarter(x, y)}, std::atan2(double{y}, double{x}) / std::acos(0.0), 0x1p-22);
    }
    EXPECT_EQ(arc_cosine(1.0f), 0);
    EXPECT_EQ(part_of_quarter(0.0f, 0.0f), 0);
    EXPECT_EQ(part_of_quarter(0.3f, 0.0f), 0);
    EXPECT_EQ(part_of_quarter(0.0f, 0.3f), 1);
}

TEST(Elementary, LanesHaveTheBitsOfOneNumber)
{
    Random random(3);
    for (int i = 0; i < 20000; ++i) {
        const Float4 x{random.unit(), random.unit(), 0, 1}, y{random.unit(), 30 * random.unit(), 2, 1e20f};
        const Float4 p = power(x, y), a = arc_cosine(x), q = part_of_quarter(x, y);
        for (size_t k = 0; k < 4; ++k) {
            EXPECT_EQ(p[k], power(float{x[k]}, float{y[k]}));
            EXPECT_EQ(a[k], arc_cosine(float{x[k]}));
            EXPECT_EQ(q[k], part_of_quarter(float{x[k]}, float{y[k]}));
        }
    }
}

}  // namespace
}  // namespace lancer
