// Unit vectors in 32 bits: near what they stand for, in all directions.
#include "core/octahedral.h"

#include <gtest/gtest.h>

#include <random>

namespace lancer {
namespace {

constexpr double bound = 0.003 * pi_d / 180;

double angle_off(const Vec3& v)
{
    const uint32_t code = to_octahedral(v);
    EXPECT_NE(code, no_octahedral);
    const Vec3d back = to_double(from_octahedral(code)), unit = normalize(to_double(v));
    EXPECT_NEAR(length(back), 1, 1e-6);
    return std::atan2(length(cross(back, unit)), dot(back, unit));
}

TEST(Octahedral, AngleIsOffByLittle)
{
    std::mt19937 random(5);
    std::normal_distribution<double> number;
    double largest = 0;
    for (int i = 0; i < 200'000; ++i) {
        Vec3d v{number(random), number(random), number(random)};
        if (i % 5 == 1) v.z *= 1e-4;  // along the edges of the unfolded faces
        if (i % 5 == 2) v.x *= 1e-4;
        if (i % 5 == 3) v.x *= 1e-3, v.y *= 1e-3;  // near the poles
        largest = std::max(largest, angle_off(to_float(normalize(v))));
    }
    EXPECT_LT(largest, bound);
    EXPECT_GT(largest, 0.5 * bound) << "the bound says little";
}

TEST(Octahedral, AxesAndDiagonalsKeepTheirSigns)
{
    for (int i = 0; i < 27; ++i) {
        const Vec3d v{i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0};
        if (v == Vec3d{}) continue;
        const Vec3 unit = to_float(normalize(v)), back = from_octahedral(to_octahedral(unit));
        EXPECT_LT(angle_off(unit), bound) << i;
        for (const auto of : {&Vec3::x, &Vec3::y, &Vec3::z}) {
            if (unit.*of != 0) {
                EXPECT_EQ(std::signbit(unit.*of), std::signbit(back.*of)) << i;
            }
        }
        if (dot(v, v) == 1) {
            EXPECT_EQ(back, unit) << "axes are exact";
        }
    }
    for (const float zero : {0.0f, -0.0f})
        EXPECT_EQ(from_octahedral(to_octahedral({zero, zero, -1})), (Vec3{0, 0, -1}));
}

}  // namespace
}  // namespace lancer
