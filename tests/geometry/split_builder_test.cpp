// The builder with spatial splits: each part of a triangle is where rays look for it, and splitting pays.
#include "geometry/bvh8/split_builder.h"

#include "geometry/bvh8/bvh8.h"
#include "geometry/trees.h"

namespace lancer {
namespace {

// Of every point of every triangle there is a way from the root through boxes that hold it.
bool leads_to(const SplitTree& tree, uint32_t node, uint32_t triangle, Vec3 p)
{
    const SplitNode& n = tree.nodes[node];
    for (int k = 0; k < 3; ++k)
        if (p[k] < n.box.lower[k] || p[k] > n.box.upper[k]) return false;
    if (n.is_leaf()) return n.triangle == triangle;
    return leads_to(tree, n.child, triangle, p) || leads_to(tree, n.child + 1, triangle, p);
}
uint32_t count_leaves(const SplitTree& tree, uint32_t node)
{
    const SplitNode& n = tree.nodes[node];
    return n.is_leaf() ? 1 : count_leaves(tree, n.child) + count_leaves(tree, n.child + 1);
}

TEST(SplitBuilder, EachPartOfATriangleIsWhereItIsLookedFor)
{
    const Geometry g = of_mesh(tangle(3, 6000));
    const TriangleSet triangles = all_of(g);
    const SplitTree tree = build_split_tree(triangles);
    EXPECT_GT(count_leaves(tree, 0), triangles.size() * 11 / 10) << "nothing was split";
    Random random(4);
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        const auto [a, b, c] = triangles.corners(i);
        for (int k = 0; k < 8; ++k) {
            float u = random.unit(), v = random.unit();
            if (u + v > 1) u = 1 - u, v = 1 - v;
            if (k < 3) u = k == 1, v = k == 2;
            ASSERT_TRUE(leads_to(tree, 0, i, a + (b - a) * u + (c - a) * v)) << i << " " << k;
        }
    }
}

// Rods across a cloud of small triangles: no division of whole triangles parts them.
Mesh rods_in_a_cloud(int small, int rods)
{
    Mesh mesh;
    Random random(5);
    const auto add = [&](Vec3d a, Vec3d b, Vec3d c) {
        const auto n = static_cast<uint32_t>(mesh.positions.size());
        for (const Vec3d& p : {a, b, c}) mesh.positions.push_back(to_float(p));
        mesh.triangles.push_back({n, n + 1, n + 2});
    };
    for (int i = 0; i < small; ++i) {
        const Vec3d at = random.point(-1, 1);
        const Vec3d side = random.point(-0.01, 0.01);
        add(at, at + side, at + random.point(-0.01, 0.01));
    }
    for (int i = 0; i < rods; ++i) {
        const Vec3d from = random.point(-1, 1), to = random.point(-1, 1);
        add(from, to, to + random.point(-0.01, 0.01));
    }
    mesh.positions.emplace_back();
    return mesh;
}
double sah_cost(Mesh mesh)
{
    const Geometry g = of_mesh(std::move(mesh));
    return Bvh8(all_of(g)).sah_cost();
}

TEST(SplitBuilder, SpatialSplitsMakeLongTrianglesCheaper)
{
    EXPECT_LT(sah_cost(rods_in_a_cloud(4000, 100)), 50);  // 37, and 74 without spatial splits
    // So many that a part of them is asked first whether to split pays.
    EXPECT_LT(sah_cost(rods_in_a_cloud(40000, 1000)), 160);  // 131, and 207 without those of many
}

}  // namespace
}  // namespace lancer
