// What a ray may expect of a box that it meets, and that the eight-wide tree has its children in that order.
#include "geometry/bvh8/any_hit_order.h"

#include "geometry/bvh8/layout.h"
#include "geometry/trees.h"
#include "geometry/triangle_float.h"

namespace lancer {
namespace {

FloatBox around(const Corners& t)
{
    FloatBox box;
    for (const Vec3& p : t) box.grow({p, p});
    return box;
}

// Crofton: uniform random lines meet convex bodies in proportion to their surfaces.
TEST(AnyHitOrder, AChanceIsTheShareOfUniformLines)
{
    Random random(11);
    for (int i = 0; i < 8; ++i) {
        Corners t;
        for (Vec3& p : t) p = to_float(random.point(-0.5, 0.5));
        if (i % 2)
            for (Vec3& p : t) p.z = 0;
        const FloatBox box = around(t);
        int met = 0, hit = 0;
        while (met < 20000) {
            const Vec3d dir = random.direction();
            const Frame frame(to_float(dir));
            const Vec3d off = random.point(-1, 1);
            const Vec3 at = frame.x * static_cast<float>(off.x) + frame.y * static_cast<float>(off.y);
            const Ray ray{.org = at - to_float(dir) * 4.0f, .dir = to_float(dir)};
            if (!meets(box, SlabRay(ray), ray.t_max)) continue;
            ++met;
            hit += distance_to(ShearedRay(ray), t[0], t[1], t[2]).has_value();
        }
        const double chance = any_hit_of(t, box.half_area(), 1).chance;
        EXPECT_NEAR(hit, met * chance, 5 * std::sqrt(met * chance * (1 - chance))) << i;
    }
}

TEST(AnyHitOrder, TwoBoxes)
{
    // A wall in two halves stops all; one half behind the other stops what the first one lets pass.
    const AnyHit half{1, 1}, sparse{0.25f, 1};
    EXPECT_FLOAT_EQ(any_hit_of(half, 0.5f, half, 0.5f, 0).chance, 1);
    EXPECT_FLOAT_EQ(any_hit_of(sparse, 1, sparse, 1, 0).chance, 1 - 0.75f * 0.75f);
    // The better one is tried first, whichever is named first.
    EXPECT_FLOAT_EQ(any_hit_of(half, 1, sparse, 1, 0.5f).work, 1.5f);
    EXPECT_FLOAT_EQ(any_hit_of(sparse, 1, half, 1, 0.5f).work, 1.5f);
}

TEST(AnyHitOrder, IsFiniteWhateverTheTriangles)
{
    const auto fine = [](AnyHit h) { return h.chance >= 0 && h.chance <= 1 && h.work > 0 && h.merit() < INFINITY; };
    const Vec3 far{1e18f, -1e18f, 1e18f}, tiny{1e-40f, 0, 0};
    for (const Corners& t : {Corners{}, Corners{far, -far, {far.x, far.y, -far.z}}, Corners{tiny, {}, {}},
                             Corners{far, far, far}, Corners{Vec3{0, 1, 0}, {1, 0, 0}, {}}})
        EXPECT_TRUE(fine(any_hit_of(t, around(t).half_area(), 0.7f)));
    Random random(12);
    AnyHit sum{0, 1};
    for (int i = 0; i < 1000; ++i) {
        const AnyHit one{random.unit(), 0.1f + random.unit()};
        sum = any_hit_of(sum, random.unit(), one, random.unit(), 0.3f);
        ASSERT_TRUE(fine(sum)) << i;
    }
}

TEST(AnyHitOrder, TheChildrenOfANodeHaveIt)
{
    const Geometry g = of_mesh(tangle(13, 5000));
    const SplitTree tree = build_split_tree(all_of(g));
    const Collapse collapse(tree);
    Collapse::Children children = collapse.children(0);
    const std::span<uint32_t> all(children.nodes.data(), children.count);
    ASSERT_GT(all.size(), 3u);
    const auto merit = [&](uint32_t node) { return collapse.merit(node); };
    std::sort(all.begin(), all.end(), [&](uint32_t a, uint32_t b) { return merit(a) > merit(b); });
    EXPECT_GT(merit(all.front()), merit(all.back()));
    const Bvh8Layout layout = lay_out(tree);
    const auto& root = *reinterpret_cast<const Bvh8Node*>(layout.memory.get());
    for (size_t k = 0; k < all.size(); ++k) {
        const FloatBox& box = tree.nodes[all[k]].box;
        EXPECT_EQ(root.planes[0][k], box.lower.x) << k;
        EXPECT_EQ(root.planes[3][k], box.upper.y) << k;
    }
}

}  // namespace
}  // namespace lancer
