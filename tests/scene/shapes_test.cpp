// Planes with axes, bands and waves, bubbles, triangles and pyramids: where they are and what they show.
#include "scene/build/shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "materials/material.h"
#include "support/random.h"
#include "support/rasters.h"
#include "support/shoot.h"
#include "support/stage.h"

namespace lancer {
namespace {

MaterialDescription white_of(std::string name, MaterialType type)
{
    MaterialDescription m = make_lambert(std::move(name), {1, 1, 1});
    m.type = type;
    return m;
}

// Something to measure the scene by, behind what is looked at.
void add_ball(SceneDescription& d) { d.spheres.push_back(sphere_of({0, -50, -50}, 8)); }

// Straight onto the place, which must be seen.
Surface look_at(const Stage& stage, Vec3d from, Vec3d to)
{
    const Vec3 org = stage.to_scene(from);
    const auto s = stage.look(org, stage.to_scene(to) - org);
    EXPECT_TRUE(s.has_value());
    return s.value_or(Surface{});
}

TEST(PlaneMap, CoordinatesAreStepsAlongTheAxesFromThePoint)
{
    Random random(1);
    for (int k = 0; k < 200; ++k) {
        const Vec3d u = random.direction() * random.uniform(0.5, 5);
        const Vec3d turned = normalize(cross(u, random.direction())) * random.uniform(0.5, 5);
        const Vec3d v = k % 2 ? turned : turned + u * random.uniform(-1, 1);  // at right angles, or not
        PlaneDescription plane = plane_of(random.point(-1, 1), normalize(cross(u, v)));
        plane.axes = {u, v};
        const PlaneMap map = make_plane_map(plane);
        const double a = random.uniform(-9, 9), b = random.uniform(-9, 9);
        const auto uv_of = [&](Vec3d p) { return Vec3d{dot(p - map.origin, map.u), dot(p - map.origin, map.v), 0}; };
        // The numbers of p: its projections onto either axis, in units of that axis.
        const Vec3d p = plane.point + u * a + v * b;
        EXPECT_NEAR(uv_of(p).x, a + b * dot(u, v) / dot(u, u), 1e-9);
        EXPECT_NEAR(uv_of(p).y, b + a * dot(u, v) / dot(v, v), 1e-9);
        EXPECT_LT(length(uv_of(p + map.step_u) - uv_of(p) - Vec3d{1, 0, 0}), 1e-9);
        EXPECT_LT(length(uv_of(p + map.step_v) - uv_of(p) - Vec3d{0, 1, 0}), 1e-9);
        EXPECT_NEAR(dot(map.step_u, plane.normal), 0, 1e-9);
    }
}

// The uv and the footprint of a hit on a plane far from the origin in a scene that is scaled.
TEST(PlaneMap, IsInUnitsOfTheFile)
{
    SceneDescription d;
    add_ball(d);
    PlaneDescription plane = plane_of({1, -2, 3}, {0, 1, 0});
    plane.axes = {Vec3d{0, 0, 5}, Vec3d{4, 0, 0}};
    plane.bands = Bands{"", 0.1f};
    d.planes.push_back(plane);
    const Stage stage(d);
    const Surface s = look_at(stage, {6, 3, 4}, {6, -2, 4});
    EXPECT_NEAR(s.uv.x, 0.2f, 1e-5f);
    EXPECT_NEAR(s.uv.y, 1.25f, 1e-5f);
    // A ray that comes at an angle stands for a longer piece, by the cosine, towards where it goes.
    const Vec3 org = stage.to_scene({6, 3, 4}), dir = normalize(stage.to_scene({6, -2, 9}) - org);
    const Ray ray{.org = org, .dir = dir};
    const auto scale = static_cast<float>(stage.scene.normalisation.scale);
    const Surface slanted = surface_at(stage.scene, ray, stage.list.closest(ray), {0.3f * scale, 0});
    EXPECT_NEAR(slanted.uv_width, 0.3f / std::sqrt(20.0f), 1e-6f);
    EXPECT_NEAR(slanted.uv_along.x, 0.3f / 5, 1e-6f) << "45 degrees: twice the variance";
    EXPECT_NEAR(slanted.uv_along.y, 0, 1e-6f);
}

// Of a plane of white with black bands, under a sky that shines from everywhere: as much is lit as is white.
double lit_part(SceneDescription d, const CameraDescription& camera)
{
    d.materials = {make_lambert("white", {1, 1, 1}), make_lambert("black", {})};
    d.lights.push_back(sky_of({1, 1, 1}));
    d.camera = camera;
    Shot shot;
    shot.integrator = Path{.max_depth = 1, .direct = {.nee = false}};
    shot.width = shot.height = 64;
    return tally(shoot(d, shot)).mean;
}

TEST(Bands, CoverTheirPartOfEveryCell)
{
    for (const float width : {0.05f, 0.3f}) {
        SceneDescription d;
        add_ball(d);
        PlaneDescription plane = plane_of({0.3, 0, 0.1}, {0, 0, 1}, "white");
        plane.axes = {Vec3d{2, 0, 0}, Vec3d{0, 0.5, 0}};
        plane.bands = Bands{"black", width};
        d.planes.push_back(plane);
        // Four by sixteen cells.
        const double expected = (1.0 - double(width)) * (1.0 - double(width));
        EXPECT_NEAR(lit_part(d, make_camera({0, 0, 4.1}, {0, 0, 0}, 90)), expected, 0.006) << width;
        // From so far that a pixel holds many cells, all is the mean.
        EXPECT_NEAR(lit_part(d, make_camera({0, 0, 4000.1}, {0, 0, 0}, 90)), expected, 0.006) << width;
    }
}

TEST(Bands, OfATriangleCoverTheirPartOfIt)
{
    for (const float width : {0.05f, 0.2f}) {
        SceneDescription d;
        MeshDescription mesh = make_mesh(make_triangle({-40, 40, 0}, {40, 40, 0}, {-40, -40, 0}));
        mesh.material = "white";
        mesh.bands = Bands{"black", width};
        d.meshes.push_back(std::move(mesh));
        // Beside the triangle the sky is seen: half of the square.
        const double s = 1 - 3.0 * double(width), expected = 0.5 + 0.5 * s * s;
        EXPECT_NEAR(lit_part(d, make_camera({0, 0, 40}, {0, 0, 0}, 90)), expected, 0.006) << width;
    }
}

TEST(Water, NormalIsThatOfTheHeights)
{
    const std::vector<Wave> waves{{0.05, 0.4, 1.5, 0.2}, {0.02, 2.2, 0.7, 1}};
    const auto slope = [&](double x, double y) {
        Vec3d s;
        for (const Wave& w : waves) {
            const double c = std::cos(w.direction_rad), n = std::sin(w.direction_rad);
            const double down = 2 * pi_d * w.amplitude / w.wavelength *
                                std::sin(2 * pi_d * (x * c + y * n) / w.wavelength + w.phase_rad);
            s -= Vec3d{c, n, 0} * down;
        }
        return s;
    };
    Random random(2);
    // z up with axes along x and y, y up, stretched axes: heights are lengths, whatever a unit of uv is.
    for (const int variant : {0, 1, 2}) {
        SceneDescription d;
        add_ball(d);
        PlaneDescription water = plane_of({1, 2, 3}, variant == 1 ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1});
        const Vec3d u = Vec3d{1, 0, 0}, v = cross(water.normal, u);
        water.is_water = true;
        water.waves = waves;
        const double along_u = variant == 2 ? 4 : 1, along_v = variant == 2 ? 0.5 : 1;
        water.axes = {u * along_u, v * along_v};
        d.planes.push_back(water);
        const Stage stage(d);
        for (int k = 0; k < 100; ++k) {
            const double x = random.uniform(-5, 5), y = random.uniform(-5, 5);
            const Vec3d at = water.point + u * x + v * y;
            const Surface s = look_at(stage, at + water.normal * 10.0, at);
            const Vec3d there = slope(x / along_u, y / along_v);
            const Vec3d expected = normalize(water.normal - u * (there.x / along_u) - v * (there.y / along_v));
            EXPECT_LT(length(to_double(s.ns) - expected), 1e-4) << variant;
        }
    }
}

// The same waves as bumps of any material on any shape: on a sphere, along the equator.
TEST(Water, IsForEveryShape)
{
    SceneDescription d;
    MaterialDescription m = make_lambert("wavy", {1, 1, 1});
    m.bump_map.emplace();
    m.bump_map->type = TextureType::waves;
    m.bump_map->waves = {{0.1, 0, 0.1, -0.5 * pi_d}};  // ten around
    d.materials = {m};
    d.spheres.push_back(sphere_of({0, 0, 0}, 3, "wavy"));
    const Stage stage(d);
    const Surface s = look_at(stage, {0, 0, 9}, {0, 0, 0});  // u = 0.5, where a sine goes up through 0
    const double steep = 2 * pi_d * 0.1 * 10 / (2 * pi_d * 3);
    EXPECT_NEAR(double(s.ns.x / s.ns.z), -steep, 1e-3);
    EXPECT_NEAR(s.ns.y, 0, 1e-5f);
}

TEST(Water, OfOldHasTheSameDefaultSlopes)
{
    for (const bool legacy : {false, true}) {
        SceneDescription d;
        add_ball(d);
        d.render.legacy = legacy;
        PlaneDescription water = plane_of({}, {0, 0, 1});
        water.is_water = true;
        d.planes.push_back(water);
        const Stage stage(d);
        // At the origin nothing has faded: the sum of amplitude / wavelength * sine.
        const Surface s = look_at(stage, {0, 0, 10}, {0, 0, 0});
        double expected = 0;
        for (const Wave& w : default_waves(true))
            expected += w.amplitude / w.wavelength * std::cos(w.direction_rad) * std::sin(w.phase_rad);
        EXPECT_NEAR(double(s.ns.x / s.ns.z), expected, 1e-5) << legacy;
    }
}

// The textbook mistake is a wrong index on the way out: then a bubble is a solid ball, dark and upside down.
TEST(Bubble, HardlyBendsWhatGoesThroughIt)
{
    SceneDescription d;
    d.materials = {white_of("wall", MaterialType::glass)};
    for (const auto part : {SphereDescription::Part::bubble, SphereDescription::Part::inside_of_bubble}) {
        d.spheres.push_back(sphere_of({-5, 4, -1}, 2, "wall"));
        d.spheres.back().part = part;
    }
    d.spheres[1].radius -= 0.02;
    const Stage stage(d);
    const auto scale = static_cast<float>(stage.scene.normalisation.scale);
    for (const float offset : {0.0f, 0.5f, 1.0f, 1.5f, 1.8f}) {
        Vec3 org = stage.to_scene({-5, 4, -1}) + Vec3{offset, 0, -6} * scale, dir{0, 0, 1};
        int surfaces = 0;
        while (const auto s = stage.look(org, dir)) {
            ASSERT_LT(++surfaces, 5);
            const auto& glass = std::get<Glass>(stage.scene.materials[s->material]);
            const Frame frame(s->ns);
            const auto through = glass.at(stage.scene.shading_point(*s)).sample(frame.to_local(-dir), 1 - 0x1p-24f, {});
            ASSERT_TRUE(through);
            dir = normalize(frame.to_world(through->wi));
            org = ray_origin(*s, dir);
        }
        EXPECT_EQ(surfaces, 4);
        EXPECT_LT(std::acos(std::min(1.0f, dir.z)), 0.035f) << "two degrees, " << offset << " from the centre";
    }
}

TEST(Bubble, InsideOut)
{
    MaterialDescription m = white_of("m", MaterialType::glass);
    m.ior = 1.25f;
    EXPECT_EQ(inside_out(m)->ior, 0.8f);
    m.type = MaterialType::interface;
    m.phong.inside_ior = 1.5f, m.phong.outside_ior = 1.3f;
    EXPECT_EQ(inside_out(m)->phong.inside_ior, 1.3f);
    EXPECT_EQ(inside_out(m)->phong.outside_ior, 1.5f);
    for (const MaterialType other :
         {MaterialType::lambert, MaterialType::mirror, MaterialType::metal, MaterialType::plastic, MaterialType::mix}) {
        m.type = other;
        EXPECT_FALSE(inside_out(m));
    }
    SceneDescription d;
    d.materials = {make_lambert("chalk", {})};
    d.spheres.push_back(sphere_of({}, 1, "chalk", {"s.toml", 7, 1}));
    d.spheres[0].part = SphereDescription::Part::inside_of_bubble;
    Diagnostics diagnostics;
    try {
        Scene::build(d, d.render, diagnostics);
        ADD_FAILURE();
    } catch (const Error& e) {
        EXPECT_STREQ(e.what(),
                     "s.toml:7:1: error: a bubble must be of a material of type glass or interface or principled; "
                     "'chalk' is another");
    }
}

TEST(Triangle, APictureHasItsUpperLeftCornerAtTheFirst)
{
    SceneDescription d;
    MaterialDescription m = make_lambert("picture", {1, 1, 1});
    m.base_color_map = picture_of("4 x 4", Encoding::linear);
    d.materials = {m};
    // Seen from +z: a at the upper left.
    MeshDescription mesh = make_mesh(make_triangle({0, 4, 0}, {4, 4, 0}, {0, 0, 0}));
    mesh.material = "picture";
    d.meshes.push_back(std::move(mesh));
    // The colour of a pixel tells its column and its row from the top.
    const Raster raster = make_raster(4, 4, [](uint32_t x, uint32_t y) {
        return Color{0.1f * static_cast<float>(x), 0.1f * static_cast<float>(y), 0};
    });
    const Stage stage(d, picture_source(raster));
    for (const auto& [column, row] : {std::pair{0, 0}, {2, 0}, {0, 2}, {1, 1}}) {
        const Vec3d at{column + 0.5, 4 - (row + 0.5), 0};
        const Surface s = look_at(stage, at + Vec3d{0, 0, 9}, at);
        const auto& lambert = std::get<Lambert>(stage.scene.materials[s.material]);
        const Color c = stage.scene.shading_point(s).eval(lambert.albedo);
        EXPECT_NEAR(c.r, 0.1f * static_cast<float>(column), 1e-4f);
        EXPECT_NEAR(c.g, 0.1f * static_cast<float>(row), 1e-4f);
        EXPECT_FALSE(s.front) << "a, b, c run clockwise";
    }
}

TEST(Pyramid, FacesLookOutwardsAndMeetAtTheApex)
{
    Random random(3);
    std::vector<Vec3d> ups{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {0, 0, -3}, {1e200, 1e200, 0}};
    for (int k = 0; k < 20; ++k) ups.push_back(random.direction());
    for (const Vec3d up : ups) {
        const Vec3d center = random.point(-5, 5), n = normalize(up / max_component(abs(up)));
        const double side = random.uniform(0.5, 5);
        const auto data = make_pyramid(center, side, up);
        const auto& p = data->positions;
        ASSERT_EQ(data->triangles.size(), 4u);
        EXPECT_LT(length(p[4] - center - n * (std::sqrt(2.0) * side / 2)), 1e-9);
        for (const auto& t : data->triangles) {
            const Vec3d outside = cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
            EXPECT_GT(dot(outside, (p[t[0]] + p[t[1]]) / 2.0 - center), 0);
            EXPECT_NEAR(length(p[t[1]] - p[t[0]]), side, 1e-9);
            EXPECT_NEAR(dot(p[t[0]] - center, n), 0, 1e-9);
            EXPECT_EQ(t[2], 4u);
        }
        EXPECT_NEAR(length(p[0] - p[2]), side * std::sqrt(2.0), 1e-9) << "a square";
    }
    EXPECT_LT(length(make_pyramid({}, 2, {0, 0, 1})->positions[0] - Vec3d{-1, -1, 0}), 1e-15);
}

}  // namespace
}  // namespace lancer
