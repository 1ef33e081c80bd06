// The place that a hit is: on the surface within its stated error, so that the rays that leave it never meet it again.
#include <gtest/gtest.h>

#include "support/random.h"
#include "support/stage.h"

namespace lancer {
namespace {

using Wide = Vec3T<long double>;
Wide wide(Vec3 v) { return {v.x, v.y, v.z}; }
Wide wide(Vec3d v) { return {v.x, v.y, v.z}; }

// How far p is from the true surface, along the normal of that.
long double off_surface(const Scene& scene, const Hit& hit, Vec3 p)
{
    if (hit.kind == Kind::sphere) {
        const Sphere& s = scene.geometry.spheres[hit.primitive];
        return std::abs(length(wide(p) - wide(s.center)) - static_cast<long double>(s.radius));
    }
    if (hit.kind == Kind::plane) {
        const Plane& plane = scene.geometry.planes[hit.primitive];
        return std::abs(dot(wide(plane.normal), wide(p)) - static_cast<long double>(plane.offset));
    }
    const Mesh& mesh = scene.geometry.meshes[hit.geometry];
    std::array<Wide, 3> corner;
    for (size_t i = 0; i < 3; ++i) {
        corner[i] = wide(mesh.positions[mesh.triangles[hit.primitive][i]]);
        if (hit.instance == Hit::no_instance) continue;
        const Transform& m = scene.geometry.instances[hit.instance].to_world;
        const Wide c = corner[i];
        corner[i] = wide(m.x) * c.x + wide(m.y) * c.y + wide(m.z) * c.z + wide(m.translation);
    }
    const Wide n = normalize(cross(corner[1] - corner[0], corner[2] - corner[0]));
    return std::abs(dot(n, wide(p) - corner[0]));
}

// Rays from all around into the scene; the surface found and the rays that leave it are checked.
void check_surfaces(const Stage& stage, double spread, int rays, const std::string& what)
{
    Random random(1);
    int hits = 0, hit_again = 0, tested = 0;
    for (int i = 0; i < rays; ++i) {
        const Vec3 org = to_float(random.point(-spread, spread)), to = to_float(random.point(-spread / 3, spread / 3));
        const Ray ray{.org = org, .dir = normalize(to - org)};
        const Hit hit = stage.list.closest(ray);
        if (!hit) continue;
        ++hits;
        const Surface s = surface_at(stage.scene, ray, hit);
        ASSERT_TRUE(is_finite(s.p) && is_finite(s.n) && is_finite(s.ns)) << what;
        ASSERT_NEAR(length(s.n), 1, gamma(4)) << what;
        ASSERT_NEAR(length(s.ns), 1, gamma(4)) << what;
        ASSERT_LE(dot(s.n, ray.dir), 0) << what;
        ASSERT_GE(dot(s.ns, s.n), 0) << what;
        ASSERT_LE(dot(s.ns, ray.dir), gamma(4)) << what;
        const auto allowed = static_cast<long double>(dot(abs(s.n), s.p_error));
        ASSERT_LE(off_surface(stage.scene, hit, s.p), allowed) << what << " " << s.p.x << " " << s.p.y << " " << s.p.z;
        for (int k = 0; k < 8; ++k) {
            Vec3 w = random.unit_vector();
            const float side = dot(w, s.n);
            // On the sphere's inside every ray meets the sphere again, and so it should.
            if (hit.kind == Kind::sphere && (side > 0) != s.front) continue;
            const Ray away{.org = offset_origin(s.p, s.p_error, s.n, w), .dir = w};
            ++tested;
            for (const Hit next : {stage.list.closest(away), stage.embree->closest(away)})
                hit_again += next && next.kind == hit.kind && next.primitive == hit.primitive &&
                             next.geometry == hit.geometry && next.instance == hit.instance;
        }
    }
    EXPECT_GT(hits, rays / 20) << what;
    EXPECT_EQ(hit_again, 0) << what << ", of " << tested;
}

TEST(Surface, PointsAreWithinTheirErrorAndAreNotMetAgain)
{
    for (const auto& [name, description] : all_test_scenes()) check_surfaces(Stage(description), 1.5, 4000, name);
}

TEST(Surface, FarFromTheOrigin)
{
    // One far thing beside one at the origin: nothing is moved, coordinates are large.
    for (const double far : {30.0, 1e3, 1e5}) {
        SceneDescription d;
        d.lights.push_back(sky_of({1, 1, 1}));
        d.spheres.push_back(sphere_of({0.1, 0.2, 0.3}, 0.7));
        d.spheres.push_back(sphere_of({far, -far / 3, 0.2 * far}, 1.3));
        d.meshes.push_back(make_mesh(make_uv_sphere(8, 16), {{-far, 0.1 * far, far}, {10, 20, 30}, {1, 2, 3}}));
        const Stage stage(d);
        const auto scale = static_cast<float>(stage.scene.normalisation.scale);
        Random random(7);
        int found = 0;
        for (int i = 0; i < 2000; ++i) {
            const Vec3 center =
                i % 2 ? stage.to_scene({far, -far / 3, 0.2 * far}) : stage.to_scene({-far, 0.1 * far, far});
            const Vec3 w = random.unit_vector();
            const Ray ray{.org = center - w * (20 * scale), .dir = w};
            const Hit hit = stage.list.closest(ray);
            if (!hit) continue;
            ++found;
            const Surface s = surface_at(stage.scene, ray, hit);
            ASSERT_LE(off_surface(stage.scene, hit, s.p), static_cast<long double>(dot(abs(s.n), s.p_error))) << far;
        }
        EXPECT_GT(found, 1900);
    }
}

// A wall made of a huge sphere that passes through the origin: what rounds is the centre, not the point.
TEST(Surface, WallSphereThroughTheOrigin)
{
    for (const double radius : {1e3, 1e5, 1e6}) {
        SceneDescription d;
        d.lights.push_back(sky_of({1, 1, 1}));
        d.spheres.push_back(sphere_of({0, 1, 0}, 0.1));
        d.spheres.push_back(sphere_of({0, -radius, 0}, radius));
        const Stage stage(d);
        Random random(3);
        int hit_again = 0;
        for (int i = 0; i < 20000; ++i) {
            // All sizes of x and z, so that y comes down to nothing.
            const double size = std::pow(10, random.uniform(-9, 0));
            const Vec3 target = to_float(Vec3d{size * random.uniform(-1, 1), 0, size * random.uniform(-1, 1)});
            const Vec3 org = target + to_float(Vec3d{random.uniform(-1, 1), 1, random.uniform(-1, 1)});
            const Ray ray{.org = org, .dir = normalize(target - org)};
            const Hit hit = stage.list.closest(ray);
            if (hit.kind != Kind::sphere || hit.primitive != 1) continue;
            const Surface s = surface_at(stage.scene, ray, hit);
            ASSERT_TRUE(s.front);
            ASSERT_LE(off_surface(stage.scene, hit, s.p), static_cast<long double>(dot(abs(s.n), s.p_error)))
                << radius << " " << s.p.x << " " << s.p.y << " " << s.p.z;
            Vec3 w = random.unit_vector();
            if (dot(w, s.n) < 0) w = -w;
            const Hit next = stage.list.closest({.org = offset_origin(s.p, s.p_error, s.n, w), .dir = w});
            hit_again += next.kind == Kind::sphere && next.primitive == 1;
        }
        EXPECT_EQ(hit_again, 0) << radius;
    }
}

// Normals of the file, leaning away from the face: one triangle whose corners' normals are far from its own.
Stage leaning()
{
    MeshData data;
    data.positions = {{-1, 0, 1}, {1, 0, 1}, {0, 0, -1}};
    data.triangles = {{0, 1, 2}};
    data.normals = {normalize(Vec3{-1, 0.3f, 0}), normalize(Vec3{1, 0.3f, 0}), normalize(Vec3{0, 0.3f, -1})};
    data.normal_triangles = {{0, 1, 2}};
    data.materials.emplace_back();
    SceneDescription d;
    d.meshes.push_back(make_mesh(std::make_shared<const MeshData>(data)));
    d.lights.push_back(sky_of({1, 1, 1}));
    return Stage(d);
}

TEST(Surface, ShadingNormalIsInterpolated)
{
    const Stage stage = leaning();
    const float s = static_cast<float>(stage.scene.normalisation.scale);
    // At the middle of the front edge: between the first two corners.
    const auto middle = stage.look({0, s, 0.999999f * s}, {0, -1, 0});
    ASSERT_TRUE(middle);
    EXPECT_NEAR(middle->ns.y, 1, 1e-5f);
    EXPECT_EQ(middle->n, (Vec3{0, 1, 0}));
    // A quarter along it: 3/4 of the first, 1/4 of the second.
    const auto quarter = stage.look({-0.5f * s, s, 0.999999f * s}, {0, -1, 0});
    ASSERT_TRUE(quarter);
    const Vec3 expected = normalize(Vec3{-0.5f, 0.3f, 0});
    EXPECT_LE(length(quarter->ns - expected), 1e-5f);
}

// Seen from where the interpolated normal faces away, it is mirrored about the silhouette: as far on this side as it
// was beyond, in the hemisphere of the geometric normal; and continuous where it turns.
TEST(Surface, ShadingNormalIsMirroredAboutTheSilhouette)
{
    const Stage stage = leaning();
    const float s = static_cast<float>(stage.scene.normalisation.scale);
    const Vec3 at{-0.5f * s, 0, 0.9f * s};
    const Vec3 own = stage.look(at + Vec3{0, s, 0}, {0, -1, 0})->ns;
    int mirrored = 0;
    float before = 0;
    for (int i = 1; i < 1800; ++i) {
        const float angle = static_cast<float>(i) * (pi / 1800);
        const Vec3 wo{std::cos(angle), std::sin(angle), 0};
        const auto seen = stage.look(at + wo * s, -wo);
        ASSERT_TRUE(seen);
        EXPECT_NEAR(dot(seen->ns, wo), std::abs(dot(own, wo)), 1e-5f);
        EXPECT_GE(dot(seen->ns, seen->n), 0);
        mirrored += dot(own, wo) < 0;
        EXPECT_LE(std::abs(seen->ns.x - before), i == 1 ? 2 : 0.004f) << i;
        before = seen->ns.x;
    }
    EXPECT_GT(mirrored, 100);
}

// The normals of the file say which side is the front, whatever the winding.
TEST(Surface, NormalsOfTheFileDecideTheFront)
{
    for (const bool wound : {true, false}) {
        MeshData data;
        data.positions = {{0, 0, 1}, {1, 0, 0}, {-1, 0, 0}};
        data.triangles = {wound ? std::array<uint32_t, 3>{0, 1, 2} : std::array<uint32_t, 3>{0, 2, 1}};
        data.normals = {{0, 1, 0}};
        data.normal_triangles = {{0, 0, 0}};
        data.materials.emplace_back();
        SceneDescription d;
        d.meshes.push_back(make_mesh(std::make_shared<const MeshData>(data)));
        d.lights.push_back(sky_of({1, 1, 1}));
        const Stage stage(d);
        const float s = static_cast<float>(stage.scene.normalisation.scale);
        const auto above = stage.look({0, s, 0.2f * s}, {0, -1, 0}), below = stage.look({0, -s, 0.2f * s}, {0, 1, 0});
        ASSERT_TRUE(above && below);
        EXPECT_TRUE(above->front);
        EXPECT_FALSE(below->front);
        EXPECT_EQ(below->n, (Vec3{0, -1, 0}));
        EXPECT_EQ(below->ns, (Vec3{0, -1, 0}));
    }
}

TEST(TrianglePoint, AreaIsThatOfTheTriangleWhereItStands)
{
    Random random(5);
    for (int i = 0; i < 200; ++i) {
        const Vec3d a = random.point(-1, 1), b = random.point(-1, 1), c = random.point(-1, 1);
        SceneDescription d;
        d.lights.push_back(sky_of({1, 1, 1}));
        d.meshes.push_back(triangle_mesh(a, b, c, {}));
        d.meshes[0].name = "t";
        d.meshes.push_back(d.meshes[0]);
        d.meshes[1].name = "u";
        const TransformDescription t{random.point(-1, 1), random.point(-180, 180), {0.5, -2, 1.5}};
        d.meshes[1].transform = t;
        d.instances.push_back(instance_of("t", t));
        const Scene scene = build_scene(d);
        const Transform m = to_transform(t);
        const double s = scene.normalisation.scale;
        const double area = 0.5 * length(cross(m.vector(b - a), m.vector(c - a))) * s * s;
        // Corners are rounded to float: their error against the longest edge decides.
        const double edge = std::max(length(m.vector(b - a)), length(m.vector(c - a))) * s;
        const double bound = 1e-6 * edge * 4;
        EXPECT_NEAR(triangle_point(scene, 0, 0, 0, {}).area, area, bound);
        EXPECT_NEAR(triangle_point(scene, Hit::no_instance, 1, 0, {0.3f, 0.2f}).area, area, bound);
        // The same point of both is the same place, with the same normal.
        const TrianglePoint p = triangle_point(scene, 0, 0, 0, {0.3f, 0.2f});
        const TrianglePoint q =
            triangle_point(scene, Hit::no_instance, 1, 0, {0.2f, 0.3f});  // mirrored: corners swapped
        EXPECT_LE(length(p.p - q.p), 4e-6f);
        EXPECT_TRUE(area < 0.01 || dot(p.n, q.n) > 0.9999f);
    }
}

}  // namespace
}  // namespace lancer
