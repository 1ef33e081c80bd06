// No ray leaves a closed mesh: thousands of times as many as this are traced by bench_watertight.
#include "support/watertight.h"

#include <gtest/gtest.h>

#include "geometry/accelerators.h"

namespace lancer {
namespace {

// Each asks about every kind of ray in every way. Embree promises neither corners nor edges: its misses are recorded.
class ClosedMesh : public testing::TestWithParam<AccelMaker> {
protected:
    static void expect_tight(Mesh mesh, const std::string& name)
    {
        ASSERT_TRUE(is_closed(mesh)) << name;
        Geometry g;
        g.meshes.push_back(std::move(mesh));
        const auto accel = GetParam()(g);
        const std::vector<Ball> balls = balls_inside(g, 4);
        ASSERT_FALSE(balls.empty()) << name;
        const RaysFromInside rays(g.meshes[0], balls);
        const bool visits_all = GetParam().kind == AccelKind::list || GetParam().kind == AccelKind::box;
        const uint64_t most = visits_all ? 1000000 / g.meshes[0].triangles.size() : 4000;
        for (const Aim aim : aims)
            for (const Asked asked : all_asked) {
                const uint64_t count = std::min<uint64_t>(4000, most);
                const uint64_t misses =
                    count_misses(*accel, rays, aim, asked, static_cast<uint64_t>(asked) * count, count);
                const std::string what = name + "_" + std::string(name_of(aim)) + "_" + std::string(name_of(asked));
                if (GetParam().kind == AccelKind::embree)
                    RecordProperty(what + "_misses", std::to_string(misses));
                else
                    EXPECT_EQ(misses, 0u) << what;
            }
    }
    static inline const Vec3d far_away{148376, 1234, -223423};
};
INSTANTIATE_TEST_SUITE_P(Every, ClosedMesh, testing::ValuesIn(accel_makers), accel_name);

TEST_P(ClosedMesh, SphereOfManyTriangles) { expect_tight(to_mesh(*make_uv_sphere(50, 100)), "sphere"); }

TEST_P(ClosedMesh, Cube) { expect_tight(to_mesh(*make_cube()), "cube"); }

TEST_P(ClosedMesh, ThinBox)
{
    expect_tight(to_mesh(*make_cube(), make_transform({}, {}, {5000, 0.5, 5000})), "thin");
    expect_tight(to_mesh(*make_cube(), make_transform({}, {30, 40, 50}, {5000, 0.5, 5000})), "thin_turned");
}

TEST_P(ClosedMesh, Needles) { expect_tight(to_mesh(*make_uv_sphere(4, 2000)), "needles"); }

TEST_P(ClosedMesh, SmallAndLarge)
{
    for (const double size : {1e-6, 1e6})
        expect_tight(to_mesh(*make_uv_sphere(20, 40, 0.1), make_transform({}, {}, {size, size, size})),
                     size < 1 ? "small" : "large");
}

// Coordinates there are multiples of 1/64: triangles collapse and fold over.
TEST_P(ClosedMesh, FarFromTheOrigin)
{
    const Mesh sphere = to_mesh(*make_uv_sphere(50, 100), make_transform({}, {}, {2, 2, 2}));
    expect_tight(moved(sphere, far_away), "far_sphere");
    expect_tight(moved(to_mesh(*make_cube()), far_away), "far_cube");
}

TEST(ClosedMeshes, AreToldFromOpenOnes)
{
    Mesh m = to_mesh(*make_uv_sphere(8, 16));
    EXPECT_TRUE(is_closed(m));
    m.triangles.pop_back();
    EXPECT_FALSE(is_closed(m));
    EXPECT_FALSE(is_closed(triangle_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0})));
}

TEST(ClosedMeshes, HaveBallsInside)
{
    Geometry g;
    g.meshes.push_back(to_mesh(*make_uv_sphere(20, 40)));
    const auto balls = balls_inside(g, 10);
    EXPECT_EQ(balls.size(), 10u);
    for (const Ball& b : balls) EXPECT_LT(length(b.center) + b.radius, 1);
}

}  // namespace
}  // namespace lancer
