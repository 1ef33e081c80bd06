// What lights send to a place, against closed forms; and that nothing but other things stands between.
#include <gtest/gtest.h>

#include "integrators/path/transport.h"
#include "support/rasters.h"
#include "support/scenes/lit_places.h"

namespace lancer {
namespace {

// E = pi L (r / d)^2 for a place that faces the centre, from all but touching to a speck.
TEST(SphereLight, IrradianceIsThatOfItsSolidAngle)
{
    for (const double ratio : {1.0001, 1.1, 2.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6}) {
        const Scene scene = sphere_at(ratio, 1);
        const Surface from = receiver(to_float(scene.normalisation.to_scene({0, 0, 0})), {0, 1, 0});
        Random random(1);
        const stats::Tally e = irradiance(scene, from, 512, random);
        const double expected = std::numbers::pi * 2 / (ratio * ratio);
        EXPECT_NEAR(e.mean / expected, 1, std::max(1e-5, 4 * e.error() / expected)) << ratio;
        EXPECT_LE(e.error() / expected, 2e-3) << ratio << ": too noisy to tell";
    }
}

// All of the sampled points are on the near side, where nothing of the sphere itself is in the way.
TEST(SphereLight, SampledPointsAreSeen)
{
    for (const double ratio : {1.0001, 1.1, 2.0, 10.0, 1e2, 1e4, 1e6}) {
        SceneDescription d;
        const Vec3d w = normalize(Vec3d{0.3, 0.9, -0.4});
        d.lights.push_back(light_of(LightType::sphere, {2, 2, 2}, w * ratio, 1));
        d.meshes.push_back(triangle_mesh(w * 1e-3, w * 1e-3 + Vec3d{1e-3, 0, 0}, w * 1e-3 + Vec3d{0, 0, 1e-3}, {}));
        d.meshes[0].data = triangle_mesh({0, -1, 0}, {1e-3, -1, 0}, {0, -1, 1e-3}, {}).data;
        const Stage stage(d);
        const Surface from = receiver(stage.to_scene({0, 0, 0}), to_float(w));
        const Vec3d center = stage.scene.geometry.spheres[0].center;
        Random random(2);
        int hidden = 0, far_side = 0;
        for (int i = 0; i < 20000; ++i) {
            const float u = i % 100 ? random.unit() : 1 - 0x1p-24f;  // the very rim, too
            const auto s = sample_light(stage.scene, from, 0, {u, random.unit()});
            ASSERT_TRUE(s) << ratio;
            ASSERT_TRUE(std::isfinite(s->pdf) && s->pdf > 0) << ratio;
            ASSERT_NEAR(length(to_double(s->point) - center) / stage.scene.geometry.spheres[0].radius, 1,
                        2e-7 * std::max(1.0, ratio));
            // The near side is where the normal points this way; a point has the rounding of its coordinates.
            far_side += dot(to_double(s->n), normalize(to_double(s->point) - to_double(from.p))) > 1e-6 * ratio;
            if (dot(s->wi, from.n) <= 0) continue;
            const Ray shadow = shadow_ray(from, *s);
            ASSERT_TRUE(is_traceable(shadow)) << ratio;
            hidden += stage.list.any(shadow) + stage.embree->any(shadow);
        }
        EXPECT_EQ(hidden, 0) << ratio;
        EXPECT_EQ(far_side, 0) << ratio;
    }
}

TEST(SphereLight, IsDarkInside)
{
    SceneDescription d;
    d.lights.push_back(light_of(LightType::sphere, {2, 2, 2}, {0, 0, 0}, 1));
    const Stage stage(d);
    const Surface from = receiver({0.1f, 0.2f, 0}, {0, 1, 0});
    for (int i = 0; i < 100; ++i) EXPECT_FALSE(sample_light(stage.scene, from, 0, {static_cast<float>(i) / 100, 0.3f}));
    EXPECT_TRUE(is_black(stage.scene.emission[stage.scene.sphere_material[0]].towards(false, {})));
}

TEST(TriangleLight, IrradianceIsLambertsFormula)
{
    stats::Family family;
    Random random(3);
    for (int i = 0; i < 40; ++i) {
        // Above the horizon of the place; from near to far, turned any way, slivers too.
        const double height = i % 4 == 0 ? 0.05 : i % 4 == 1 ? 1 : i % 4 == 2 ? 5 : 100;
        std::array<Vec3d, 3> corner;
        for (Vec3d& c : corner) c = Vec3d{0, height * 1.5, 0} + random.point(-1, 1) * std::min(1.0, height);
        if (i % 5 == 0) corner[2] = corner[0] * 0.501 + corner[1] * 0.499 + Vec3d{0, 1e-3 * height, 0};
        MaterialDescription lamp = make_emitter("lamp", {2, 2, 2});
        lamp.emission_both_sides = true;
        SceneDescription d;
        d.meshes.push_back(triangle_mesh(corner[0], corner[1], corner[2], lamp));
        if (i % 2) {
            d.meshes[0].name = "t";
            d.instances.push_back(instance_of("t", {{0.1, 0.2, 0.3}, {0, 0, 0}, {1, 1, 1}}));
            for (Vec3d& c : corner) c += Vec3d{0.1, 0.2, 0.3};
        }
        d.spheres.push_back(sphere_of({0, 0, 0}, 0.01 * height));
        const Scene scene = build_scene(d);
        const Surface from = receiver(to_float(scene.normalisation.to_scene({0, 0, 0})), {0, 1, 0});
        const stats::Tally e = irradiance(scene, from, 128, random);
        // A triangle's corners are stored in float: what that does to its area.
        family.add(stats::mean_p(e, 2 * lambert({0, 0, 0}, {0, 1, 0}, corner), i % 5 == 0 ? 1e-3 : 1e-5),
                   "triangle " + std::to_string(i));
    }
}

TEST(TriangleLight, SampledPointsAreSeen)
{
    for (const double distance : {1e-3, 0.1, 1.0, 100.0, 1e5})
        for (const bool instanced : {false, true}) {
            MaterialDescription lamp = make_emitter("lamp", {2, 2, 2});
            lamp.emission_both_sides = true;
            SceneDescription d;
            d.meshes.push_back(triangle_mesh({-0.5, 0.1, -0.3}, {0.6, 0, -0.4}, {0.1, 0.05, 0.7}, lamp));
            if (instanced) {
                d.meshes[0].name = "t";
                d.instances.push_back(instance_of("t", {{0.2, 0.1, 0.3}, {20, 30, 40}, {2, -0.7, 0.5}}));
            }
            const Stage stage(d);
            Random random(4);
            int hidden = 0, tried = 0;
            for (int i = 0; i < 50000; ++i) {
                const Vec3d at = random.direction() * (1 + distance);
                const Vec3 p = stage.to_scene(instanced ? at + Vec3d{0.2, 0.1, 0.3} : at);
                const Surface from = receiver(p, -to_float(normalize(at)));
                const auto s = sample_light(stage.scene, from, random.unit(), random.unit2());
                if (!s || dot(s->wi, from.n) <= 0) continue;
                // A point whose own rounding is larger than its distance from the plane of the triangle is in it.
                if (std::abs(dot(s->wi, s->n)) < 1e-3f) continue;
                ++tried;
                const Ray shadow = shadow_ray(from, *s);
                hidden += stage.list.any(shadow) + stage.embree->any(shadow);
            }
            EXPECT_EQ(hidden, 0) << distance << instanced << ", of " << tried;
            EXPECT_GT(tried, 20000) << distance;
        }
}

TEST(TriangleLight, EmitsFromItsFrontOrFromBothSides)
{
    for (const bool both : {false, true}) {
        MaterialDescription lamp = make_emitter("lamp", {2, 2, 2});
        lamp.emission_both_sides = both;
        SceneDescription d;
        d.meshes.push_back(triangle_mesh({0, 0, 1}, {1, 0, -1}, {-1, 0, -1}, lamp));
        const Scene scene = build_scene(d);
        const Vec2 u{0.3f, 0.4f};
        const auto front = sample_light(scene, receiver({0, 1, 0}, {0, -1, 0}), 0, u);
        ASSERT_TRUE(front);
        EXPECT_EQ(front->radiance, (Color{2, 2, 2}));
        EXPECT_EQ(sample_light(scene, receiver({0, -1, 0}, {0, 1, 0}), 0, u).has_value(), both);
        // In its own plane it is not seen at all.
        EXPECT_FALSE(sample_light(scene, receiver({5, 0, 0}, {-1, 0, 0}), 0, u));
    }
}

TEST(PointLight, IntensityOverDistanceSquared)
{
    SceneDescription d;
    d.spheres.push_back(sphere_of({0, 0, 0}, 3));
    d.lights.push_back(light_of(LightType::point, {1, 10, 100}, {0, 20, 0}));
    const Scene scene = build_scene(d);
    const auto s =
        sample_light(scene, receiver(to_float(scene.normalisation.to_scene({0, 4, 0})), {0, 1, 0}), 0.7f, {});
    ASSERT_TRUE(s);
    EXPECT_TRUE(s->delta);
    EXPECT_EQ(s->pdf, 1);
    EXPECT_LE(length(s->wi - Vec3{0, 1, 0}), 1e-6f);
    EXPECT_NEAR(s->radiance.r, 1 / 256.0, 1e-6 / 256);
    EXPECT_NEAR(s->radiance.b, 100 / 256.0, 1e-4 / 256);
}

TEST(SpotLight, FadesFromOneAngleToTheOther)
{
    SceneDescription d;
    d.spheres.push_back(sphere_of({0, 0, 0}, 3));
    LightDescription spot = light_of(LightType::spot, {16, 32, 64}, {0, 8, 0});
    spot.direction = {0, -5, 0}, spot.inner_deg = 20, spot.outer_deg = 60;
    d.lights.push_back(spot);
    const Scene scene = build_scene(d);
    const auto seen = [&](double deg) {
        const double angle = deg * std::numbers::pi / 180;
        const Vec3d at{8 * std::sin(angle), 8 - 8 * std::cos(angle), 0};
        return sample_light(scene, receiver(to_float(scene.normalisation.to_scene(at)), {0, 1, 0}), 0.7f, {});
    };
    const double inner = std::cos(std::numbers::pi / 9), outer = 0.5;
    for (const double deg : {0.0, 19.0, 30.0, 45.0, 59.0}) {
        const double part = std::clamp((std::cos(deg * std::numbers::pi / 180) - outer) / (inner - outer), 0.0, 1.0);
        const auto s = seen(deg);
        ASSERT_TRUE(s) << deg;
        EXPECT_TRUE(s->delta);
        EXPECT_NEAR(s->radiance.r, 0.25 * part * part, 1e-6) << deg;
        EXPECT_NEAR(s->radiance.b, part * part, 4e-6) << deg;
    }
    EXPECT_FALSE(seen(61));
    EXPECT_FALSE(seen(170));
    // Its power is the integral of what it sends.
    const auto& light = std::get<SpotLight>(scene.delta_lights[0]);
    double sum = 0;
    constexpr int steps = 100000;
    for (int i = 0; i < steps; ++i) {
        const double cos = (i + 0.5) / steps, sin = std::sqrt(1 - cos * cos);
        sum += static_cast<double>(light.fade(to_float(Vec3d{sin, -cos, 0}))) * 2 * std::numbers::pi / steps;
    }
    const Color c = light.intensity;
    EXPECT_NEAR(light.power(0), sum * luminance(double{c.r}, double{c.g}, double{c.b}), 1e-3 * light.power(0));
}

// However narrow the cone, its middle has the whole intensity; angles of one size make a sharp edge.
TEST(SpotLight, MayBeNarrowAndSharp)
{
    LightDescription narrow = light_of(LightType::spot, {1, 1, 1}, {0, 0, 0});
    narrow.inner_deg = 0, narrow.outer_deg = 0.05;
    EXPECT_EQ(SpotLight::make(narrow, {}).fade({0, -1, 0}), 1);
    narrow.inner_deg = narrow.outer_deg = 30;
    const SpotLight sharp = SpotLight::make(narrow, {});
    const auto at = [&](double deg) {
        const double angle = deg * std::numbers::pi / 180;
        return sharp.fade(to_float(Vec3d{std::sin(angle), -std::cos(angle), 0}));
    };
    EXPECT_EQ(at(29.99), 1);
    EXPECT_EQ(at(30.01), 0);
}

TEST(DirectionalLight, IsADirectionAndAnIrradiance)
{
    // Lengths of directions do not matter, however extreme.
    for (const double size : {1.0, 1e-200, 1e200}) {
        SceneDescription d;
        d.spheres.push_back(sphere_of({0, 0, 0}, 3));
        d.lights = {directional_of({1, 10, 100}, Vec3d{1, -2, 2} * size)};
        const Scene scene = build_scene(d);
        const auto s = sample_light(scene, receiver({0, 1, 0}, {0, 1, 0}), 0.7f, {0.3f, 0.9f});
        ASSERT_TRUE(s);
        EXPECT_TRUE(s->delta && s->infinite);
        EXPECT_EQ(s->pdf, 1);
        EXPECT_LE(length(s->wi - Vec3{-1, 2, -2} / 3.0f), 1e-7f);
        EXPECT_EQ(s->radiance, (Color{1, 10, 100}));
        EXPECT_FALSE(sample_light(scene, receiver({0, -1, 0}, {0, -1, 0}), 0.7f, {}));
        EXPECT_TRUE(sample_light(scene, receiver({0, -1, 0}, {0, -1, 0}), 0.7f, {}, true));
    }
}

// What falls on a disk as large as the scene is what lights from infinitely far away are weighed by.
TEST(Lights, FromInfinityAreChosenByWhatTheSceneReceives)
{
    SceneDescription d;
    d.spheres.push_back(sphere_of({0, 0, 0}, 3));
    d.lights = {light_of(LightType::point, {1, 1, 1}, {0, 20, 0}), directional_of({2, 2, 2}, {0, -1, 0}),
                sky_map_of({0.5f, 0.5f, 0.5f}), sky_of({0.1f, 0.1f, 0.1f})};
    d.render.mis_compensation = false;
    const Scene scene = build_scene(d, picture_source(make_raster(8, 4, [](uint32_t, uint32_t) {
                                        return Color{1, 1, 1};
                                    })));
    const double disk = std::numbers::pi * 27;  // of the sphere's bounding box
    const std::array<double, 3> power{4 * std::numbers::pi, disk * 2, disk * 4 * std::numbers::pi * 0.6};
    for (uint32_t i = 0; i < 3; ++i)
        EXPECT_NEAR(scene.lights.pick.probability(i), power[i] / (power[0] + power[1] + power[2]), 1e-6) << i;
}

// Ten thousand lights of powers from 1 to 1e8: those rarer than any number of 24 bits get their samples too.
TEST(Lights, ManyOfVeryDifferentPower)
{
    SceneDescription d;
    d.spheres.push_back(sphere_of({0, 0, 0}, 1));
    Random random(6);
    double expected = 0;
    for (int i = 0; i < 10000; ++i) {
        const Vec3d at = Vec3d{0, 3, 0} + random.point(-0.5, 0.5);
        const double r2 = dot(at, at), intensity = i % 2 ? std::pow(10.0, random.uniform(0, 8)) : 1;
        const auto power = static_cast<float>(intensity);
        d.lights.push_back(light_of(LightType::point, {power, power, power}, at));
        expected += static_cast<double>(power) * at.y / (r2 * std::sqrt(r2));
    }
    const Scene scene = build_scene(d);
    double sum = 0, least = 1;
    for (uint32_t i = 0; i < 10000; ++i) {
        const auto p = static_cast<double>(scene.lights.pick.probability(i));
        sum += p, least = std::min(least, p);
    }
    EXPECT_NEAR(sum, 1, 1e-6);
    EXPECT_LT(least, 0x1p-28);
    const Surface from = receiver(to_float(scene.normalisation.to_scene({0, 0, 0})), {0, 1, 0});
    stats::Tally all;
    for (int i = 0; i < 500000; ++i) {
        const float pick = random.unit();
        const auto s = sample_light(scene, from, pick, random.unit2());
        ASSERT_TRUE(s);
        all.add(static_cast<double>(s->radiance.r * dot(s->wi, from.n) / s->pdf));
    }
    EXPECT_LE(all.error() / all.mean, 1e-3);
    EXPECT_GE(stats::mean_p(all, expected, 1e-5), claim_level);
}

// A pattern that the estimate of a textured emitter's power cannot see: never chosen would be never lit.
TEST(TriangleLight, TexturesDecideItsPowerButNeverRuleItOut)
{
    const auto lamp = [](Vec2 scale, Color even, Color odd) {
        MaterialDescription m = make_emitter("lamp", {2, 2, 2});
        m.emission_map = TextureDescription{
            .where = {}, .type = TextureType::checker, .file = {}, .use = {.scale = scale}, .even = even, .odd = odd};
        MeshData data = *make_mesh_data({{0, 0, 1}, {1, 0, -1}, {-1, 0, -1}}, {{0, 1, 2}}, m);
        data.uvs = {{0, 0}, {0.999f, 0}, {0, 0.999f}};
        data.uv_triangles = {{0, 1, 2}};
        return make_mesh(std::make_shared<const MeshData>(data));
    };
    const Color white{1, 1, 1}, half{0.5f, 0.5f, 0.5f};
    SceneDescription d;
    d.meshes = {lamp({1, 1}, white, {}), lamp({1, 1}, half, {}), lamp({1, 1}, {}, white), lamp({4, 1}, white, {})};
    const Scene scene = build_scene(d);
    const auto p = [&](uint32_t i) { return scene.lights.pick.probability(i); };
    EXPECT_NEAR(p(1) / p(0), 0.5, 1e-6);
    EXPECT_NEAR(p(2) / p(0), 0.01, 1e-6) << "dark all over: the least there is";
    // Columns of widths 7, 5, 3 and 1 sixteenths, every other one lit.
    EXPECT_NEAR(p(3) / p(0), 10 / 16.0, 1e-6);
}

// How often each light is chosen is its share of the power, and what sample_light() divides by.
TEST(Lights, AreChosenByPower)
{
    SceneDescription d;
    d.lights = {light_of(LightType::point, {1, 1, 1}, {0, 3, 0}),
                light_of(LightType::sphere, {0.5f, 0.5f, 0.5f}, {2, 0, 0}, 0.5),
                light_of(LightType::point, {1e-3f, 1e-3f, 1e-3f}, {0, -3, 0})};
    MaterialDescription lamp = make_emitter("lamp", {0.3f, 0.3f, 0.3f});
    d.meshes.push_back(triangle_mesh({0, 0, -2}, {2, 0, -2}, {0, 2, -2}, lamp));
    lamp.emission_both_sides = true;
    d.meshes.push_back(triangle_mesh({0, 0, 2}, {2, 0, 2}, {0, 2, 2}, lamp));
    const Scene scene = build_scene(d);
    ASSERT_EQ(scene.lights.lights.size(), 5u);
    // Powers in file units: point 4 pi I, sphere 4 pi r^2 pi L, triangle A pi L.
    const double pi_d = std::numbers::pi;
    double total = 0;
    std::vector<double> power;
    for (const Light& l : scene.lights.lights) {
        if (const auto* p = std::get_if<PointLight>(&l)) {
            power.push_back(4 * pi_d * (p->position.y > 0 ? 1 : 1e-3));
        } else if (std::holds_alternative<SphereLight>(l)) {
            power.push_back(4 * pi_d * 0.25 * pi_d * 0.5);
        } else {
            power.push_back(2 * pi_d * 0.3 * (std::get<TriangleLight>(l).mesh == 1 ? 2 : 1));
        }
        total += power.back();
    }
    std::vector<uint64_t> count(5);
    std::vector<double> expected;
    for (uint32_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(scene.lights.pick.probability(i), power[i] / total, 1e-6);
        expected.push_back(1e6 * power[i] / total);
    }
    Random random(5);
    for (int i = 0; i < 1000000; ++i) ++count[scene.lights.pick.sample(random.unit())];
    EXPECT_GT(chi_square_test(count, expected).p, claim_level);
    // The choice is in the density.
    const auto s = sample_light(scene, receiver({0, 0, 0}, {0, 1, 0}), 0, {});
    ASSERT_TRUE(s && s->delta);
    EXPECT_EQ(s->pdf, scene.lights.pick.probability(0));
}

}  // namespace
}  // namespace lancer
