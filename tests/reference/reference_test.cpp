// The judge, judged: by closed forms and by its own laws.
#include "reference/reference.h"

#include <gtest/gtest.h>

#include <deque>

#include "reference/judged_scenes.h"
#include "reference/walk.h"
#include "support/statistics/significance.h"

namespace lancer {
namespace {

using reference::Bsdf;
using reference::Random;
using reference::Vec;

// Luminance of all samples of all pixels.
stats::Tally whole(const reference::Picture& p)
{
    stats::Tally t;
    for (size_t i = 0; i < p.mean.size(); ++i) {
        t.mean += luminance(p.mean[i]) / static_cast<double>(p.mean.size());
        t.m2 += p.variance[i];
    }
    t.n = static_cast<double>(p.mean.size());
    t.m2 *= (t.n - 1) / t.n;  // so that error() is that of the mean of the pixels
    return t;
}

// Every way of scattering, smooth and rough.
std::vector<std::pair<std::string, Bsdf>> lobes(std::deque<reference::CoatAlbedo>& coats)
{
    std::vector<std::pair<std::string, Bsdf>> all;
    const auto add = [&](const char* name, Bsdf::Kind kind) -> Bsdf& {
        all.emplace_back(name, Bsdf{});
        all.back().second.kind = kind;
        all.back().second.color = {0.9, 0.6, 0.3};
        return all.back().second;
    };
    add("lambert", Bsdf::Kind::lambert);
    Bsdf& leaf = add("translucent", Bsdf::Kind::translucent);
    leaf.diffuse = {0.5, 0.2, 0.1}, leaf.through = {0.1, 0.6, 0.3};
    for (const double alpha : {0.1, 0.6}) {
        add("metal", Bsdf::Kind::metal).alpha = alpha;
        Bsdf& copper = add("copper", Bsdf::Kind::metal);
        copper.alpha = alpha;
        copper.conductor = std::array<reference::Rgb, 2>{{{0.2, 0.92, 1.1}, {3.91, 2.45, 2.14}}};
        for (const double index : {1.5, 1 / 1.5, 2.4}) {
            Bsdf& glass = add("glass", Bsdf::Kind::glass);
            glass.alpha = alpha, glass.index = index;
        }
        for (const double index : {1.5, 2.4}) {
            Bsdf& sheet = add("sheet", Bsdf::Kind::sheet);
            sheet.alpha = alpha, sheet.index = index;
        }
        Bsdf& plastic = add("plastic", Bsdf::Kind::plastic);
        plastic.alpha = alpha, plastic.index = 1.5, plastic.coat = {1, 0.8, 0.9};
        plastic.coat_albedo = &coats.emplace_back(1.5, alpha);
    }
    Bsdf& phong = add("interface", Bsdf::Kind::interface);
    phong.diffuse = {0.3, 0.2, 0.1}, phong.gloss = {0.2, 0.3, 0.4}, phong.mirror = {0.1, 0.2, 0.1}, phong.shininess = 9;
    return all;
}

// What is sampled and what eval() says are one thing: both give the same integrals against a function of wi.
TEST(Reference, SamplesWhatItEvaluates)
{
    std::deque<reference::CoatAlbedo> coats;
    stats::Family family;
    uint64_t stream = 0;
    for (const auto& [name, bsdf] : lobes(coats))
        for (const double cos : {0.95, 0.5, 0.2}) {
            Random random(11, ++stream, 0);
            const Vec wo{std::sqrt(1 - cos * cos), 0, cos};
            const auto probe = [](Vec wi) { return 1 + 0.7 * wi.x - 0.5 * wi.y + (wi.z > 0 ? 0.4 : -0.3) * wi.z; };
            stats::Tally sampled, evaluated;
            for (int i = 0; i < 40000; ++i) {
                const auto s = bsdf.sample(wo, random);
                sampled.add(s && !s->delta ? luminance(s->weight) * probe(s->wi) : 0);
                const double z = 2 * random.next() - 1, turn = 2 * reference::pi * random.next(),
                             r = std::sqrt(1 - z * z);
                const Vec wi{r * std::cos(turn), r * std::sin(turn), z};
                evaluated.add(luminance(bsdf.eval(wo, wi)) * probe(wi) * 4 * reference::pi);
            }
            family.add(stats::welch_p(sampled, evaluated), name + " at cos " + std::to_string(cos) + ": " +
                                                               std::to_string(sampled.mean) + ", " +
                                                               std::to_string(evaluated.mean));
        }
}

// What loses nothing is not seen in a constant sky.
TEST(Reference, SeesNoneOfWhatLosesNothing)
{
    for (const MaterialType type :
         {MaterialType::lambert, MaterialType::mirror, MaterialType::glass, MaterialType::plastic}) {
        SceneDescription d;
        d.materials = {make_glossy("ball", type, {1, 1, 1}, type == MaterialType::plastic ? 0.6f : 0)};
        d.spheres = {sphere_of({0, 0, 0}, 1, "ball")};
        d.lights = {sky_of({1, 1, 1})};
        d.camera = make_camera({0, 0, 3}, {0, 0, 0}, 30);
        const stats::Tally t = whole(reference::render(d, {.width = 8, .height = 8, .spp = 256, .seed = 3}));
        EXPECT_NEAR(t.mean, 1, 1e-9 + 4 * t.error()) << static_cast<int>(type);
        EXPECT_LT(t.error(), 0.01);
    }
}

// A plane below a ball of radiance L and radius r, whose middle is h above: E = pi L (r / h)^2.
TEST(Reference, LightsAPlaneByABallAsTheFormulaSays)
{
    SceneDescription d;
    d.materials = {make_lambert("floor", {0.5f, 0.5f, 0.5f})};
    d.planes = {plane_of({0, 0, 0}, {0, 1, 0}, "floor")};
    d.lights = {light_of(LightType::sphere, {2, 2, 2}, {0, 3, 0}, 1)};
    d.camera = make_camera({2, 1, 0}, {0, 0, 0}, 0.01);
    const stats::Tally t = whole(reference::render(d, {.width = 8, .height = 8, .spp = 2000}));
    EXPECT_NEAR(t.mean, 0.5 * 2 / 9, 4 * t.error());
    EXPECT_LT(t.error(), 0.02 * t.mean);
    d.lights = {light_of(LightType::point, {2, 2, 2}, {0, 3, 0})};
    const stats::Tally point = whole(reference::render(d, {.width = 8, .height = 8, .spp = 1}));
    EXPECT_NEAR(point.mean, 0.5 / reference::pi * 2 / 9, 1e-6);
}

TEST(Reference, LetsNoRayThroughAClosedMesh)
{
    SceneDescription d;
    d.meshes = {make_mesh(make_uv_sphere(8, 12, 0.2), {{1e4, -3, 7}, {10, 20, 30}, {1, 2, 0.5}})};
    const reference::World world(d, {});
    Random random(1, 2, 3);
    const Vec middle{1e4, -3, 7};
    for (int i = 0; i < 20000; ++i) {
        // Towards a corner, the middle of an edge, anywhere.
        const reference::Triangle& t =
            world.triangles[static_cast<size_t>(random.next() * 10000) % world.triangles.size()];
        const double u = i % 3 == 0 ? 0 : i % 3 == 1 ? 0.5 : random.next();
        const Vec at = t.a * (1 - u) + t.b * u, org = middle + Vec{0.1 * random.next(), 0, 0.1 * random.next()};
        const reference::Ray ray{org, unit(at - org)};
        const reference::Hit hit = closest(world, ray);
        ASSERT_TRUE(hit) << i;
        EXPECT_NEAR(hit.t, norm(at - org), 1e-9);
    }
}

TEST(Reference, MeetsSpheresAndPlanesWhereTheyAre)
{
    SceneDescription d;
    d.spheres = {sphere_of({0, -1e5, 0}, 1e5), sphere_of({0, 3, 0}, 1)};
    d.planes = {plane_of({0, 0, -2}, {0, 0, 5})};
    const reference::World world(d, {});
    // On the huge one at (0, 0, 0); from there up to the small one, through it, and to the plane.
    const reference::Hit ground = closest(world, {{0, 0.5, 0}, {0, -1, 0}});
    EXPECT_NEAR(ground.t, 0.5, 1e-13);
    const reference::Hit below = closest(world, {{0, 0, 0}, {0, 1, 0}}, ground.shape);
    EXPECT_NEAR(below.t, 2, 1e-14);
    const reference::Hit above = closest(world, {{0, 2, 0}, {0, 1, 0}}, below.shape);
    EXPECT_EQ(above.shape, below.shape);
    EXPECT_NEAR(above.t, 2, 1e-14);
    EXPECT_NEAR(closest(world, {{0, 5, 0}, {0, 0, -1}}).t, 2, 1e-15);
    EXPECT_FALSE(closest(world, {{0, 5, 0}, {0, 0, -1}}, {}, 1.9));
}

TEST(Reference, HasTheSameNumbersForAnyThreads)
{
    const SceneDescription d = mirrors_scene();
    const reference::Picture one = reference::render(d, {.spp = 4, .threads = 1});
    const reference::Picture three = reference::render(d, {.spp = 4, .threads = 3});
    const reference::Picture other = reference::render(d, {.spp = 4, .seed = 2, .threads = 1});
    for (size_t i = 0; i < one.mean.size(); ++i) {
        EXPECT_EQ(one.mean[i].r, three.mean[i].r);
        EXPECT_EQ(one.variance[i], three.variance[i]);
    }
    EXPECT_NE(whole(one).mean, whole(other).mean);
}

TEST(Reference, SaysWhatItDoesNotKnow)
{
    SceneDescription d = cornell_scene();
    d.render.terminator = true;
    EXPECT_THROW(reference::render(d, {}), std::invalid_argument);
    d = cornell_scene();
    d.camera.reset();
    EXPECT_THROW(reference::render(d, {}), std::invalid_argument);
}

}  // namespace
}  // namespace lancer
