// Spheres and planes against the same formulas in long double.
#include "geometry/shapes.h"

#include <gtest/gtest.h>

#include "support/random.h"

namespace lancer {
namespace {

using Real = long double;

struct Roots {
    Real discriminant;  // over r^2: 1 through the centre, 0 tangent, negative outside
    Real t0, t1;
};
Roots exact_roots(const Sphere& s, const Ray& ray)
{
    const Real ox = Real{ray.org.x} - s.center.x, oy = Real{ray.org.y} - s.center.y, oz = Real{ray.org.z} - s.center.z;
    const Real dx = ray.dir.x, dy = ray.dir.y, dz = ray.dir.z, r = s.radius;
    const Real a = dx * dx + dy * dy + dz * dz, b = -(ox * dx + oy * dy + oz * dz);
    const Real nx = ox + dx * b / a, ny = oy + dy * b / a, nz = oz + dz * b / a;
    const Real d = r * r - (nx * nx + ny * ny + nz * nz);
    const Real root = std::sqrt(std::max(Real{0}, a * d));
    const Real q = b + (b < 0 ? -root : root), distance = std::sqrt(ox * ox + oy * oy + oz * oz);
    const Real t0 = (distance - r) * (distance + r) / q, t1 = q / a;
    return {d / (r * r), std::min(t0, t1), std::max(t0, t1)};
}
double ulp(double x) { return std::ldexp(1.0, std::max(-126, std::ilogb(x)) - 23); }

// t as stored in float, against the truth: two roundings of t and of the origin.
void expect_close(const Sphere& s, const Ray& ray, int i)
{
    const Roots exact = exact_roots(s, ray);
    const auto t = intersect(s, ray);
    if (std::abs(exact.discriminant) < 1e-6L) return;  // silhouette: either answer
    const bool hits = exact.discriminant > 0 && exact.t1 > 0;
    ASSERT_EQ(t.has_value(), hits) << i;
    if (!t) return;
    const double truth = static_cast<double>(exact.t0 > 0 ? exact.t0 : exact.t1);
    const double size = max_component(abs(to_double(ray.org)));
    ASSERT_NEAR(static_cast<double>(static_cast<float>(*t)), truth,
                2 * ulp(truth) + 2 * ulp(size) * 0x1p-24 + 1e-12 * truth)
        << i << " r " << s.radius;
}

TEST(Mesh, WithoutPositionsHasNoVertices)
{
    for (const uint32_t rows : {1u, 2u}) {
        Mesh mesh;
        mesh.rows = rows;
        EXPECT_EQ(mesh.vertices(), 0u);
        mesh.positions.resize(1);  // the padding
        EXPECT_EQ(mesh.vertices(), 0u);
    }
}

TEST(Sphere, MatchesLongDoubleFromOutsideAtEveryRatioOfRadiusToDistance)
{
    Random random(1);
    for (int i = 0; i < 100000; ++i) {
        const double distance = std::pow(10.0, random.uniform(-3, 3)), ratio = std::pow(10.0, random.uniform(-6, 6));
        const Sphere s{random.point(-1, 1) * distance, distance * ratio};
        // At `distance` from the surface, aimed at some point of the sphere.
        const Vec3d n = random.direction();
        const Vec3 org = to_float(s.center + n * (s.radius + distance));
        const Vec3d at = s.center + normalize(n * 1.5 + random.direction()) * s.radius;
        expect_close(s, {.org = org, .dir = normalize(to_float(at - to_double(org)))}, i);
    }
}

TEST(Sphere, MatchesLongDoubleFromInside)
{
    Random random(2);
    for (int i = 0; i < 100000; ++i) {
        const Sphere s{random.point(-1, 1), std::pow(10.0, random.uniform(-3, 5))};
        const Vec3 org = to_float(s.center + random.direction() * (s.radius * std::sqrt(random.uniform()) * 0.999));
        expect_close(s, {.org = org, .dir = random.unit_vector()}, i);
    }
}

TEST(Sphere, MissesAndHitsBeyondTheSilhouetteAreRight)
{
    Random random(3);
    for (int i = 0; i < 100000; ++i) {
        const Sphere s{random.point(-1, 1) * 100.0, std::pow(10.0, random.uniform(-3, 2))};
        const Vec3d axis = random.direction(), side = normalize(cross(axis, random.direction()));
        const double off = 1 + random.sign() * std::pow(10.0, random.uniform(-5, -1));
        const Vec3 org = to_float(s.center - axis * (5 * s.radius) + side * (off * s.radius));
        expect_close(s, {.org = org, .dir = to_float(axis)}, i);
    }
}

TEST(Sphere, TangentAndCentralRays)
{
    const Sphere s{{0, 0, 5}, 1};
    EXPECT_EQ(intersect(s, {.org = {0, 0, 0}, .dir = {0, 0, 1}}), 4.0);
    EXPECT_EQ(intersect(s, {.org = {0, 0, 5}, .dir = {0, 1, 0}}), 1.0);  // from the centre
    EXPECT_EQ(intersect(s, {.org = {0, 0, 0}, .t_min = 4.5f, .dir = {0, 0, 1}}), 6.0);
    EXPECT_EQ(intersect(s, {.org = {0, 0, 0}, .dir = {0, 0, -1}}), std::nullopt);
    EXPECT_EQ(intersect(s, {.org = {0, 0, 0}, .dir = {0, 0, 2}}), 2.0);  // t counts in directions
    const auto tangent = intersect(s, {.org = {1, 0, 0}, .dir = {0, 0, 1}});
    ASSERT_TRUE(tangent);
    EXPECT_DOUBLE_EQ(*tangent, 5);
    EXPECT_FALSE(intersect(s, {.org = {std::nextafter(1.0f, 2.0f), 0, 0}, .dir = {0, 0, 1}}));
}

TEST(Sphere, BoundsHoldIt)
{
    const Bounds b = bounds(Sphere{{1, 2, 3}, 0.5});
    EXPECT_EQ(b.lower, (Vec3d{0.5, 1.5, 2.5}));
    EXPECT_EQ(b.upper, (Vec3d{1.5, 2.5, 3.5}));
}

TEST(Plane, ARayWithinItMissesAndSignedZerosAreHarmless)
{
    const Plane floor{{0, 1, 0}, 0};
    for (const float y : {0.0f, -0.0f})
        for (const float height : {0.0f, 1.0f, -1.0f}) {
            EXPECT_FALSE(intersect(floor, {.org = {1, height, 2}, .dir = {1, y, 0}})) << height;
            EXPECT_FALSE(intersect(floor, {.org = {1, height, 2}, .dir = {0, y, -1}})) << height;
        }
    EXPECT_FALSE(intersect(floor, {.org = {0, 0, 0}, .dir = {0, 1, 0}}));  // where the ray starts
}

TEST(Plane, IsExactToTheHorizon)
{
    Random random(4);
    const Plane floor{{0, 1, 0}, 0};
    for (int i = 0; i < 100000; ++i) {
        const double t = std::pow(10.0, random.uniform(0.1, 7)), phi = random.uniform(0, 6.3);
        const Vec3d d = normalize(Vec3d{std::cos(phi), -1 / t, std::sin(phi)});
        const Ray ray{.org = {0, 1, 0}, .dir = to_float(d)};
        const auto hit = intersect(floor, ray);
        ASSERT_TRUE(hit);
        ASSERT_NEAR(1 + *hit * static_cast<double>(ray.dir.y), 0, 2 * 0x1p-52) << t;
    }
}

TEST(Plane, TiltedOnesMatchLongDouble)
{
    Random random(5);
    int hits = 0;
    for (int i = 0; i < 100000; ++i) {
        const Plane p{random.direction(), random.uniform(-3, 3)};
        const Ray ray{.org = to_float(random.point(-5, 5)), .dir = random.unit_vector()};
        const Real n_o = Real{p.normal.x} * ray.org.x + Real{p.normal.y} * ray.org.y + Real{p.normal.z} * ray.org.z;
        const Real n_d = Real{p.normal.x} * ray.dir.x + Real{p.normal.y} * ray.dir.y + Real{p.normal.z} * ray.dir.z;
        const auto truth = static_cast<double>((p.offset - n_o) / n_d);
        const auto t = intersect(p, ray);
        ASSERT_EQ(t.has_value(), truth > 0);
        if (!t) continue;
        ++hits;
        ASSERT_NEAR(*t * std::abs(static_cast<double>(n_d)), truth * std::abs(static_cast<double>(n_d)),
                    1e-14 * (1 + std::abs(truth)));
    }
    EXPECT_GT(hits, 40000);
}

TEST(Plane, BoundsAreASlabOnlyAlongAnAxis)
{
    const Bounds floor = bounds(Plane{{0, 1, 0}, 2}), wall = bounds(Plane{{-1, 0, 0}, 2}),
                 tilted = bounds(Plane{{0.6, 0.8, 0}, 2});
    EXPECT_EQ(floor.lower.y, 2);
    EXPECT_EQ(floor.upper.y, 2);
    EXPECT_EQ(floor.upper.x, plane_extent);
    EXPECT_EQ(wall.lower.x, -2);
    EXPECT_EQ(wall.upper.x, -2);
    EXPECT_EQ(tilted.upper.y, plane_extent);
}

}  // namespace
}  // namespace lancer
