// What only the eight-wide tree promises: no ray leaves a closed mesh, wherever it is aimed at; the same bits for any
// number of threads; bounded depth.
#include "geometry/bvh8/bvh8.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "core/parallel.h"
#include "geometry/accelerators.h"
#include "geometry/list/box.h"
#include "geometry/trees.h"

namespace lancer {
namespace {

struct Found {
    uint32_t number = UINT32_MAX;
    float t = INFINITY;
};
template <class Tree>
Found closest(const Tree& tree, const Ray& ray)
{
    Found f;
    float t_max = ray.t_max;
    tree.closest(ray, t_max, [&](uint32_t number, float t) {
        if (t == f.t && number > f.number) return false;
        f = {number, t};
        return true;
    });
    return f;
}
template <class Tree>
bool any(const Tree& tree, const Ray& ray)
{
    return tree.any(ray, [](uint32_t, float) { return true; });
}

TEST(Bvh8, FindsWhatALoopFinds)
{
    const Geometry g = of_mesh(tangle(1, 8000));
    const TriangleSet triangles = all_of(g);
    const Bvh8 tree(triangles);
    const Box loop(triangles);
    Random random(2);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        Ray ray{.org = to_float(random.point(-1.5, 1.5)), .dir = random.unit_vector()};
        if (i % 2) ray.t_max = static_cast<float>(random.uniform(0, 0.3));
        const Found a = closest(tree, ray), b = closest(loop, ray);
        hits += b.number != UINT32_MAX ? 1 : 0;
        EXPECT_EQ(any(tree, ray), a.number != UINT32_MAX);
        if (a.number == b.number) continue;
        const auto hit = [](const Found& f) {
            return f.number == UINT32_MAX ? Hit{} : Hit{f.t, Hit::no_instance, 0, f.number, {}, Kind::triangle};
        };
        EXPECT_TRUE(explainable(g, ray, hit(a), hit(b))) << i;
    }
    EXPECT_GT(hits, 1000);
    EXPECT_LT(hits, 1900);
}

TEST(Bvh8, IsTheSameForAnyNumberOfThreads)
{
    const Geometry g = of_mesh(tangle(6, 40000));
    const auto build = [&](unsigned threads) {
        Bvh8Layout layout;
        with_threads(threads, [&] { layout = lay_out(build_split_tree(all_of(g))); });
        return layout;
    };
    const Bvh8Layout one = build(1);
    for (const unsigned threads : {2u, 5u}) {
        const Bvh8Layout other = build(threads);
        ASSERT_EQ(one.bytes, other.bytes);
        EXPECT_EQ(std::memcmp(one.memory.get(), other.memory.get(), one.bytes), 0) << threads;
        EXPECT_TRUE(std::equal(one.slot_of_leaf.begin(), one.slot_of_leaf.end(), other.slot_of_leaf.begin(),
                               other.slot_of_leaf.end(), [](Bvh8Slot a, Bvh8Slot b) { return a.bits() == b.bits(); }));
        EXPECT_EQ(one.sah_cost, other.sah_cost);
        EXPECT_EQ(one.depth, other.depth);
    }
}

// Each twice as far as the one before: the heuristic takes off a few at a time.
Mesh long_chain()
{
    Mesh mesh;
    for (uint32_t i = 0; i < 180; ++i) {
        const float x = std::ldexp(1.0f, static_cast<int>(i) - 120);
        for (const Vec3 p : {Vec3{x, 0, 0}, Vec3{x, x, 0}, Vec3{x, 0, x}}) mesh.positions.push_back(p);
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    mesh.positions.emplace_back();
    return mesh;
}

// Rays from triangles that were hit, alone and many in turns, find what they find from the root.
TEST(Bvh8, SearchesThatBeginOnATriangleFindTheSame)
{
    for (Mesh mesh : {tangle(8, 3000), to_mesh(*make_uv_sphere(100, 200)), long_chain()}) {
        const bool is_chain = mesh.triangles.size() == 180;
        const Geometry g = of_mesh(std::move(mesh));
        const auto accel = make_accelerator(AccelKind::bvh8, g, "avx2");
        Random random(11);
        std::vector<Ray> rays;
        std::set<uint32_t> places;
        const auto send = [&](const Ray& from, Vec3 dir) {
            const Hit hit = accel->closest(from);
            if (!hit) return;
            EXPECT_NE(hit.leaf_hint, Ray::no_leaf_hint);
            places.insert(hit.leaf_hint);
            rays.push_back({.org = from.org + from.dir * hit.t, .dir = dir, .leaf_hint = hit.leaf_hint});
        };
        for (int i = 0; i < 3000; ++i)
            send({.org = to_float(random.point(-1.5, 1.5)), .dir = random.unit_vector()}, random.unit_vector());
        // The boxes of all that is farther lie around each other: more of them are left than a turn has room for.
        for (int i = -130; i < 10; ++i) {
            const float thin = std::ldexp(1.0f, i - 2);
            const Ray ray{.org = {std::ldexp(0.75f, i), thin, thin}, .dir = {1, 0, 0}};
            send(ray, ray.dir);
            if (rays.empty()) continue;
            Ray far = rays.back();  // for what hangs high above
            far.t_min = std::ldexp(1.0f, i + 90);
            rays.push_back(far);
        }
        EXPECT_GT(places.size(), is_chain ? 10u : 100u);
        ASSERT_GT(rays.size(), is_chain ? 100u : 500u);
        std::vector<Hit> found(rays.size());
        accel->closest(rays, found, Coherence::incoherent);
        int hits = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            Ray from_root = rays[i];
            from_root.leaf_hint = Ray::no_leaf_hint;
            const Hit alone = accel->closest(rays[i]), wanted = accel->closest(from_root);
            EXPECT_TRUE(same_bits(alone, wanted)) << i;
            EXPECT_TRUE(same_bits(found[i], wanted)) << i;
            EXPECT_TRUE(!wanted || found[i].leaf_hint != Ray::no_leaf_hint);
            hits += bool{wanted};
        }
        EXPECT_GT(hits, 100);
    }
}

// Triangles that lie all over each other, about as far from each other as float can tell.
Mesh pile(uint32_t count)
{
    Random random(21);
    Mesh mesh;
    for (uint32_t i = 0; i < count; ++i) {
        const Vec3d at = random.point(-1, 1);
        for (int corner = 0; corner < 3; ++corner) {
            const Vec3d p = at + random.point(-0.3, 0.3);
            mesh.positions.push_back({static_cast<float>(p.x), static_cast<float>(p.y),
                                      1 + static_cast<float>(random.uniform(-1, 1) * std::ldexp(1.0, -18 - i % 6))});
        }
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    mesh.positions.push_back({});
    return mesh;
}

// What is nearest does not hang on what was found before.
TEST(Bvh8, TheOrderOfTrianglesDoesNotMatter)
{
    const Geometry g = of_mesh(pile(1500));
    Mesh turned = g.meshes[0];
    std::reverse(turned.triangles.begin(), turned.triangles.end());
    const auto last = static_cast<uint32_t>(turned.triangles.size() - 1);
    const Geometry other = of_mesh(std::move(turned));
    const auto a = make_accelerator(AccelKind::bvh8, g, "avx2"), b = make_accelerator(AccelKind::bvh8, other, "avx2");
    Random random(22);
    int hits = 0;
    for (int i = 0; i < 30000; ++i) {
        const Ray ray{.org = to_float(random.point(-1, 1) + Vec3d{0, 0, 3}),
                      .dir = normalize(to_float(random.point(-0.4, 0.4) - Vec3d{0, 0, 2}))};
        const Hit x = a->closest(ray), y = b->closest(ray);
        ASSERT_EQ(bool{x}, bool{y}) << i;
        if (!x) continue;
        ++hits;
        EXPECT_TRUE(x.primitive == last - y.primitive || x.t == y.t) << i << ": " << x.t - y.t;
    }
    EXPECT_GT(hits, 10000);
}

TEST(Bvh8, RaysThatGoTogetherFindTheSame)
{
    for (Mesh mesh : {tangle(8, 3000), to_mesh(*make_uv_sphere(100, 200)), long_chain(), pile(1500)}) {
        const Geometry g = of_mesh(std::move(mesh));
        const auto accel = make_accelerator(AccelKind::bvh8, g, "avx2");
        Random random(12);
        std::vector<Ray> rays;
        for (int i = 0; i < 1200; ++i) {
            // From one place or from many, close together or apart, some within a plane, some that end, some that are
            // none; and not always as many as fit.
            const Vec3 from = to_float(random.point(-1.5, 1.5)), to = random.unit_vector();
            const double apart = std::ldexp(1.0, -(i % 12)), beside = i % 3 ? 0 : apart;
            for (int k = 0; k < (i % 100 ? 8 : 3); ++k) {
                Ray ray{.org = from + to_float(random.point(-beside, beside)),
                        .dir = normalize(to + to_float(random.point(-apart, apart)))};
                if (i % 7 == 0 && k == 2) ray.dir = {0, i % 2 ? 1.0f : -1.0f, 0};
                if (i % 5 == 0) ray.t_max = static_cast<float>(random.uniform(0, 1));
                if (i % 11 == 0 && k % 3 == 1) ray.dir = {NAN, 0, 1};
                rays.push_back(ray);
            }
        }
        std::vector<Hit> found(rays.size());
        accel->closest(rays, found, Coherence::coherent);
        int hits = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            const Hit alone = accel->closest(rays[i]);
            EXPECT_TRUE(same_bits(found[i], alone)) << i;
            EXPECT_TRUE(!alone || found[i].leaf_hint != Ray::no_leaf_hint);  // of several leaves with parts of it, any
            hits += bool{alone};
        }
        EXPECT_GT(hits, 300);
    }
}

TEST(Bvh8, DepthIsBounded)
{
    const Geometry chain = of_mesh(long_chain());
    const SplitTree binary = build_split_tree(all_of(chain));
    const auto depth = [&](const auto& self, uint32_t node) -> int {
        const SplitNode& n = binary.nodes[node];
        return n.is_leaf() ? 0 : 1 + std::max(self(self, n.child), self(self, n.child + 1));
    };
    EXPECT_GT(depth(depth, 0), max_free_depth);
    EXPECT_LE(depth(depth, 0), max_free_depth + 7);
    EXPECT_LE(Bvh8(all_of(chain)).depth(), max_split_depth + 1);
    const Ray ray{.org = {-1, 0x1p-122f, 0x1p-122f}, .dir = {1, 0, 0}};
    EXPECT_EQ(closest(Bvh8(all_of(chain)), ray).number, 0u);
}

// Lane by lane as meets() of slab.h, and where a ray runs within the plane of a side, whichever zeros its direction
// has.
TEST(Bvh8Node, MeetsTheBoxesThatARayMeets)
{
    Random random(9);
    int met = 0;
    for (int i = 0; i < 20000; ++i) {
        Bvh8Node node{};
        std::array<FloatBox, 8> boxes;
        for (size_t k = 0; k < 8; ++k) {
            const Vec3 a = to_float(random.point(-1, 1)), b = to_float(random.point(-1, 1));
            boxes[k].grow({a, a});
            boxes[k].grow({b, b});
            for (size_t axis = 0; axis < 3; ++axis) {
                node.planes[2 * axis][k] = boxes[k].lower[static_cast<int>(axis)];
                node.planes[2 * axis + 1][k] = boxes[k].upper[static_cast<int>(axis)];
            }
        }
        Ray ray{.org = to_float(random.point(-2, 2)), .dir = random.unit_vector()};
        const uint32_t axis = random.below(3), side = random.below(2);
        if (i % 2) {
            std::array<float, 3> o{}, d{};
            const FloatBox& box = boxes[3];
            for (size_t k = 0; k < 3; ++k) {
                const int at = static_cast<int>(k);
                o[k] = k == axis             ? -2.0f
                       : k == (axis + 1) % 3 ? (side ? box.upper : box.lower)[at]
                                             : 0.5f * (box.lower[at] + box.upper[at]);
                d[k] = k == axis ? 1.0f : random.below(2) ? 0.0f : -0.0f;
            }
            ray = {.org = {o[0], o[1], o[2]}, .dir = {d[0], d[1], d[2]}};
        }
        Float8 near;
        const uint32_t bits = NodeRay(ray).meets(node, broadcast(ray.t_max), near);
        ASSERT_TRUE(i % 2 == 0 || (bits >> 3 & 1)) << i;
        for (size_t k = 0; k < 8; ++k) {
            ASSERT_EQ(bits >> k & 1, meets(boxes[k], SlabRay(ray), ray.t_max) ? 1u : 0u) << i;
            met += static_cast<int>(bits >> k & 1);
            ASSERT_TRUE(!(bits >> k & 1) || near[k] >= 0) << i;
        }
    }
    EXPECT_GT(met, 10000);
}

TEST(Bvh8, ManyTrianglesInOnePlace)
{
    Mesh mesh = triangle_mesh({0, 0, 1}, {1, 0, 1}, {0, 1, 1});
    mesh.triangles.resize(100000, mesh.triangles[0]);
    const Geometry g = of_mesh(std::move(mesh));
    const Bvh8 tree(all_of(g));
    EXPECT_LE(tree.depth(), 20);
    const Ray ray{.org = {0.25f, 0.25f, 0}, .dir = {0, 0, 1}};
    EXPECT_EQ(closest(tree, ray).number, 0u);  // all are offered, the lowest wins
    EXPECT_EQ(closest(tree, ray).t, 1);
    EXPECT_TRUE(any(tree, ray));
}

TEST(Bvh8, NoneOneAndWhatIsNoTriangle)
{
    const Ray ray{.org = {0.25f, 0.25f, 0}, .dir = {0, 0, 1}};
    Mesh mesh = triangle_mesh({0, 0, 1}, {1, 0, 1}, {0, 1, 1});
    EXPECT_EQ(closest(Bvh8(all_of(of_mesh(mesh))), ray).number, 0u);
    const float huge = std::numeric_limits<float>::max();
    for (const Vec3 bad : {Vec3{NAN, 0, 0}, Vec3{0, INFINITY, 0}, Vec3{0, 0, -INFINITY}, Vec3{huge, -huge, huge}}) {
        for (uint32_t count : {1u, 9u, 100u}) {
            Mesh m = mesh;
            m.positions.insert(m.positions.begin() + 3, bad);
            for (uint32_t i = 0; i < count; ++i) m.triangles.push_back({i % 3, (i + 1) % 3, 3});
            const Geometry g = of_mesh(std::move(m));
            const Bvh8 tree(all_of(g));
            if (bad.x != huge) {
                EXPECT_EQ(closest(tree, ray).number, 0u);
                EXPECT_EQ(tree.bytes(), sizeof(Bvh8Node) + sizeof(Bvh8Leaf) + 3 * sizeof(Bvh8Slot))
                    << "it holds what no ray can meet";
            }
            EXPECT_EQ(any(tree, ray), true);
        }
    }
    Mesh none = mesh;
    none.positions[1].x = NAN;
    const Geometry g = of_mesh(std::move(none));
    EXPECT_EQ(closest(Bvh8(all_of(g)), ray).number, UINT32_MAX);
    EXPECT_FALSE(any(Bvh8(all_of(g)), ray));
}

// Closed meshes, and a place inside from which to look.
struct Closed {
    const char* name;
    Mesh mesh;
    Vec3d center;
    double radius;  // of a ball inside
};
std::vector<Closed> closed_meshes()
{
    const auto place = [](const MeshData& data, Vec3d scale, Vec3d move) {
        return to_mesh(data, make_transform(move, {0, 0, 0}, scale));
    };
    const Vec3d far{148376, 1234, -223423};
    const auto ball = make_uv_sphere(40, 80), needles = make_uv_sphere(4, 2000), cube = make_cube();
    std::vector<Closed> all;
    all.push_back({"ball", place(*ball, {2, 2, 2}, {}), {}, 1});
    all.push_back({"ball far away", place(*ball, {2, 2, 2}, far), far, 1});
    all.push_back({"tiny ball", place(*ball, {1e-6, 1e-6, 1e-6}, {}), {}, 0.5e-6});
    all.push_back({"huge ball", place(*ball, {1e6, 1e6, 1e6}, {}), {}, 0.5e6});
    all.push_back({"needles", place(*needles, {1, 1, 1}, {}), {}, 0.3});
    all.push_back({"cube", place(*cube, {1, 1, 1}, {}), {}, 0.3});
    all.push_back({"thin cube", place(*cube, {1e4, 1, 1e4}, {}), {}, 0.3});
    all.push_back({"cube far away", place(*cube, {1, 1, 1}, far), far, 0.3});
    return all;
}
// 0: anywhere, 1: at a point of an edge, 2: at a vertex, 3: along an axis, from where two coordinates are a vertex's
Ray ray_inside(Random& random, const Closed& c, int kind)
{
    const auto corner = [&](const std::array<uint32_t, 3>& t, uint32_t k) {
        return to_double(c.mesh.positions[t[k % 3]]);
    };
    const auto& t = c.mesh.triangles[random.below(static_cast<uint32_t>(c.mesh.triangles.size()))];
    const uint32_t k = random.below(3);
    const Vec3d a = corner(t, k), b = corner(t, k + 1);
    Vec3 org = to_float(c.center + random.direction() * (c.radius * random.uniform()));
    if (kind == 0) return {.org = org, .dir = random.unit_vector()};
    if (kind < 3) {
        const Vec3d at = kind == 1 ? a + (b - a) * random.uniform() : a;
        return {.org = org, .dir = to_float(normalize(at - to_double(org)))};
    }
    const uint32_t axis = random.below(3);
    std::array<float, 3> o{org.x, org.y, org.z}, d{};
    for (size_t i = 0; i < 3; ++i) {
        const auto x = static_cast<float>(a[static_cast<int>(i)]);
        const double off = x - c.center[static_cast<int>(i)];
        if (i != axis && std::abs(off) < c.radius / 2) o[i] = x;
        d[i] = random.below(2) ? 0.0f : -0.0f;
    }
    d[axis] = static_cast<float>(random.sign());
    return {.org = {o[0], o[1], o[2]}, .dir = {d[0], d[1], d[2]}};
}

TEST(Bvh8, NoRayLeavesAClosedMesh)
{
    const char* const kinds[] = {"anywhere", "edges", "vertices", "axes"};
    for (const Closed& c : closed_meshes()) {
        const Geometry g = of_mesh(c.mesh);
        const Bvh8 tree(all_of(g));
        Random random(7);
        for (int kind = 0; kind < 4; ++kind) {
            int misses = 0, unoccluded = 0;
            for (int i = 0; i < 50000; ++i) {
                const Ray ray = ray_inside(random, c, kind);
                misses += closest(tree, ray).number == UINT32_MAX ? 1 : 0;
                unoccluded += any(tree, ray) ? 0 : 1;
            }
            EXPECT_EQ(misses, 0) << c.name << ", " << kinds[kind];
            EXPECT_EQ(unoccluded, 0) << c.name << ", " << kinds[kind];
        }
    }
}

// Woop's own distance errs by 1e-4 on slivers; the plane's does not, and never leaves the triangle.
TEST(Bvh8, DistancesToSliversAreRight)
{
    Random random(8);
    for (int i = 0; i < 300; ++i) {
        const Vec3d a = random.point(-1, 1), along = random.direction(), across = random.direction();
        const Geometry g = of_mesh(triangle_mesh(to_float(a), to_float(a + along), to_float(a + across * 1e-3)));
        const TriangleSet triangles = all_of(g);
        const Bvh8 tree(triangles);
        const auto [p, q, r] = triangles.corners(0);
        for (int k = 0; k < 20; ++k) {
            const double u = random.uniform(), v = random.uniform(0, 1 - u);
            const Vec3d at = to_double(p) * (1 - u - v) + to_double(q) * u + to_double(r) * v;
            const Vec3d org = random.point(-2, 2);
            const Ray ray{.org = to_float(org), .dir = to_float(normalize(at - org))};
            const Found f = closest(tree, ray);
            if (f.number == UINT32_MAX) continue;  // off its edge by rounding
            const auto exact = intersect_plane_of(g.meshes[0], 0, to_double(ray.org), to_double(ray.dir));
            ASSERT_TRUE(exact);
            const Vec3d n = normalize(cross(to_double(q - p), to_double(r - p)));
            const double slant = std::abs(dot(n, to_double(ray.dir)));
            if (slant < 0.05) continue;
            EXPECT_NEAR(f.t, exact->t, 1e-5 * exact->t / slant) << i;
        }
    }
}

}  // namespace
}  // namespace lancer
