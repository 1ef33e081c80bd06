#include "core/transform.h"

#include <gtest/gtest.h>

#include <numbers>

#include "support/random.h"

namespace lancer {
namespace {

Transform random_transform(Random& random)
{
    const Vec3d translate = random.point(-10, 10), turn = random.point(-360, 360);
    Vec3d scale = random.point(0.2, 3);
    if (random.sign() < 0) scale.x = -scale.x;
    return make_transform(translate, turn, scale);
}
double distance(Vec3d a, Vec3d b) { return length(a - b); }

TEST(Transform, InverseUndoes)
{
    Random random(7);
    for (int i = 0; i < 10000; ++i) {
        const Transform m = random_transform(random), back = inverse(m);
        const Vec3d p = random.point(-5, 5);
        EXPECT_LT(distance(back.point(m.point(p)), p), 1e-12);
        EXPECT_LT(distance(m.point(back.point(p)), p), 1e-12);
        EXPECT_LT(distance(back.vector(m.vector(p)), p), 1e-12);
        EXPECT_NEAR(m.determinant() * back.determinant(), 1, 1e-12);
    }
}

TEST(Transform, ComposeAppliesTheSecondFirst)
{
    Random random(8);
    for (int i = 0; i < 10000; ++i) {
        const Transform a = random_transform(random), b = random_transform(random);
        const Vec3d p = random.point(-5, 5);
        EXPECT_LT(distance(compose(a, b).point(p), a.point(b.point(p))), 1e-11);
        EXPECT_LT(distance(compose(a, b).vector(p), a.vector(b.vector(p))), 1e-11);
    }
}

// One step after the other, written out.
TEST(Transform, ScalesThenTurnsAboutXYZThenMoves)
{
    Random random(9);
    const auto turned = [](Vec3d p, int axis, double deg) {
        const double a = deg * std::numbers::pi / 180, s = std::sin(a), c = std::cos(a);
        if (axis == 0) return Vec3d{p.x, c * p.y - s * p.z, s * p.y + c * p.z};
        if (axis == 1) return Vec3d{s * p.z + c * p.x, p.y, c * p.z - s * p.x};
        return Vec3d{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
    };
    for (int i = 0; i < 10000; ++i) {
        const Vec3d t = random.point(-5, 5), r = random.point(-400, 400), s = random.point(-2, 2),
                    p = random.point(-3, 3);
        Vec3d q{p.x * s.x, p.y * s.y, p.z * s.z};
        q = turned(turned(turned(q, 0, r.x), 1, r.y), 2, r.z) + t;
        EXPECT_LT(distance(make_transform(t, r, s).point(p), q), 1e-12);
    }
}

TEST(Transform, QuarterTurnsAreExact)
{
    const Vec3d p{0.1, 0.2, 0.3};
    for (const double more : {0.0, 360.0, -720.0}) {
        EXPECT_EQ(make_transform({}, {90 + more, 0, 0}, {1, 1, 1}).point(p), (Vec3d{0.1, -0.3, 0.2}));
        EXPECT_EQ(make_transform({}, {0, 90 + more, 0}, {1, 1, 1}).point(p), (Vec3d{0.3, 0.2, -0.1}));
        EXPECT_EQ(make_transform({}, {0, 0, 90 + more}, {1, 1, 1}).point(p), (Vec3d{-0.2, 0.1, 0.3}));
        EXPECT_EQ(make_transform({}, {0, 180 + more, 0}, {1, 1, 1}).point(p), (Vec3d{-0.1, 0.2, -0.3}));
        EXPECT_EQ(make_transform({}, {0, 0, 270 + more}, {1, 1, 1}).point(p), (Vec3d{0.2, -0.1, 0.3}));
        EXPECT_EQ(make_transform({}, {0, 0, -90 + more}, {1, 1, 1}).point(p), (Vec3d{0.2, -0.1, 0.3}));
        EXPECT_EQ(make_transform({}, {more, more, more}, {1, 1, 1}).point(p), p);
    }
    // Four quarters about any axis, one after the other, bring every bit back.
    const Transform q = make_transform({}, {90, 180, 270}, {1, 1, 1});
    EXPECT_EQ(compose(q, inverse(q)).point(p), p);
}

TEST(Transform, NormalsStayPerpendicularUnderAnyScale)
{
    Random random(10);
    for (int i = 0; i < 10000; ++i) {
        const Transform m = random_transform(random), back = inverse(m);
        const Vec3d n = random.direction(), tangent = cross(n, random.direction());
        const Vec3d moved = back.normal_by_inverse(n);
        EXPECT_NEAR(dot(moved, m.vector(tangent)) / length(moved), 0, 1e-12);
        EXPECT_GT(dot(moved, m.vector(n)), 0);  // and on the same side, mirrored or not
    }
}

}  // namespace
}  // namespace lancer
