#include <gtest/gtest.h>

#include <set>

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

class Watertight : public testing::TestWithParam<AccelMaker> {
protected:
    Geometry g = [] {
        Geometry x;
        x.meshes.push_back(to_mesh(*make_uv_sphere(20, 40)));
        return x;
    }();
    std::vector<Vec3d> points, middles;

    void SetUp() override
    {
        const Mesh& m = g.meshes[0];
        for (size_t i = 0; i + 1 < m.positions.size(); ++i) points.push_back(to_double(m.positions[i]));
        std::set<std::pair<uint32_t, uint32_t>> edges;
        for (const auto& t : m.triangles)
            for (size_t k = 0; k < 3; ++k) edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
        ASSERT_EQ(edges.size(), m.triangles.size() * 3 / 2);  // closed
        for (const auto& [a, b] : edges) middles.push_back((points[a] + points[b]) * 0.5);
    }
    // Of rays from inside towards each target, from several places.
    static int misses(const Accelerator& accel, const std::vector<Vec3d>& targets, int rounds)
    {
        Random random(2);
        int n = 0;
        for (int round = 0; round < rounds; ++round)
            for (const Vec3d& at : targets) {
                const Vec3d org = round == 0 ? Vec3d{} : random.point(-0.5, 0.5);
                const Ray ray{.org = to_float(org), .dir = to_float(normalize(at - org))};
                n += accel.closest(ray) ? 0 : 1;
            }
        return n;
    }
};
INSTANTIATE_TEST_SUITE_P(Every, Watertight, testing::ValuesIn(accel_makers), accel_name);

TEST_P(Watertight, NoRayLeavesAClosedMesh)
{
    const auto accel = GetParam()(g);
    const bool is_list = GetParam().kind == AccelKind::list;
    Random random(3);
    std::vector<Vec3d> anywhere;
    for (int i = 0; i < 10000; ++i) anywhere.push_back(random.direction());
    EXPECT_EQ(misses(*accel, anywhere, is_list ? 1 : 50), 0);
    EXPECT_EQ(misses(*accel, middles, is_list ? 4 : 40), 0);
    const int rounds = is_list ? 10 : 40, through = misses(*accel, points, rounds);
    RecordProperty("vertex_rays", std::to_string(rounds * static_cast<int>(points.size())));
    RecordProperty("vertex_misses", std::to_string(through));
    // Embree's robust mode does not promise vertices (its issue 181); a few per cent of rays aimed at one pass.
    EXPECT_LE(through, is_list ? 0 : rounds * static_cast<int>(points.size()) / 10);
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
