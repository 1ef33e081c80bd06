#include "report/page/plot_axis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random.h"

namespace lancer {
namespace {

using Ticks = std::vector<double>;

TEST(PlotAxis, LinearTicksAreRound)
{
    EXPECT_EQ(make_axis(Scale::linear, 0, 10).ticks, (Ticks{0, 2, 4, 6, 8, 10}));
    EXPECT_EQ(make_axis(Scale::linear, -0.13, 0.31).ticks, (Ticks{-0.2, -0.1, 0, 0.1, 0.2, 0.3, 0.4}));
    EXPECT_EQ(make_axis(Scale::linear, 101, 104).ticks, (Ticks{101, 101.5, 102, 102.5, 103, 103.5, 104}));
    EXPECT_EQ(make_axis(Scale::linear, 0, 3e7).ticks, (Ticks{0, 5e6, 1e7, 1.5e7, 2e7, 2.5e7, 3e7}));
}

TEST(PlotAxis, LogarithmicTicksAreRound)
{
    EXPECT_EQ(make_axis(Scale::logarithmic, 1e3, 1e7).ticks, (Ticks{1e3, 1e4, 1e5, 1e6, 1e7}));
    EXPECT_EQ(make_axis(Scale::logarithmic, 1.3, 17).ticks, (Ticks{1, 2, 5, 10, 20}));
    EXPECT_EQ(make_axis(Scale::logarithmic, 0.003, 0.04).ticks, (Ticks{0.002, 0.005, 0.01, 0.02, 0.05}));
    EXPECT_EQ(make_axis(Scale::logarithmic, 5, 5).ticks, (Ticks{5, 10}));
}

TEST(PlotAxis, OneValueHasAnAxisToo)
{
    for (const double x : {0.0, 7.0, -7.0, 1e-30, 1e250}) {
        const Axis axis = make_axis(Scale::linear, x, x);
        EXPECT_LT(axis.low, axis.high) << x;
        EXPECT_GE(place(axis, x), 0);
        EXPECT_LE(place(axis, x), 1);
    }
    const Axis close = make_axis(Scale::linear, 1, std::nextafter(1, 2));
    EXPECT_LT(close.ticks.size(), 12u);
}

// Whatever the range: it lies within the axis, ticks ascend, they are not many, and they are even.
TEST(PlotAxis, EveryRangeFits)
{
    Random random(7);
    for (int i = 0; i < 20000; ++i) {
        const Scale scale = i % 2 ? Scale::linear : Scale::logarithmic;
        const double reach = i % 3 ? 6 : 280;
        double a = std::pow(10, random.uniform(-reach, reach)), b = std::pow(10, random.uniform(-reach, reach));
        if (scale == Scale::linear) a *= random.sign(), b *= random.sign();
        if (i % 5 == 0) b = a * (1 + std::pow(10, random.uniform(-18, 0)));
        const auto [low, high] = std::minmax(a, b);
        const Axis axis = make_axis(scale, low, high);
        const double slack = 1e-6;
        ASSERT_GE(place(axis, low), -slack) << low << " " << high;
        ASSERT_LE(place(axis, high), 1 + slack) << low << " " << high;
        ASSERT_GE(axis.ticks.size(), 2u) << low << " " << high;
        ASSERT_LE(axis.ticks.size(), 14u) << low << " " << high;
        ASSERT_EQ(axis.ticks.front(), axis.low);
        ASSERT_EQ(axis.ticks.back(), axis.high);
        for (size_t k = 1; k < axis.ticks.size(); ++k) ASSERT_LT(axis.ticks[k - 1], axis.ticks[k]);
    }
}

TEST(PlotAxis, PlacesAreTheClosedForm)
{
    const Axis linear = make_axis(Scale::linear, 0, 10);
    EXPECT_DOUBLE_EQ(place(linear, 2.5), 0.25);
    const Axis logarithmic = make_axis(Scale::logarithmic, 1e3, 1e7);
    EXPECT_DOUBLE_EQ(place(logarithmic, 1e4), 0.25);
    EXPECT_NEAR(place(logarithmic, 2e6), (6 + std::log10(2) - 3) / 4, 1e-15);
}

TEST(PlotAxis, WhatCannotBeShownDoesNotFit)
{
    for (const double x : {double(NAN), double(INFINITY), -double(INFINITY), 1e300}) {
        EXPECT_FALSE(fits(Scale::linear, x)) << x;
        EXPECT_FALSE(fits(Scale::logarithmic, x)) << x;
    }
    EXPECT_TRUE(fits(Scale::linear, 0));
    EXPECT_FALSE(fits(Scale::logarithmic, 0));
    EXPECT_FALSE(fits(Scale::logarithmic, -1));
    EXPECT_FALSE(fits(Scale::logarithmic, 1e-320));
}

}  // namespace
}  // namespace lancer
