// Every accelerator against the reference in double, on meshes that are too large for the list.
#include "support/agreement.h"

#include <gtest/gtest.h>

#include "geometry/accelerators.h"
#include "support/double_tree.h"
#include "support/ray_kinds.h"

namespace lancer {
namespace {

class AgreesWithDouble : public testing::TestWithParam<AccelMaker> {
protected:
    // Accelerators that look at every triangle take their time, one at a time or by eights.
    static uint64_t count(const Geometry& g)
    {
        uint64_t triangles = 0;
        for (const Mesh& m : g.meshes) triangles += m.triangles.size();
        const AccelKind kind = GetParam().kind;
        const uint64_t tests = kind == AccelKind::box ? 4'000'000 : kind == AccelKind::list8 ? 40'000'000 : UINT64_MAX;
        return std::min<uint64_t>(5000, tests / triangles);
    }
    static void expect_agreement(const Geometry& g, const std::string& name)
    {
        const DoubleTree tree(g);
        const auto accel = GetParam()(g);
        const RaysOfKinds rays(g);
        uint64_t hits = 0;
        for (const RayKind kind : ray_kinds) {
            Agreement closest, any;
            for (uint64_t i = 0; i < count(g); ++i) {
                const Ray ray = rays.ray(kind, i);
                const Hit expected = tree.closest(ray), found = accel->closest(ray);
                closest.count(g, ray, i, expected, found);
                any.count_any(g, ray, i, expected, accel->any(ray), found);
                hits += expected ? 1 : 0;
            }
            const std::string what = name + "_" + std::string(name_of(kind));
            EXPECT_EQ(closest.wrong, 0u) << what << ", first ray " << closest.first_wrong;
            EXPECT_EQ(any.wrong, 0u) << what << ", first ray " << any.first_wrong;
            // Only of the hard ones many run into an edge or a corner.
            if (kind != RayKind::hard) {
                EXPECT_LE(closest.ties + closest.explained, count(g) / 500) << what;
            }
            RecordProperty(what + "_ties", std::to_string(closest.ties));
            RecordProperty(what + "_explained", std::to_string(closest.explained));
        }
        EXPECT_GT(hits, count(g));  // of the five kinds
    }
};
// The list has tests of its own against the reference.
const std::vector<AccelMaker> trees = [] {
    std::vector<AccelMaker> makers = accel_makers;
    std::erase_if(makers, [](const AccelMaker& m) { return m.kind == AccelKind::list; });
    return makers;
}();
INSTANTIATE_TEST_SUITE_P(Every, AgreesWithDouble, testing::ValuesIn(trees), accel_name);

TEST_P(AgreesWithDouble, OnASmoothMesh)
{
    Geometry g;
    g.meshes.push_back(to_mesh(*make_uv_sphere(100, 200, 0.15)));
    expect_agreement(g, "bumpy");
}

// Needles: a sphere of four rows.
TEST_P(AgreesWithDouble, OnSlivers)
{
    Geometry g;
    g.meshes.push_back(to_mesh(*make_uv_sphere(4, 5000)));
    expect_agreement(g, "slivers");
}

// Triangles of all sizes and shapes through each other.
TEST_P(AgreesWithDouble, OnASoup)
{
    Random random(1);
    Mesh soup;
    for (uint32_t i = 0; i < 3000; ++i) {
        const Vec3d at = random.point(-2, 2);
        const double size = std::pow(10, random.uniform(-3, 0));
        for (uint32_t k = 0; k < 3; ++k) soup.positions.push_back(to_float(at + random.point(-size, size)));
        soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    soup.positions.emplace_back();
    Geometry g;
    g.meshes.push_back(std::move(soup));
    expect_agreement(g, "soup");
}

TEST_P(AgreesWithDouble, OnMeshesInstancesSpheresAndPlanes)
{
    for (uint64_t seed = 1; seed <= 3; ++seed) expect_agreement(random_geometry(seed), "mixed_" + std::to_string(seed));
}

TEST_P(AgreesWithDouble, FarFromTheOrigin)
{
    Geometry g;
    g.meshes.push_back(
        to_mesh(*make_uv_sphere(50, 100, 0.15), make_transform({148376, 1234, -223423}, {}, {20, 20, 20})));
    expect_agreement(g, "far");
}

// A ray that starts on a surface, as far as float can tell, may meet it or not; one that starts before it must.
TEST(Agreement, ExplainsWhatLiesAtTheStart)
{
    Geometry g;
    g.meshes.push_back({.positions = {{0, 0, 3}, {1, 0, 3}, {0, 1, 3}, {0, 0, 4}, {1, 0, 4}, {0, 1, 4}, {}},
                        .triangles = {{0, 1, 2}, {3, 4, 5}}});
    const auto hit = [](uint32_t triangle, float t) {
        return Hit{t, Hit::no_instance, 0, triangle, {}, Kind::triangle};
    };
    const auto wrong = [&](float before, uint32_t reference, uint32_t found) {
        const Ray ray{.org = {0.2f, 0.2f, 3 - before}, .dir = {0, 0, 1}};
        const std::array hits{hit(0, before), hit(1, 1 + before)};
        Agreement a;
        a.count(g, ray, 0, hits[reference], hits[found]);
        EXPECT_EQ(a.rays, a.explained + a.wrong);
        return a.wrong;
    };
    for (const auto& [reference, found] : {std::pair{0u, 1u}, {1u, 0u}}) {
        EXPECT_EQ(wrong(1e-18f, reference, found), 0u);
        EXPECT_EQ(wrong(1e-6f, reference, found), 0u);
        EXPECT_EQ(wrong(1e-4f, reference, found), 1u);
    }
}

}  // namespace
}  // namespace lancer
