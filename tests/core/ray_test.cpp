#include "core/ray.h"

#include <gtest/gtest.h>

#include "support/random.h"

namespace lancer {
namespace {

float ulp(float x) { return std::nextafter(std::abs(x), INFINITY) - std::abs(x); }

TEST(Ray, GammaBoundsTheRoundingOfNOperations)
{
    for (const int n : {1, 4, 7, 100}) {
        const long double nu = n * 0x1p-24L;
        EXPECT_NEAR(static_cast<double>(gamma(n)), static_cast<double>(nu / (1 - nu)), 2e-7 * n * 0x1p-24);
        EXPECT_GE(gamma(n), static_cast<float>(n) * 0x1p-24f);
    }
}

TEST(OffsetOrigin, LandsOnTheSideOfTheDirectionByAtLeastTheBound)
{
    Random random(11);
    for (int i = 0; i < 200000; ++i) {
        const double size = random.log_uniform(-6, 6);
        const Vec3 p = to_float(random.point(-1, 1) * size), n = random.unit_vector(), w = random.unit_vector();
        const Vec3 error = abs(p) * gamma(1 + static_cast<int>(random.below(20)));
        const Vec3 o = offset_origin(p, error, n, w);
        const Vec3d moved = to_double(o) - to_double(p), exact_n = to_double(n);
        const double side = dot(w, n) < 0 ? -1 : 1;
        const double bound = dot(abs(exact_n), to_double(error));
        // Rounding of the sum may take a little; the step to the next number gives it back.
        ASSERT_GE(side * dot(moved, exact_n), bound * (1 - 1e-6)) << i;
        for (int axis = 0; axis < 3; ++axis) {
            if (n[axis] == 0) continue;
            ASSERT_GE(std::abs(o[axis] - p[axis]), 0.5f * ulp(p[axis])) << i;  // below a power of two ulps are halves
            ASSERT_NE(o[axis], p[axis]);
            ASSERT_EQ(o[axis] > p[axis], side * n[axis] > 0);
        }
    }
}

// Everywhere within the bound of p, a surface along n through the true point lies behind the new origin.
TEST(OffsetOrigin, PassesEveryPlaceWhereTheSurfaceMayBe)
{
    Random random(12);
    for (int i = 0; i < 200000; ++i) {
        const Vec3 p = to_float(random.point(-3, 3)), n = random.unit_vector(), w = random.unit_vector();
        const Vec3 error = abs(p) * gamma(7);
        const Vec3d corner{random.sign() * error.x, random.sign() * error.y, random.sign() * error.z};
        const Vec3 o = offset_origin(p, error, n, w);
        const double side = dot(w, n) < 0 ? -1 : 1;
        ASSERT_GT(side * dot(to_double(o) - (to_double(p) + corner), to_double(n)), 0) << i;
    }
}

TEST(OffsetOrigin, WithoutANormalOrAnErrorThePointStays)
{
    EXPECT_EQ(offset_origin(Vec3{1, 2, 3}, Vec3{1, 1, 1}, Vec3{}, Vec3{0, 0, 1}), (Vec3{1, 2, 3}));
    EXPECT_EQ(offset_origin(Vec3{1, 0, 3}, Vec3{1e-7f, 0, 1e-7f}, Vec3{0, 1, 0}, Vec3{0, 1, 0}), (Vec3{1, 0, 3}));
}

TEST(IsTraceable, RejectsWhatEmbreeCannotTakeInEachField)
{
    const Ray good{{1, 2, 3}, 0, {0, 0, 1}, 5};
    ASSERT_TRUE(is_traceable(good));
    const auto with = [&](int field, float x) {
        Ray r = good;
        float* const fields[] = {&r.org.x, &r.org.y, &r.org.z, &r.t_min, &r.dir.x, &r.dir.y, &r.dir.z, &r.t_max};
        *fields[field] = x;
        return r;
    };
    for (int field = 0; field < 8; ++field) {
        EXPECT_FALSE(is_traceable(with(field, NAN))) << field;
        EXPECT_FALSE(is_traceable(with(field, -NAN))) << field;
        EXPECT_FALSE(is_traceable(with(field, -INFINITY))) << field;
        EXPECT_EQ(is_traceable(with(field, INFINITY)), field == 7) << field;
        if (field != 3 && field != 7) {
            EXPECT_FALSE(is_traceable(with(field, 1.85e18f))) << field;
            EXPECT_FALSE(is_traceable(with(field, -1.85e18f))) << field;
            EXPECT_FALSE(is_traceable(with(field, std::numeric_limits<float>::max()))) << field;
            EXPECT_TRUE(is_traceable(with(field, 1.7e18f))) << field;
            EXPECT_TRUE(is_traceable(with(field, -0.0f)) || field == 6) << field;
        }
    }
    EXPECT_TRUE(is_traceable(with(7, INFINITY)));
    EXPECT_FALSE(is_traceable(with(3, -1)));
    EXPECT_FALSE(is_traceable(with(3, 6)));   // t_min beyond t_max
    EXPECT_FALSE(is_traceable(with(7, -1)));  // t_max before t_min
    Ray endless = with(3, INFINITY);
    endless.t_max = INFINITY;
    EXPECT_FALSE(is_traceable(endless));
}

TEST(IsTraceable, RejectsADirectionOfZeros)
{
    for (const float z : {0.0f, -0.0f}) {
        EXPECT_FALSE(is_traceable({.org = {}, .dir = {0, 0, z}}));
        EXPECT_FALSE(is_traceable({.org = {}, .dir = {z, -0.0f, 0}}));
        EXPECT_TRUE(is_traceable({.org = {}, .dir = {z, 0, 1e-30f}}));
        EXPECT_TRUE(is_traceable({.org = {}, .dir = {-1e-30f, z, 0}}));
    }
}

}  // namespace
}  // namespace lancer
