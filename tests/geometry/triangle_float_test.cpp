// The test of a triangle in float that hand-written trees share: where it hits, and that neighbours leave no gap.
#include "geometry/triangle_float.h"

#include <gtest/gtest.h>

#include "geometry/shapes.h"
#include "support/random.h"

namespace lancer {
namespace {

std::optional<float> distance(const Ray& r, const std::array<Vec3, 3>& v)
{
    return distance_to(ShearedRay(r), v[0], v[1], v[2]);
}

// Needles as well: their planes are ill-conditioned in float.
TEST(TriangleInFloat, SaysTheDistanceThatDoubleSays)
{
    Random random(1);
    int compared = 0, edges = 0;
    for (int i = 0; i < 200000; ++i) {
        const Vec3d a = random.point(-1, 1), along = random.direction();
        const double thin = std::pow(10, random.uniform(-5, 0)), far = std::pow(10, random.uniform(-3, 2));
        const std::array<Vec3, 3> v{to_float(a), to_float(a + along),
                                    to_float(a + along * 0.4 + random.direction() * thin)};
        const double s = random.uniform(), t = random.uniform();
        const Vec3d at = to_double(v[0]) * (1 - std::sqrt(s)) + to_double(v[1]) * (std::sqrt(s) * (1 - t)) +
                         to_double(v[2]) * (std::sqrt(s) * t);
        const Vec3d dir = random.direction();
        const Ray ray{.org = to_float(at - dir * far), .dir = to_float(dir)};
        const auto h = intersect_plane_of(to_double(v[0]), to_double(v[1]), to_double(v[2]), to_double(ray.org),
                                          to_double(ray.dir));
        const auto found = distance(ray, v);
        if (!h || !h->inside || !found) {
            ++edges;
            continue;
        }
        // Both are exact but for double's own rounding on needles seen from their edge.
        ASSERT_NEAR(*found, h->t, std::abs(h->t) * 0x1p-23 + 1e-9) << i;
        ++compared;
    }
    EXPECT_GT(compared, 180000);
    EXPECT_GT(edges, 100);
}

// Four triangles around a corner, all seen from the front: a ray at the corner, or at an edge between two, meets one of
// them, at any size.
TEST(TriangleInFloat, NeighboursLeaveNoGap)
{
    Random random(2);
    for (int i = 0; i < 100000; ++i) {
        const double size = std::pow(10, random.uniform(-15, 15));
        const Vec3d away = random.point(-100, 100) * (size * random.below(2));
        const Vec3 apex = to_float(away + random.point(-0.1, 0.1) * size);
        std::array<Vec3, 4> ring;
        for (size_t k = 0; k < 4; ++k) {
            const double angle = (static_cast<double>(k) + random.uniform(-0.3, 0.3)) * pi_d / 2;
            ring[k] = to_float(away + Vec3d{std::cos(angle), std::sin(angle), random.uniform(-0.1, 0.1)} * size);
        }
        const Vec3 org = to_float(away + (Vec3d{0, 0, 3} + random.point(-0.5, 0.5)) * size);
        const Vec3d at =
            to_double(apex) + (to_double(ring[i % 4u]) - to_double(apex)) * (i % 3 ? random.uniform(0, 0.5) : 0);
        const Ray ray{.org = org, .dir = to_float(normalize(at - to_double(org)))};
        int met = 0;
        for (size_t k = 0; k < 4; ++k) {
            const auto t = distance(ray, {apex, ring[k], ring[(k + 1) % 4]});
            met += t && *t > 0 && *t < std::numeric_limits<float>::infinity() ? 1 : 0;
        }
        ASSERT_GT(met, 0) << i << ", size " << size;
    }
}

// Points and lines have no inside.
TEST(TriangleInFloat, NothingOfATriangleWithoutArea)
{
    const Vec3 a{1, 2, 3}, b{-1, 2, 3};
    for (const Vec3 at : {a, b, Vec3{0, 2, 3}}) {
        const Ray ray{.org = {}, .dir = normalize(at)};
        EXPECT_FALSE(distance(ray, {a, a, a}));
        EXPECT_FALSE(distance(ray, {a, b, a}));
        EXPECT_FALSE(distance(ray, {b, b, a}));
    }
}

}  // namespace
}  // namespace lancer
