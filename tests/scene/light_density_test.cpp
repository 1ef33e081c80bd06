// Densities of light sampling: what sample_light() says of a direction is what pdf_light() says of the light found
// there, and all directions together have probability 1. Both must agree for the weights of multiple importance
// sampling to sum to 1.
#include <gtest/gtest.h>

#include "integrators/path/transport.h"
#include "support/random.h"
#include "support/rasters.h"
#include "support/stage.h"
#include "support/statistics/significance.h"

namespace lancer {
namespace {

const MaterialDescription front_lamp = make_emitter("front", {3, 2, 1});
MaterialDescription both_lamp()
{
    MaterialDescription m = make_emitter("both", {3, 2, 1});
    m.emission_both_sides = true;
    return m;
}

struct LitScene {
    std::string name;
    SceneDescription description;
    Vec3d near;  // a receiver stands within `around` of this place, file units
    double around = 0.3;
    RasterSource images{};
};

// The corners of the triangle span the texture; a checker that is dark in places.
MeshDescription textured(MeshDescription mesh)
{
    MeshData data = *mesh.data;
    data.uvs = {{0, 0}, {1, 0}, {0.3f, 1}};
    data.uv_triangles = {{0, 1, 2}};
    data.materials[0].emission_map = TextureDescription{.where = {},
                                                        .type = TextureType::checker,
                                                        .file = {},
                                                        .use = {.scale = {5, 3}},
                                                        .even = {0.2f, 1, 0.4f},
                                                        .odd = {}};
    mesh.data = std::make_shared<const MeshData>(data);
    return mesh;
}

Color sky_texel(uint32_t x, uint32_t y)
{
    const auto c = static_cast<float>(1 + (7 * x + 3 * y) % 5);
    return Color{c, 0.5f * c, 2};
}
RasterSource sky_picture() { return picture_source(make_raster(16, 8, sky_texel)); }
RasterSource sunny_picture()
{
    return picture_source(make_raster(16, 8, [](uint32_t x, uint32_t y) {
        return x == 5 && y == 2 ? Color{300, 200, 100} : sky_texel(x, y);
    }));
}

std::vector<LitScene> lit_scenes()
{
    std::vector<LitScene> all;
    const auto add = [&](const std::string& name, Vec3d near, double around) -> SceneDescription& {
        all.push_back({name, {}, near, around, {}});
        return all.back().description;
    };
    const auto triangle = [](MaterialDescription m) {
        return triangle_mesh({-0.5, 1, -0.3}, {0.6, 1.1, -0.4}, {0.1, 1.2, 0.7}, std::move(m));
    };
    add("triangle, its back", {0, 2, 0}, 0.3).meshes.push_back(triangle(both_lamp()));
    add("triangle, its front", {0, 0, 0}, 0.3).meshes.push_back(triangle(front_lamp));
    add("triangle, afar", {30, -20, -10}, 1).meshes.push_back(triangle(front_lamp));
    {
        SceneDescription& d = add("mirrored instance", {0, 0, 0}, 0.3);
        d.meshes.push_back(triangle(both_lamp()));
        d.meshes[0].name = "t";
        d.instances.push_back(instance_of("t", {{0.2, 0.3, 0}, {20, 30, 40}, {2, -0.7, 0.5}}));
        d.instances.push_back(instance_of("t", {{0, 3, 0.4}, {0, 90, 0}, {1, 1, 1}}));
    }
    add("mesh", {0, 3, 0}, 0.5).meshes.push_back(make_mesh(make_uv_sphere(6, 12, 0, front_lamp)));
    add("sphere", {0, 0, 0}, 0.5).lights.push_back(light_of(LightType::sphere, {1, 1, 1}, {0, 3, 0}, 1));
    add("sphere, afar", {0, 0, 0}, 0.5).lights.push_back(light_of(LightType::sphere, {1, 1, 1}, {0, 3000, 0}, 1));
    {
        SceneDescription& d = add("inside a sphere", {0, 0, 0}, 0.5);
        d.materials = {both_lamp()};
        d.spheres.push_back(sphere_of({0, 0, 0}, 1, "both"));
    }
    add("sky", {0, 0, 0}, 0.5).lights.push_back(sky_of({1, 1, 1}));
    add("sky map", {0, 0, 0}, 0.5).lights = {sky_map_of({1, 1, 1}, {20, 30, 40}), sky_of({0.1f, 0.2f, 0.3f})};
    all.back().images = sky_picture();
    all.back().description.render.mis_compensation = false;  // else nothing of it is bright enough
    add("sky map with a sun", {0, 0, 0}, 0.5).lights = {sky_map_of({1, 1, 1})};
    all.back().images = sunny_picture();
    {
        SceneDescription& d = add("textured sphere", {0, 0, 0}, 0.5);
        d.materials = textured(triangle(both_lamp())).data->materials;
        d.spheres.push_back(sphere_of({0, 0, 0}, 1, "both"));
    }
    add("textured triangle", {0, 2, 0}, 0.3).meshes.push_back(textured(triangle(both_lamp())));
    {
        SceneDescription& d = add("all kinds", {0, 0, 0}, 0.3);
        all.back().images = sky_picture();
        d.meshes.push_back(triangle(both_lamp()));
        d.lights = {light_of(LightType::sphere, {1, 2, 1}, {2, 0, 0}, 0.5),
                    light_of(LightType::sphere, {5, 2, 1}, {-2, 0, 1}, 0.3), sky_map_of({0.1f, 0.1f, 0.1f}),
                    light_of(LightType::point, {1, 1, 1}, {0, -3, 0}), directional_of({2, 2, 2}, {1, -2, 3})};
    }
    return all;
}

Surface place_in(const Stage& stage, const LitScene& lit, Random& random)
{
    return receiver(stage.to_scene(lit.near + random.point(-lit.around, lit.around)), random.unit_vector());
}

// Where rays that leave the place start.
Vec3 start_of(const Surface& s, Vec3 w) { return offset_origin(s.p, s.p_error, s.n, w); }

TEST(LightDensity, IsThatOfThePlaceFound)
{
    for (const LitScene& lit : lit_scenes()) {
        const Stage stage(lit.description, lit.images);
        Random random(11);
        int sampled = 0, found = 0;
        for (int i = 0; i < 20000; ++i) {
            const Surface from = place_in(stage, lit, random);
            const float pick = random.unit();
            const auto s = sample_light(stage.scene, from, pick, random.unit2());
            if (!s) continue;
            ASSERT_GT(dot(s->wi, from.n), 0) << lit.name << ": from below";
            if (s->delta) continue;
            ASSERT_NEAR(length(s->wi), 1, gamma(8)) << lit.name;
            ASSERT_TRUE(std::isfinite(s->pdf) && s->pdf > 0) << lit.name;
            ++sampled;
            const Ray ray{.org = start_of(from, s->wi), .dir = s->wi};
            const Hit hit = stage.list.closest(ray);
            if (s->infinite) {
                if (hit) continue;
                ++found;
                ASSERT_NEAR(pdf_environment(stage.scene, from.ns, s->wi) / s->pdf, 1, gamma(16) / dot(s->wi, from.ns))
                    << lit.name;
                ASSERT_EQ(s->radiance, stage.scene.radiance_from(s->wi));
                continue;
            }
            if (!hit) continue;
            const Surface at = surface_at(stage.scene, ray, hit);
            // Another light may stand in front.
            if (at.light == Scene::none || length(at.p - s->point) > 1e-3f * length(s->point - from.p)) continue;
            ++found;
            // The densities hold the cosine at the light, whose rounding is relative to 1.
            const float cosine = std::abs(dot(s->wi, at.n));
            ASSERT_NEAR(pdf_light(stage.scene, ray.org, from.ns, s->wi, at) / s->pdf, 1, gamma(64) / cosine)
                << lit.name;
            ASSERT_EQ(s->radiance, stage.scene.emission[at.material].towards(at.front, stage.scene.shading_point(at)))
                << lit.name;
        }
        EXPECT_GT(sampled, 2000) << lit.name;
        EXPECT_GT(found, sampled * (lit.name == "all kinds" ? 0.7 : 0.98)) << lit.name;
    }
}

// Uniform directions: the mean of the density over them is 1 / (4 pi). Only where one light is seen everywhere and
// emits towards the place: a density spent on back faces and hidden places is lost to this count.
TEST(LightDensity, IntegratesToOne)
{
    stats::Family family;
    for (const LitScene& lit : lit_scenes()) {
        if (lit.name == "mesh" || lit.name == "all kinds" || lit.name.ends_with("afar")) continue;
        const Stage stage(lit.description, lit.images);
        Random random(12);
        for (int place = 0; place < 4; ++place) {
            const Surface from = place_in(stage, lit, random);
            stats::Tally sum;
            for (int i = 0; i < 100000; ++i) {
                const Ray ray{.org = start_of(from, from.n), .dir = random.unit_vector()};
                const Hit hit = stage.list.closest(ray);
                const float pdf =
                    hit ? pdf_light(stage.scene, ray.org, from.ns, ray.dir, surface_at(stage.scene, ray, hit))
                        : pdf_environment(stage.scene, from.ns, ray.dir);
                sum.add(4 * std::numbers::pi * static_cast<double>(pdf));
            }
            family.add(stats::mean_p(sum, 1), lit.name);
        }
    }
}

// Far lights: uniform directions in a cone just wide enough.
TEST(LightDensity, IntegratesToOneFromAfar)
{
    stats::Family family;
    for (const LitScene& lit : lit_scenes()) {
        if (!lit.name.ends_with("afar")) continue;
        const Stage stage(lit.description, lit.images);
        Random random(13);
        const Surface from = place_in(stage, lit, random);
        const bool is_sphere = lit.name.starts_with("sphere");
        const Vec3d axis =
            stage.scene.normalisation.to_scene(is_sphere ? Vec3d{0, 3000, 0} : Vec3d{0.07, 1.1, 0}) - to_double(from.p);
        const double radius = 1.01 * stage.scene.normalisation.scale, sin2 = radius * radius / dot(axis, axis);
        const Frame frame(to_float(normalize(axis)));
        stats::Tally sum;
        for (int i = 0; i < 100000; ++i) {
            const double v = square_to_cone(static_cast<double>(random.unit()), one_minus_cos(sin2)),
                         r = std::sqrt(v * (2 - v));
            const double phi = random.uniform(0, 2 * std::numbers::pi);
            const Vec3 w = frame.to_world(to_float(Vec3d{r * std::cos(phi), r * std::sin(phi), 1 - v}));
            const Ray ray{.org = from.p, .dir = normalize(w)};
            const Hit hit = stage.list.closest(ray);
            const float pdf =
                hit ? pdf_light(stage.scene, ray.org, from.ns, ray.dir, surface_at(stage.scene, ray, hit)) : 0;
            sum.add(static_cast<double>(pdf) / pdf_cone(one_minus_cos(sin2)));
        }
        family.add(stats::mean_p(sum, 1), lit.name);
    }
}

// On the inner side of an emitting sphere a point may be rounded to beyond it: sampling and density must still agree
// on which side it is.
TEST(LightDensity, AgreesOnTheInnerSideOfAnEmittingSphere)
{
    SceneDescription d;
    d.materials = {both_lamp()};
    d.spheres.push_back(sphere_of({0.3, -0.2, 0.1}, 1.3, "both"));
    const Stage stage(d);
    Random random(14);
    const Vec3 center = stage.to_scene({0.3, -0.2, 0.1});
    stats::Tally irradiance;
    for (int i = 0; i < 20000; ++i) {
        const auto from = stage.look(center, random.unit_vector());
        ASSERT_TRUE(from && !from->front);
        const auto s = sample_light(stage.scene, *from, 0, random.unit2());
        if (!s || dot(s->wi, from->n) <= 0) {
            irradiance.add(0);
            continue;
        }
        const double cosine = static_cast<double>(dot(s->wi, from->n));
        irradiance.add(cosine / static_cast<double>(s->pdf));
        const Ray ray{.org = start_of(*from, s->wi), .dir = s->wi};
        const Hit hit = stage.list.closest(ray);
        ASSERT_TRUE(hit);
        const float pdf = pdf_light(stage.scene, ray.org, from->ns, ray.dir, surface_at(stage.scene, ray, hit));
        ASSERT_NEAR(pdf / s->pdf, 1, 1e-5 / cosine);
    }
    EXPECT_NEAR(irradiance.mean, std::numbers::pi, 1e-4 + 4 * irradiance.error());
}

// Light that comes through a surface: samples on both sides, each with the density found from its own side. The two
// sides together have all that a place in the open has.
TEST(LightDensity, HoldsBehindTheSurfaceToo)
{
    for (const LitScene& lit : lit_scenes()) {
        const Stage stage(lit.description, lit.images);
        Random random(15);
        int above = 0, below = 0, found = 0, expected = 0;
        for (int i = 0; i < 10000; ++i) {
            const Surface from = place_in(stage, lit, random);
            const float pick = random.unit();
            const Vec2 u = random.unit2();
            const auto s = sample_light(stage.scene, from, pick, u, true);
            Surface turned = from;
            turned.n = -from.n;
            turned.side = -from.side;
            turned.origin = start_of(from, turned.n);
            const auto front = sample_light(stage.scene, from, pick, u),
                       back = sample_light(stage.scene, turned, pick, u);
            const bool constant_sky = s && s->infinite && !s->delta && !stage.scene.environment_map;
            if (constant_sky) continue;  // only drawn on the front side
            ASSERT_EQ(s.has_value(), front || back) << lit.name;
            if (!s) continue;
            (dot(s->wi, from.n) > 0 ? above : below) += 1;
            ASSERT_EQ(s->wi, (front ? front : back)->wi) << lit.name;
            // A tree chooses as seen from the front; rays to the back start a rounding away from there.
            ASSERT_NEAR(s->pdf / (front ? front : back)->pdf, 1, stage.scene.lights.tree ? 1e-5 : 0) << lit.name;
            if (s->delta || s->infinite) continue;
            ++expected;
            const Ray ray{.org = start_of(from, s->wi), .dir = s->wi};
            const Hit hit = stage.list.closest(ray);
            if (!hit) continue;
            const Surface at = surface_at(stage.scene, ray, hit);
            if (at.light == Scene::none || length(at.p - s->point) > 1e-3f * length(s->point - from.p)) continue;
            ++found;
            const float cosine = std::abs(dot(s->wi, at.n));
            ASSERT_NEAR(pdf_light(stage.scene, ray.org, from.ns, s->wi, at) / s->pdf, 1, gamma(64) / cosine)
                << lit.name;
        }
        if (lit.name == "sky") continue;
        EXPECT_GT(above, 500) << lit.name;
        EXPECT_NEAR(above, below, 0.2 * above) << lit.name << ": normals are all alike";
        EXPECT_GE(found, expected * (lit.name == "all kinds" ? 0.7 : 0.98)) << lit.name;
    }
}

// A sphere that emits to both sides and lets light through, seen from its own surface: outside nothing, inside the
// whole sphere.
TEST(LightDensity, ThroughItsOwnSurfaceASphereIsSeenFromInside)
{
    SceneDescription d;
    d.materials = {both_lamp()};
    d.spheres.push_back(sphere_of({0.3, -0.2, 0.1}, 1.3, "both"));
    const Stage stage(d);
    Random random(16);
    stats::Tally irradiance;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 w = random.unit_vector();
        const auto from = stage.look(stage.to_scene({0.3, -0.2, 0.1}) + w * 5.0f, -w);
        ASSERT_TRUE(from && from->front);
        const auto s = sample_light(stage.scene, *from, 0, random.unit2(), true);
        irradiance.add(s ? static_cast<double>(-dot(s->wi, from->n) / s->pdf) : 0);
        if (!s) continue;
        ASSERT_LT(dot(s->wi, from->n), 0);
        const Ray ray{.org = start_of(*from, s->wi), .dir = s->wi};
        const Hit hit = stage.list.closest(ray);
        ASSERT_TRUE(hit);
        const float pdf = pdf_light(stage.scene, ray.org, from->ns, ray.dir, surface_at(stage.scene, ray, hit));
        ASSERT_NEAR(pdf / s->pdf, 1, 1e-5f / -dot(s->wi, from->n));
    }
    EXPECT_NEAR(irradiance.mean, std::numbers::pi, 1e-4 + 4 * irradiance.error());
}

// The weights of light sampling and BSDF sampling at one direction, each as its technique works it out.
TEST(LightDensity, WeightsOfBothTechniquesSumToOne)
{
    for (const LitScene& lit : lit_scenes()) {
        const Stage stage(lit.description, lit.images);
        Random random(17);
        int tried = 0;
        for (int i = 0; i < 20000; ++i) {
            const Surface from = place_in(stage, lit, random);
            const float pick = random.unit();
            const auto s = sample_light(stage.scene, from, pick, random.unit2());
            if (!s || s->delta) continue;
            PathState found;
            found.ray = {.org = start_of(from, s->wi), .dir = s->wi};
            found.pdf = pdf_cosine_hemisphere(dot(s->wi, from.ns));  // of a diffuse BSDF
            found.specular = false;
            const Hit hit = stage.list.closest(found.ray);
            if (hit && s->infinite) continue;
            const float of_light = power_heuristic(s->pdf, found.pdf);
            float pdf = 0, rounding = gamma(16);
            if (s->infinite) {
                pdf = pdf_environment(stage.scene, from.ns, s->wi);
            } else {
                if (!hit) continue;
                const Surface at = surface_at(stage.scene, found.ray, hit);
                if (at.light == Scene::none || length(at.p - s->point) > 1e-3f * length(s->point - from.p)) continue;
                pdf = pdf_light(stage.scene, found.ray.org, from.ns, s->wi, at);
                rounding = gamma(64) / std::abs(dot(s->wi, at.n));  // the cosine at the light is known to so much
            }
            ++tried;
            ASSERT_NEAR(of_light + weight_of_found(found, {}, pdf), 1, std::max(1e-6f, rounding)) << lit.name;
        }
        EXPECT_GT(tried, 2000) << lit.name;
    }
}

TEST(LightDensity, NoLightHasNone)
{
    SceneDescription d;
    d.spheres.push_back(sphere_of({0, 0, 0}, 1));
    const Stage stage(d);
    const auto at = stage.look({0, 0, 3}, {0, 0, -1});
    ASSERT_TRUE(at);
    EXPECT_EQ(at->light, Scene::none);
    EXPECT_EQ(pdf_light(stage.scene, {0, 0, 3}, {0, 0, 1}, {0, 0, -1}, *at), 0);
    EXPECT_EQ(pdf_environment(stage.scene, {0, 0, 1}, {0, 0, 1}), 0);
    EXPECT_FALSE(sample_light(stage.scene, *at, 0.5f, {0.5f, 0.5f}));
}

}  // namespace
}  // namespace lancer
