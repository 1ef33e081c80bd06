#include <gtest/gtest.h>

#include "geometry/accelerators.h"

namespace lancer {
namespace {

TEST(Triangle, MatchesTheClosedFormInLongDouble)
{
    Random random(1);
    int inside = 0;
    for (int i = 0; i < 200000; ++i) {
        const Vec3d v[3] = {to_double(to_float(random.point(-1, 1))), to_double(to_float(random.point(-1, 1))),
                            to_double(to_float(random.point(-1, 1)))};
        const Vec3d org = to_double(to_float(random.point(-3, 3))), dir = to_double(random.unit_vector());
        const auto h = intersect_plane_of(v[0], v[1], v[2], org, dir);
        ASSERT_TRUE(h);
        // Cramer's rule.
        using Real = long double;
        const auto det = [](Vec3d a, Vec3d b, Vec3d c) {
            return Real{a.x} * (Real{b.y} * c.z - Real{b.z} * c.y) + Real{a.y} * (Real{b.z} * c.x - Real{b.x} * c.z) +
                   Real{a.z} * (Real{b.x} * c.y - Real{b.y} * c.x);
        };
        const Vec3d e1 = v[1] - v[0], e2 = v[2] - v[0], s = org - v[0];
        const Real d = det(e1, e2, -dir);
        if (std::abs(d) < 1e-3L) continue;  // seen almost from the edge
        const auto t = static_cast<double>(det(e1, e2, s) / d);
        const auto a = static_cast<double>(det(s, e2, -dir) / d), b = static_cast<double>(det(e1, s, -dir) / d);
        const double bound = 1e-12 * (1 + std::abs(t)) / std::abs(static_cast<double>(d));
        ASSERT_NEAR(h->t, t, bound);
        ASSERT_NEAR(h->u, a, bound);
        ASSERT_NEAR(h->v, b, bound);
        const double least = std::min({a, b, 1 - a - b});
        ASSERT_TRUE(std::abs(least) < bound || h->inside == (least > 0));
        inside += h->inside;
    }
    EXPECT_GT(inside, 1000);
}

// Each of a million incoherent rays, alone and in packets of eight: packets may decide otherwise only on an edge.
TEST(Packets, FindWhatSingleRaysFind)
{
    Geometry g;
    g.meshes.push_back(to_mesh(*make_uv_sphere(50, 51, 0.15)));
    ASSERT_NEAR(static_cast<double>(g.meshes[0].triangles.size()), 5000, 100);
    const auto accel = make_accelerator(AccelKind::embree, g, "avx2");
    Random random(4);
    constexpr size_t batch = 256;
    std::vector<Ray> rays(batch);
    std::vector<Hit> hits(batch);
    uint64_t other = 0, missed = 0;
    for (int k = 0; k < 1000000 / 256; ++k) {
        for (Ray& r : rays) r = {.org = to_float(random.point(-1.3, 1.3)), .dir = random.unit_vector()};
        accel->closest(rays, hits, k % 2 ? Coherence::incoherent : Coherence::coherent);
        for (size_t i = 0; i < batch; ++i) {
            const Hit alone = accel->closest(rays[i]);
            if (same_bits(alone, hits[i])) continue;
            ++other;
            missed += alone && hits[i] ? 0 : 1;
            ASSERT_TRUE(explainable(g, rays[i], alone, hits[i]));
        }
    }
    RecordProperty("other_primitive_per_million", std::to_string(other));
    RecordProperty("one_missed", std::to_string(missed));
    EXPECT_LT(other, 100u);
}

}  // namespace
}  // namespace lancer
