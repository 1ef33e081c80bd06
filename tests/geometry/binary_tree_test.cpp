// Binary trees: what builders promise, on meshes and on what is no mesh worth the name, and that a ray comes by every
// box that it meets.
#include "geometry/bvh2/tree.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/parallel.h"
#include "geometry/accelerators.h"
#include "geometry/bvh2/bvh2.h"
#include "geometry/bvh2/median.h"
#include "geometry/list/box.h"
#include "geometry/tree_accelerator.h"

namespace lancer {
namespace {

using Build = BuiltTree (*)(std::vector<BoxedPrimitive>, uint32_t);

struct Builder {
    const char* name;
    Build build;
    friend void PrintTo(const Builder& b, std::ostream* out) { *out << b.name; }
};
class Builders : public testing::TestWithParam<Builder> {};
INSTANTIATE_TEST_SUITE_P(Both, Builders, testing::Values(Builder{"median", build_median}, Builder{"sah", build_sah}),
                         [](const auto& i) { return std::string(i.param.name); });

std::vector<BoxedPrimitive> primitives_of(const std::vector<FloatBox>& boxes)
{
    std::vector<BoxedPrimitive> primitives;
    for (const FloatBox& b : boxes) primitives.emplace_back(b, static_cast<uint32_t>(primitives.size()));
    return primitives;
}
FloatBox cube_at(Vec3 p, float size) { return {p, p + Vec3{size, size, size}}; }
std::vector<FloatBox> random_boxes(uint32_t count, uint64_t seed)
{
    Random random(seed);
    std::vector<FloatBox> boxes;
    for (uint32_t i = 0; i < count; ++i) {
        const Vec3 at = to_float(random.point(-1, 1));
        boxes.push_back({at, at + to_float(random.point(0, 0.1))});
    }
    return boxes;
}
bool holds(const FloatBox& outer, const FloatBox& inner)
{
    FloatBox both = outer;
    both.grow(inner);
    return both.lower == outer.lower && both.upper == outer.upper;
}

// Every primitive in one leaf, every box around what is below it, no leaf and no depth beyond what is promised.
void expect_sound(const BuiltTree& built, const std::vector<FloatBox>& boxes, uint32_t leaf_size)
{
    ASSERT_EQ(built.order.size(), boxes.size());
    EXPECT_LE(built.tree.depth(), BinaryTree::max_depth);
    std::vector<uint32_t> seen(boxes.size());
    struct Entry {
        BinaryTree::Child child;
        FloatBox box;
    };
    std::vector<Entry> stack;
    if (!built.tree.empty()) stack.push_back({built.tree.root(), built.tree.box()});
    while (!stack.empty()) {
        const auto [at, box] = stack.back();
        stack.pop_back();
        ASSERT_LE(at.count, leaf_size);
        for (uint32_t i = at.first; i < at.first + at.count; ++i) {
            ++seen[built.order[i]];
            ASSERT_TRUE(holds(box, boxes[built.order[i]]));
        }
        if (at.count != 0) continue;
        const BinaryTree::Pair& p = built.tree.pairs()[at.first];
        for (uint32_t k = 0; k < 2; ++k) {
            ASSERT_TRUE(holds(box, p.box(k)));
            stack.push_back({p.child[k], p.box(k)});
        }
        ASSERT_FALSE(p.box(0).half_area() < p.box(1).half_area());
    }
    for (const uint32_t times : seen) ASSERT_EQ(times, 1u);
}

TEST_P(Builders, TreesAreSoundWhateverTheBoxes)
{
    constexpr float inf = FloatBox::inf, huge = std::numeric_limits<float>::max();
    std::vector<std::vector<FloatBox>> cases{{}, {cube_at({1, 2, 3}, 1)}, random_boxes(5, 1), random_boxes(20000, 2)};
    cases.emplace_back(100000, cube_at({1, 2, 3}, 1));  // all the same
    auto& nested = cases.emplace_back();                // all of one centre
    for (uint32_t i = 1; i <= 1000; ++i) {
        const auto r = static_cast<float>(i);
        nested.push_back({{-r, -r, -r}, {r, r, r}});
    }
    auto& flat = cases.emplace_back(random_boxes(1000, 3));
    for (FloatBox& b : flat) b.lower.y = b.upper.y = 0;
    auto& vast = cases.emplace_back(random_boxes(1000, 4));
    for (FloatBox& b : vast) b.lower = b.lower * huge, b.upper = b.upper * huge;
    auto& endless = cases.emplace_back(random_boxes(1000, 5));
    for (size_t i = 0; i < endless.size(); i += 3) endless[i].upper.x = inf, endless[i].lower.y = -inf;
    for (size_t i = 1; i < endless.size(); i += 3) endless[i] = {{-inf, -inf, -inf}, {inf, inf, inf}};
    for (size_t i = 0; i < cases.size(); ++i)
        for (const uint32_t leaf_size : {1u, 4u}) {
            SCOPED_TRACE(i);
            expect_sound(GetParam().build(primitives_of(cases[i]), leaf_size), cases[i], leaf_size);
        }
}

// Each cut in the middle takes but one primitive off, and the cheapest often does. No area is a denormal, whose
// flushing other tests of the process may have switched on.
TEST_P(Builders, DepthIsBoundedWhereEachCutTakesOneOff)
{
    std::vector<FloatBox> boxes;
    for (int i = -60; i <= 60; ++i) boxes.push_back(cube_at({std::ldexp(1.0f, i), 0, 0}, std::ldexp(0.5f, i)));
    const BuiltTree built = GetParam().build(primitives_of(boxes), 1);
    expect_sound(built, boxes, 1);
    EXPECT_GT(built.tree.depth(), 20u) << "no such case";
    // A ray along all of them needs the most of its stack.
    uint32_t met = 0;
    built.tree.closest({.org = {0, 0x1p-61f, 0x1p-61f}, .t_min = 0, .dir = {1, 0, 0}}, FloatBox::inf,
                       [&](uint32_t, uint32_t count, float t_max) {
                           met += count;
                           return t_max;
                       });
    EXPECT_EQ(met, boxes.size());
}

TEST_P(Builders, TheTreeDoesNotDependOnThreads)
{
    const std::vector<FloatBox> boxes = random_boxes(60000, 6);
    const auto build = [&](unsigned threads) {
        BuiltTree built;
        with_threads(threads, [&] { built = GetParam().build(primitives_of(boxes), 4); });
        return built;
    };
    const BuiltTree one = build(1);
    expect_sound(one, boxes, 4);
    for (const unsigned threads : {2, 3, 8}) {
        const BuiltTree many = build(threads);
        ASSERT_EQ(one.order, many.order);
        ASSERT_EQ(one.tree.pairs().size(), many.tree.pairs().size());
        ASSERT_EQ(std::memcmp(one.tree.pairs().data(), many.tree.pairs().data(), one.tree.pairs().size_bytes()), 0);
    }
}

// Against the plain test of one box.
TEST_P(Builders, RaysComeByEveryBoxThatTheyMeet)
{
    const std::vector<FloatBox> boxes = random_boxes(300, 7);
    const BuiltTree built = GetParam().build(primitives_of(boxes), 1);
    Random random(8);
    uint64_t met = 0, visits = 0;
    for (int i = 0; i < 10000; ++i) {
        Ray ray{.org = to_float(random.point(-2, 2)), .dir = to_float(random.direction())};
        if (i % 3 == 0) ray.org = boxes[random.below(300)].lower;  // on three sides, and with zeros of both signs
        if (i % 6 == 0) ray.dir = Vec3{1, -0.0f, 0} * static_cast<float>(random.sign());
        if (i % 2) ray.t_max = static_cast<float>(random.uniform(0, 2));
        const SlabRay slab(ray);
        std::vector<uint8_t> by_any(boxes.size()), by_closest(boxes.size());
        EXPECT_FALSE(built.tree.any(ray, [&](uint32_t first, uint32_t) {
            by_any[built.order[first]] = 1;
            return false;
        }));
        built.tree.closest(ray, ray.t_max, [&](uint32_t first, uint32_t, float t_max) {
            by_closest[built.order[first]] = 1;
            return t_max;
        });
        ASSERT_EQ(by_any, by_closest);
        for (size_t k = 0; k < boxes.size(); ++k) {
            const bool meets_it = meets(boxes[k], slab, ray.t_max);
            ASSERT_TRUE(!meets_it || by_any[k]) << i;
            met += meets_it ? 1 : 0;
            visits += by_any[k];
        }
    }
    EXPECT_GT(met, 1000u);
    EXPECT_LT(visits, met + met / 100) << "boxes are visited that are not met";
}

Geometry geometry_of(Mesh mesh)
{
    Geometry g;
    g.meshes.push_back(std::move(mesh));
    return g;
}
Mesh soup(uint32_t count, float extent, uint64_t seed)
{
    Random random(seed);
    Mesh m;
    for (uint32_t i = 0; i < count; ++i) {
        const Vec3d at = random.point(-1, 1);
        for (int k = 0; k < 3; ++k)
            m.positions.push_back(to_float(at + random.point(-1, 1) * static_cast<double>(extent)));
        m.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    m.positions.emplace_back();
    return m;
}

TEST(BinaryTrees, EachRungOfTheLadderCostsLess)
{
    Mesh teapot_in_a_stadium = to_mesh(*make_uv_sphere(60, 80, 0.1), make_transform({}, {}, {0.01, 0.01, 0.01}));
    const Mesh stadium = to_mesh(*make_uv_sphere(10, 12, 0.1), make_transform({3, 0, 0}, {}, {9, 4, 9}));
    const auto first = static_cast<uint32_t>(teapot_in_a_stadium.positions.size());
    for (const auto& t : stadium.triangles)
        teapot_in_a_stadium.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    teapot_in_a_stadium.positions.insert(teapot_in_a_stadium.positions.end(), stadium.positions.begin(),
                                         stadium.positions.end());
    for (const Mesh& m : {to_mesh(*make_uv_sphere(60, 80, 0.1)), soup(5000, 0.05f, 1), soup(500, 1, 2),
                          std::move(teapot_in_a_stadium)}) {
        const Geometry g = geometry_of(m);
        const TriangleSet triangles(g, {0});
        const double box = Box(triangles).sah_cost(), median = Median(triangles).sah_cost();
        const double sah = Bvh2(triangles).sah_cost();
        EXPECT_LT(sah, median);
        EXPECT_LT(median, box);
        EXPECT_LE(static_cast<double>(Bvh2(triangles).bytes()), 92.0 * triangles.size());
    }
}

// Two cubes of side 1, side by side at a distance of 1, alone in their leaves.
TEST(BinaryTrees, CostHasItsClosedForm)
{
    const std::vector<FloatBox> boxes{cube_at({0, 0, 0}, 1), cube_at({2, 0, 0}, 1)};
    const BuiltTree built = build_sah(primitives_of(boxes), 1);
    EXPECT_DOUBLE_EQ(built.tree.sah_cost(), 1 + 2 * 3.0 / 7);
    EXPECT_EQ(built.tree.depth(), 1u);
    EXPECT_EQ(build_sah(primitives_of(boxes), 2).tree.sah_cost(), 2);
    EXPECT_EQ(BinaryTree().sah_cost(), 0);
}

TEST(BinaryTrees, TrianglesThatAreNotFiniteNeverReachThem)
{
    Mesh m = soup(3000, 0.1f, 3);
    const float bad[] = {NAN, INFINITY, -INFINITY};
    for (uint32_t i = 0; i < 3000; i += 3) {
        Vec3& p = m.positions[3 * i + i / 3 % 3];
        p = i % 2 ? Vec3{bad[i / 3 % 3], p.y, p.z} : Vec3{p.x, p.y, bad[i / 3 % 3]};
    }
    const Geometry g = geometry_of(std::move(m));
    const TriangleSet triangles(g, {0});
    for (const BoxedPrimitive& p : boxes_of(triangles)) {
        ASSERT_NE(p.number() % 3, 0u);
        ASSERT_LT(p.box.half_area(), 1.0f);
    }
    EXPECT_EQ(boxes_of(triangles).size(), 2000u);
    const Bvh2 bvh2(triangles);
    const Median median(triangles);
    const Box box(triangles);
    Random random(4);
    int hits = 0;
    for (int i = 0; i < 3000; ++i) {
        const Ray ray{.org = to_float(random.point(-1.5, 1.5)), .dir = to_float(random.direction())};
        const auto nearest = [&](const auto& tree) {
            uint32_t best = UINT32_MAX;
            float t_max = ray.t_max, best_t = FloatBox::inf;
            tree.closest(ray, t_max, [&](uint32_t number, float t) {
                if (t < best_t || (t == best_t && number < best)) best = number, best_t = t;
                return true;
            });
            return std::pair(best, best_t);
        };
        ASSERT_EQ(nearest(bvh2), nearest(box));
        ASSERT_EQ(nearest(median), nearest(box));
        hits += nearest(box).first != UINT32_MAX ? 1 : 0;
    }
    EXPECT_GT(hits, 500);
}

TEST(TriangleBlock, GivesTheBitsOfOneTriangle)
{
    Random random(5);
    int hits = 0, edges = 0;
    for (int i = 0; i < 100000; ++i) {
        TriangleBlock block;
        std::array<std::array<Vec3, 3>, 4> corners;
        const auto count = 1 + random.below(4);
        for (uint32_t k = 0; k < count; ++k) {
            // Whole numbers, so that rays pass through corners and along edges exactly.
            for (Vec3& c : corners[k])
                c = i % 2 ? to_float(random.point(-2, 2))
                          : Vec3{static_cast<float>(random.below(5)) - 2, static_cast<float>(random.below(5)) - 2,
                                 static_cast<float>(random.below(5)) - 2};
            block.set(k, corners[k], k);
        }
        Ray ray{.org = to_float(random.point(-3, 3)), .dir = to_float(random.direction())};
        if (i % 2 == 0) {
            ray.org = {static_cast<float>(random.below(7)) - 3, static_cast<float>(random.below(7)) - 3, -3};
            ray.dir = corners[0][random.below(3)] - ray.org;
        }
        if (!is_traceable(ray)) continue;
        if (i % 4 == 0) ray.t_max = 1;
        const BlockRay r(ray);
        float t[4];
        const uint32_t met = meets(block, r, ray.t_min, ray.t_max, t);
        for (uint32_t k = 0; k < 4; ++k) {
            const auto alone = k < count ? distance_to(r.sheared, corners[k][0], corners[k][1], corners[k][2])
                                         : std::optional<float>{};
            const bool expected = alone && *alone >= ray.t_min && *alone <= ray.t_max;
            ASSERT_EQ((met >> k & 1) != 0, expected) << i;
            if (!expected) continue;
            ASSERT_EQ(std::bit_cast<uint32_t>(t[k]), std::bit_cast<uint32_t>(*alone));
            ++hits;
            edges += i % 2 == 0 ? 1 : 0;
        }
    }
    EXPECT_GT(hits, 10000);
    EXPECT_GT(edges, 5000);
}

class ObjectLaws : public testing::TestWithParam<AccelMaker> {};
INSTANTIATE_TEST_SUITE_P(Every, ObjectLaws, testing::ValuesIn(accel_makers), accel_name);

// More instances and spheres than anybody tries one by one; some of them twice, some far from the origin of their mesh.
TEST_P(ObjectLaws, ManyObjectsAreFoundAsTheListFindsThem)
{
    Random random(6);
    Geometry g;
    g.meshes.push_back(to_mesh(*make_uv_sphere(5, 6, 0.1)));
    g.meshes.push_back(to_mesh(*make_cube(), make_transform({1000, -2000, 500}, {}, {1, 1, 1})));
    g.meshes.push_back(soup(20, 0.2f, 7));
    g.meshes[0].instanced = g.meshes[1].instanced = true;
    for (uint32_t i = 0; i < 150; ++i) {
        const Vec3d scale = random.point(0.02, 0.2), at = random.point(-2, 2), turn_deg = random.point(-180, 180);
        const Transform back = make_transform(i % 2 ? Vec3d{-1000, 2000, -500} : Vec3d{}, {}, {1, 1, 1});
        g.instances.push_back(make_instance(i % 2, compose(make_transform(at, turn_deg, scale), back)));
        if (i % 10 == 0) g.instances.push_back(g.instances.back());
        g.spheres.push_back({random.point(-2, 2), random.uniform(0.02, 0.2)});
        if (i % 10 == 0) g.spheres.push_back(g.spheres.back());
    }
    g.planes.push_back({{0, 1, 0}, -2});
    const auto accel = GetParam()(g), list = make_accelerator(AccelKind::list, g, "");
    int hits = 0, other = 0;
    for (int i = 0; i < 1000; ++i) {
        Ray ray{.org = to_float(random.point(-3, 3)), .dir = to_float(random.direction())};
        if (i % 5 == 0) ray.org = ray.org - ray.dir * 1000.0f;
        if (i % 3 == 0) ray.t_max = i % 5 == 0 ? 1000 : 1;
        const Hit a = accel->closest(ray), b = list->closest(ray);
        ASSERT_EQ(static_cast<bool>(a), accel->any(ray));
        hits += b ? 1 : 0;
        if (same_bits(a, b)) continue;
        ++other;
        ASSERT_TRUE(explainable(g, ray, a, b)) << i << ": t " << a.t << " and " << b.t;
    }
    EXPECT_GT(hits, 500);
    EXPECT_LT(other, 10);
    RecordProperty("other_primitive", std::to_string(other));
}

// A ray that the mesh stops in its own space, where rounding has moved it, is not turned away by the instance's box.
TEST(Objects, BoxesAreWideEnoughForTheRoundingOfRays)
{
    const Transform far = make_transform({1000, -2000, 500}, {}, {1, 1, 1});
    Geometry g = geometry_of(to_mesh(*make_cube(), far));
    g.meshes[0].instanced = true;
    const Box cube(TriangleSet(g, {0}));
    Random random(9);
    int met = 0, missed = 0;
    for (int k = 0; k < 20; ++k) {
        const Vec3d at = random.point(-1, 1), scale = random.point(0.1, 1);
        g.instances = {make_instance(0, compose(make_transform(at, {}, scale), inverse(far)))};
        const TreeAccelerator<Bvh2> accel(g);
        for (int i = 0; i < 2000; ++i) {
            Vec3d on_edge{random.sign(), random.sign(), random.uniform(-1, 1)};
            if (i % 2) on_edge = {on_edge.z, on_edge.x, on_edge.y};
            const Vec3d target = g.instances[0].to_world.point(far.point(on_edge));
            const Vec3 org = to_float(random.point(-5, 5));
            const Ray ray{.org = org, .dir = to_float(normalize(target - to_double(org)))};
            Ray local = ray;
            local.org = to_float(g.instances[0].to_mesh.point(to_double(ray.org)));
            local.dir = to_float(g.instances[0].to_mesh.vector(to_double(ray.dir)));
            const bool stops = cube.any(local, [](uint32_t, float) { return true; });
            ASSERT_EQ(accel.any(ray), stops) << k << " " << i;
            (stops ? met : missed) += 1;
        }
    }
    EXPECT_GT(met, 10000);
    EXPECT_GT(missed, 1000);
}

}  // namespace
}  // namespace lancer
