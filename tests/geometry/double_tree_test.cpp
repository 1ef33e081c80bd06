// The reference that other accelerators are held to at full size: is it the list?
#include "support/double_tree.h"

#include <gtest/gtest.h>

#include "geometry/accelerators.h"
#include "geometry/list/list.h"

namespace lancer {
namespace {

void expect_same(const Geometry& g, const std::vector<Ray>& rays, uint64_t least_hits)
{
    const List list(g);
    const DoubleTree tree(g);
    uint64_t hits = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        const Hit a = tree.closest(rays[i]), b = list.closest(rays[i]);
        ASSERT_TRUE(same_bits(a, b) && a.exit == b.exit)
            << i << ": t " << a.t << " and " << b.t << ", primitives " << a.primitive << " and " << b.primitive;
        ASSERT_EQ(tree.any(rays[i]), list.any(rays[i])) << i;
        hits += b ? 1 : 0;
    }
    EXPECT_GE(hits, least_hits);
}

TEST(DoubleTree, IsTheListOnRandomGeometry)
{
    for (uint64_t seed = 1; seed <= 10; ++seed) {
        const Geometry g = random_geometry(seed);
        Random random(seed);
        std::vector<Ray> rays(4000);
        for (Ray& r : rays) {
            r = random_ray(random, g);
            if (random.below(4) == 0) r.t_max = static_cast<float>(std::pow(10.0, random.uniform(-2, 1)));
        }
        expect_same(g, rays, 1500);
    }
}

// Corners on a coarse grid and directions that shear without rounding, so that boxes and triangles share their planes,
// whole triangles coincide, and many rays run within a side, along an edge or through a corner.
TEST(DoubleTree, IsTheListWhereEverythingTouches)
{
    Random random(20);
    const auto grid_point = [&](uint32_t reach) {
        const auto coordinate = [&] {
            return static_cast<float>(random.below(2 * reach + 1)) - static_cast<float>(reach);
        };
        const float x = coordinate(), y = coordinate();
        return Vec3{x, y, coordinate()};
    };
    Mesh mesh;
    for (uint32_t i = 0; i < 300; ++i) {
        for (uint32_t k = 0; k < 3; ++k) mesh.positions.push_back(grid_point(3));
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    mesh.positions.emplace_back();
    Geometry g;
    g.meshes.push_back(std::move(mesh));
    std::vector<Ray> rays(20000);
    for (Ray& r : rays) {
        r.org = grid_point(3);
        do r.dir = grid_point(1);
        while (r.dir == Vec3{});
        if (random.below(2)) r.dir = r.dir * -1.0f;  // zeros become negative
        if (random.below(2)) r.t_max = static_cast<float>(random.below(3));
    }
    expect_same(g, rays, 5000);
}

TEST(DoubleTree, IsTheListFarAwayAndAtAnySize)
{
    for (const double scale : {1e-6, 1.0, 1e6})
        for (const double away : {0.0, 1e3, 1e5}) {
            Random random(30);
            const Vec3d move = Vec3d{away, -0.3 * away, 0.7 * away} * scale;
            Geometry g;
            g.meshes.push_back(
                to_mesh(*make_uv_sphere(16, 32, 0.15), make_transform(move, {10, 20, 30}, {scale, scale, scale})));
            std::vector<Ray> rays(2500);
            for (Ray& r : rays) {
                r.org = to_float(move + random.point(-2, 2) * scale);
                r.dir = random.unit_vector();
            }
            expect_same(g, rays, 400);
        }
}

TEST(DoubleTree, CountsWhatARayGoesThrough)
{
    Geometry g;
    for (const double size : {1.0, 2.0, 3.0})
        g.meshes.push_back(to_mesh(*make_uv_sphere(12, 24), make_transform({}, {}, {size, size, size})));
    const DoubleTree tree(g);
    Random random(40);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 d = random.unit_vector();
        EXPECT_EQ(tree.crossings({.org = d * 0.1f, .dir = d}), 3u);
        EXPECT_EQ(tree.crossings({.org = d * 1.5f, .dir = d}), 2u);
        EXPECT_EQ(tree.crossings({.org = d * 5.0f, .dir = -d}), 6u);
        EXPECT_EQ(tree.crossings({.org = d * 5.0f, .dir = d}), 0u);
    }
}

}  // namespace
}  // namespace lancer
