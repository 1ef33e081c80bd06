// What rays pass through: the same for every accelerator, alone or in a batch, in any order, whichever of the parts of
// a tree a triangle lies in.
#include <gtest/gtest.h>

#include <numeric>

#include "core/hash.h"
#include "geometry/accelerators.h"

namespace lancer {
namespace {

// Half of all hits, by all that a hit is, to the last bit of t and uv: an accelerator that asks about a place of its
// own reckoning, or with another ray than the one it was given, gets other answers.
bool half_of_all(const void*, const Ray& ray, const Hit& hit)
{
    uint64_t h = 0;
    for (const uint32_t x :
         {ray.key, std::bit_cast<uint32_t>(ray.dir.x), std::bit_cast<uint32_t>(ray.org.y),
          std::bit_cast<uint32_t>(hit.t), std::bit_cast<uint32_t>(hit.uv.x), std::bit_cast<uint32_t>(hit.uv.y),
          hit.instance, hit.geometry, hit.primitive, static_cast<uint32_t>(hit.kind), uint32_t{hit.exit}})
        h = mix_bits(h ^ x);
    return h & 1;
}
bool none_passes(const void*, const Ray&, const Hit&) { return false; }
bool all_pass(const void*, const Ray&, const Hit&) { return true; }

Geometry with_holes(Geometry g, bool (*passes_through)(const void*, const Ray&, const Hit&))
{
    g.alpha_test.passes_through = passes_through;
    for (const Mesh& m : g.meshes) g.alpha_test.meshes.emplace_back(m.triangles.size(), uint8_t{1});
    g.alpha_test.spheres = g.alpha_test.planes = true;
    return g;
}
// Two of three triangles in every other mesh of random_geometry(), instanced or not, and its spheres or its planes.
Geometry with_some_holes(uint64_t seed, bool (*passes_through)(const void*, const Ray&, const Hit&))
{
    Geometry g = with_holes(random_geometry(seed), passes_through);
    for (size_t i = 0; i < g.meshes.size(); ++i) {
        auto& ask = g.alpha_test.meshes[i];
        if ((i + seed) % 2 == 0) ask.clear();
        for (size_t t = 0; t < ask.size(); ++t) ask[t] = t % 3 != 0;
    }
    g.alpha_test.spheres = seed % 3 != 0;
    g.alpha_test.planes = seed % 3 != 1;
    return g;
}
Ray keyed(Ray ray, Random& random)
{
    ray.key = static_cast<uint32_t>(random.bits());
    return ray;
}

bool is_inside(const Sphere& s, Vec3 p)
{
    const Vec3d d = to_double(p) - s.center;
    return dot(d, d) < s.radius * s.radius;
}

class HoleLaws : public testing::TestWithParam<AccelMaker> {};
INSTANTIATE_TEST_SUITE_P(Every, HoleLaws, testing::ValuesIn(accel_makers), accel_name);

// For every accelerator at once, because the list takes the most time.
TEST(Holes, AreWhereTheListHasThem)
{
    const auto number = [](AccelKind kind) -> size_t { return kind == AccelKind::list ? 1000 : 25000; };  // it is slow
    const size_t most = number(AccelKind::embree);
    struct Count {
        uint64_t other = 0, through = 0, exits = 0, instanced = 0;
    };
    std::vector<Count> counts(accel_makers.size());
    for (uint64_t seed = 1; seed <= 4; ++seed) {
        const Geometry g = with_some_holes(seed, half_of_all), closed = random_geometry(seed);
        const auto list = make_accelerator(AccelKind::list, g, "");
        const auto solid = make_accelerator(AccelKind::embree, closed, "avx2");
        Random random(100 + seed);
        std::vector<Ray> rays(most);
        for (Ray& r : rays) r = keyed(random_ray(random, g), random);
        std::vector<Hit> expected(most), without_holes(most);
        for (size_t i = 0; i < most; ++i) expected[i] = list->closest(rays[i]);
        solid->closest(rays, without_holes, Coherence::incoherent);
        for (size_t k = 0; k < accel_makers.size(); ++k) {
            SCOPED_TRACE(std::string(accel_makers[k].name) + ", seed " + std::to_string(seed));
            Count& count = counts[k];
            const auto accel = accel_makers[k](g);
            const size_t n = number(accel_makers[k].kind);
            std::vector<Hit> hits(n);
            std::vector<uint8_t> occluded(n);
            accel->closest(std::span(rays).first(n), hits, Coherence::incoherent);
            accel->any(std::span(rays).first(n), occluded);
            for (size_t i = 0; i < n; ++i) {
                const Hit alone = accel->closest(rays[i]), &met = expected[i];
                if (!same_primitive(met, alone) || !same_primitive(met, hits[i])) {
                    ++count.other;
                    ASSERT_TRUE(explainable(g, rays[i], met, alone)) << "ray " << i;
                    ASSERT_TRUE(explainable(g, rays[i], met, hits[i])) << "ray " << i;
                    continue;
                }
                ASSERT_TRUE(same_bits(met, alone) && same_bits(met, hits[i])) << "ray " << i;
                ASSERT_EQ(met.exit, alone.exit);
                ASSERT_EQ(met.exit, hits[i].exit);
                ASSERT_EQ(accel->any(rays[i]), static_cast<bool>(met));
                ASSERT_EQ(occluded[i] != 0, static_cast<bool>(met));
                count.through += same_primitive(met, without_holes[i]) ? 0 : 1;
                count.exits += met.exit && !is_inside(g.spheres[met.primitive], rays[i].org) ? 1 : 0;
                count.instanced += met && met.instance != Hit::no_instance ? 1 : 0;
            }
        }
    }
    for (size_t k = 0; k < accel_makers.size(); ++k) {
        SCOPED_TRACE(accel_makers[k].name);
        const size_t n = number(accel_makers[k].kind);
        EXPECT_LT(counts[k].other, 4 * n / 16);  // of rays that come near an edge
        EXPECT_GT(counts[k].through, n / 2);     // of 4 n
        EXPECT_GT(counts[k].exits, n / 100);     // through the near side of a sphere, to the far one
        EXPECT_GT(counts[k].instanced, n / 50);
    }
}

// Short rays, as shadow rays are.
TEST_P(HoleLaws, SomethingIsInTheWayIfSomethingIsNearest)
{
    const Geometry g = with_holes(random_geometry(11), half_of_all);
    const auto accel = GetParam()(g);
    Random random(200);
    int occluded = 0;
    for (int i = 0; i < 10000; ++i) {
        Ray ray = keyed(random_ray(random, g), random);
        ray.t_max = static_cast<float>(std::pow(10.0, random.uniform(-2, 1)));
        const Hit hit = accel->closest(ray);
        ASSERT_EQ(accel->any(ray), static_cast<bool>(hit)) << i;
        occluded += hit ? 1 : 0;
    }
    EXPECT_GT(occluded, 1000);
    EXPECT_LT(occluded, 9000);
}

TEST_P(HoleLaws, DoNotDependOnOrderOrBatch)
{
    constexpr size_t n = 4000;
    const Geometry g = with_holes(random_geometry(21), half_of_all);
    const auto accel = GetParam()(g);
    Random random(300);
    std::vector<Ray> rays(n);
    for (Ray& r : rays) r = keyed(random_ray(random, g), random);
    std::vector<size_t> order(n);
    std::iota(order.begin(), order.end(), size_t{0});
    for (size_t i = n; i > 1; --i) std::swap(order[i - 1], order[random.below(static_cast<uint32_t>(i))]);
    std::vector<Hit> first(n), second(n);
    std::vector<Ray> shuffled;
    for (const size_t i : order) shuffled.push_back(rays[i]);
    accel->closest(rays, first, Coherence::coherent);
    for (size_t at = 0; at < n;) {
        const size_t some = std::min<size_t>(1 + random.below(20), n - at);
        accel->closest(std::span(shuffled).subspan(at, some), std::span(second).subspan(at, some),
                       Coherence::incoherent);
        at += some;
    }
    for (size_t i = 0; i < n; ++i) {
        const Hit &a = first[order[i]], &b = second[i];
        ASSERT_TRUE(same_bits(a, b) || explainable(g, shuffled[i], a, b)) << i;
    }
}

TEST_P(HoleLaws, ThatLetNothingPassAreNone)
{
    const Geometry g = random_geometry(31), marked = with_holes(g, none_passes);
    const auto plain = GetParam()(g), asked = GetParam()(marked);
    Random random(400);
    for (int i = 0; i < 10000; ++i) {
        const Ray ray = random_ray(random, g);
        const Hit a = plain->closest(ray), b = asked->closest(ray);
        ASSERT_TRUE(same_bits(a, b) || explainable(g, ray, a, b)) << i;
        ASSERT_EQ(plain->any(ray), asked->any(ray)) << i;
    }
}

// What is left is what is not marked.
TEST_P(HoleLaws, ThatLetEverythingPassAreNotThere)
{
    const Geometry empty = with_holes(random_geometry(41), all_pass);
    const auto nothing = GetParam()(empty);
    Geometry half = with_some_holes(42, all_pass), rest = random_geometry(42);
    half.alpha_test.spheres = true, half.alpha_test.planes = false;
    for (size_t i = 0; i < rest.meshes.size(); ++i)
        for (size_t t = 0; t < half.alpha_test.meshes[i].size(); ++t)
            if (half.alpha_test.meshes[i][t]) rest.meshes[i].triangles[t] = {0, 0, 0};  // a point
    rest.spheres.clear();
    const auto some = GetParam()(half), expected = GetParam()(rest);
    Random random(500);
    int hits = 0;
    for (int i = 0; i < 10000; ++i) {
        const Ray ray = random_ray(random, half);
        ASSERT_FALSE(nothing->closest(ray)) << i;
        ASSERT_FALSE(nothing->any(ray)) << i;
        const Hit a = some->closest(ray), b = expected->closest(ray);
        ASSERT_TRUE(same_bits(a, b) || explainable(half, ray, a, b)) << i;
        hits += a ? 1 : 0;
    }
    EXPECT_GT(hits, 1000);
}

// Of equals the first wins that stops the ray.
TEST_P(HoleLaws, TiesGoToTheFirstThatStops)
{
    Geometry g;
    for (int i = 0; i < 8; ++i) g.spheres.push_back({{0.1, 0.2, 0.3}, 1});
    g = with_holes(std::move(g),
                   [](const void*, const Ray& ray, const Hit& hit) { return hit.exit || hit.primitive < ray.key; });
    const auto accel = GetParam()(g);
    Random random(600);
    for (int i = 0; i < 4000; ++i) {
        std::array<Ray, 8> rays;
        std::array<Hit, 8> hits;
        for (Ray& r : rays) {
            const Vec3d center = g.spheres[0].center;
            const Vec3 org = to_float(center + random.direction() * 2.0);
            r = {
                .org = org, .dir = normalize(to_float(center + random.point(-0.5, 0.5)) - org), .key = random.below(9)};
        }
        accel->closest(rays, hits, Coherence::incoherent);
        for (size_t k = 0; k < 8; ++k) {
            ASSERT_EQ(static_cast<bool>(hits[k]), rays[k].key < 8);
            ASSERT_TRUE(!hits[k] || hits[k].primitive == rays[k].key);
            ASSERT_TRUE(same_bits(hits[k], accel->closest(rays[k])));
        }
    }
}

// Instruction sets take packets apart in their own ways; the filter must get the right ray in each.
TEST(HoleLawsOfEmbree, AreTheSameForEveryInstructionSet)
{
    const Geometry g = with_holes(random_geometry(51), half_of_all);
    const auto list = make_accelerator(AccelKind::list, g, "");
    Random random(700);
    std::vector<Ray> rays(4000);
    for (Ray& r : rays) r = keyed(random_ray(random, g), random);
    for (const char* isa : {"sse2", "sse4.2", "avx", "avx2"}) {
        const auto accel = make_accelerator(AccelKind::embree, g, isa);
        std::vector<Hit> hits(rays.size());
        std::vector<uint8_t> occluded(rays.size());
        accel->closest(rays, hits, Coherence::coherent);
        accel->any(rays, occluded);
        for (size_t i = 0; i < rays.size(); ++i) {
            const Hit expected = list->closest(rays[i]);
            ASSERT_TRUE(same_bits(expected, hits[i]) || explainable(g, rays[i], expected, hits[i])) << isa << " " << i;
            ASSERT_TRUE(!same_primitive(expected, hits[i]) || (occluded[i] != 0) == static_cast<bool>(expected)) << isa;
        }
    }
}

}  // namespace
}  // namespace lancer
