#include "core/frame.h"

#include <gtest/gtest.h>

#include "support/random.h"

namespace lancer {
namespace {

// Largest deviation from an orthonormal right-handed basis.
double fault_of(const Frame& f)
{
    const Vec3d x = to_double(f.x), y = to_double(f.y), z = to_double(f.z);
    double worst = 0;
    for (const double e : {dot(x, x) - 1, dot(y, y) - 1, dot(z, z) - 1, dot(x, y), dot(y, z), dot(z, x)})
        worst = std::max(worst, std::abs(e));
    const Vec3d right_handed = cross(x, y) - z;
    return std::max(worst, max_component(abs(right_handed)));
}

constexpr double bound = 12 * 0x1p-24;  // a dozen roundings to float

TEST(Frame, IsOrthonormalForRandomDirections)
{
    Random random(4);
    double worst = 0;
    for (int i = 0; i < 100000; ++i) worst = std::max(worst, fault_of(Frame(random.unit_vector())));
    EXPECT_LT(worst, bound);
}

TEST(Frame, IsOrthonormalAlongTheAxes)
{
    for (const float s : {1.0f, -1.0f})
        for (int axis = 0; axis < 3; ++axis) {
            const Frame f({axis == 0 ? s : 0, axis == 1 ? s : 0, axis == 2 ? s : 0});
            EXPECT_EQ(fault_of(f), 0) << axis << " " << s;
        }
    EXPECT_EQ(fault_of(Frame({0, 0, -0.0f})) == 0, false);  // not a direction: the check can fail
}

// Where a construction that divides by 1 + z loses everything, and on both sides of the switch at z = 0.
TEST(Frame, IsOrthonormalNearMinusZAndAtTheEquator)
{
    Random random(5);
    double worst = 0;
    for (int i = 0; i < 100000; ++i) {
        const double r = std::pow(10.0, random.uniform(-20, -0.5)), phi = random.uniform(0, 6.3);
        for (const double z : {-std::sqrt(1 - r * r), std::sqrt(1 - r * r)})
            worst = std::max(worst, fault_of(Frame(to_float(Vec3d{r * std::cos(phi), r * std::sin(phi), z}))));
        for (const double z : {-r, r}) {
            const double s = std::sqrt(1 - z * z);
            worst = std::max(worst, fault_of(Frame(to_float(Vec3d{s * std::cos(phi), s * std::sin(phi), z}))));
        }
    }
    for (const float z : {0.0f, -0.0f}) worst = std::max(worst, fault_of(Frame({0.6f, -0.8f, z})));
    EXPECT_LT(worst, bound);
}

TEST(Frame, ThereAndBackIsTheSameVector)
{
    Random random(6);
    for (int i = 0; i < 10000; ++i) {
        const Frame f(random.unit_vector());
        const Vec3 v = random.unit_vector(), back = f.to_world(f.to_local(v));
        EXPECT_LT(length(back - v), 1e-6f);
        EXPECT_EQ(f.to_world({0, 0, 1}), f.z);
    }
}

}  // namespace
}  // namespace lancer
