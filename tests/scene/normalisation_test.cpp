// File units to scene units: exact by powers of two, moved only from afar, not impressed by what is infinite or huge.
#include <gtest/gtest.h>

#include <bit>
#include <cstring>

#include "support/stage.h"

namespace lancer {
namespace {

SceneDescription ball(Vec3d center, double radius)
{
    SceneDescription d;
    d.spheres.push_back(sphere_of(center, radius));
    d.lights.push_back(sky_of({1, 1, 1}));
    return d;
}

TEST(Normalisation, ScaleIsAPowerOfTwoThatBringsTheExtentNearOne)
{
    for (const double radius : {1.0, 3.0, 0.1, 1e-10, 1e-20, 777.0, 1e18, 1e19}) {
        const Scene s = build_scene(ball({}, radius));
        EXPECT_EQ(std::exp2(std::ilogb(s.normalisation.scale)), s.normalisation.scale);
        const double extent = 2 * radius * s.normalisation.scale;
        EXPECT_TRUE(extent >= 1 && extent < 2) << radius;
        EXPECT_EQ(s.geometry.spheres[0].radius, radius * s.normalisation.scale);
    }
}

TEST(Normalisation, MovesOnlyFromBeyondEightExtents)
{
    // The extent is 2: 16 is the limit.
    EXPECT_EQ(build_scene(ball({15.9, 0, 0}, 1)).normalisation.center, Vec3d{});
    EXPECT_EQ(build_scene(ball({16.0, 3, 0}, 1)).normalisation.center, Vec3d{});
    EXPECT_EQ(build_scene(ball({16.1, 3, 0}, 1)).normalisation.center, (Vec3d{16.1, 3, 0}));
    EXPECT_EQ(build_scene(ball({0, 0, -1e6}, 1)).normalisation.center, (Vec3d{0, 0, -1e6}));
}

TEST(Normalisation, GoesThereAndBack)
{
    const Normalisation n = build_scene(ball({1e6, 2e6, 0}, 3)).normalisation;
    const Vec3d p{1e6 + 0.5, 2e6 - 0.25, 2};
    EXPECT_EQ(n.to_file(n.to_scene(p)), p);
    EXPECT_EQ(n.to_scene({1e6, 2e6, 0}), Vec3d{});
}

TEST(Normalisation, GiantSpheresAndPlanesDoNotCount)
{
    const Normalisation alone = build_scene(ball({}, 1)).normalisation;
    SceneDescription d = ball({}, 1);
    d.spheres.push_back(sphere_of({0, -1e5, 0}, 1e5));
    d.spheres.push_back(sphere_of({1e5, 0, 0}, 1e5));
    d.planes.push_back(plane_of({0, -1000, 0}, {0, 1, 0}));
    const Scene s = build_scene(d);
    EXPECT_EQ(s.normalisation.scale, alone.scale);
    EXPECT_EQ(s.normalisation.center, alone.center);
    EXPECT_EQ(s.bounds.extent(), 2 * alone.scale);
    // A large sphere that is part of the subject does count.
    d.spheres[1] = sphere_of({0, -30, 0}, 30);
    EXPECT_LT(build_scene(d).normalisation.scale, alone.scale);
}

template <class T>
void expect_same_bytes(const std::vector<T>& a, const std::vector<T>& b, const std::string& what)
{
    ASSERT_EQ(a.size(), b.size()) << what;
    EXPECT_TRUE(a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0) << what;
}

// What is inside must be the very same numbers: then everything that follows is.
TEST(Normalisation, ASceneScaledByAPowerOfTwoHasTheSameNumbers)
{
    for (const auto& [name, description] : all_test_scenes()) {
        const Scene one = build_scene(description);
        const Camera camera = camera_of(description, one, 64, 48);
        for (const int k : {-20, -3, 1, 10, 20}) {
            const std::string what = name + std::string(" x 2^") + std::to_string(k);
            const SceneDescription scaled = scaled_by(description, std::ldexp(1.0, k));
            const Scene other = build_scene(scaled);
            EXPECT_EQ(other.normalisation.scale, std::ldexp(one.normalisation.scale, -k)) << what;
            for (size_t i = 0; i < one.geometry.meshes.size(); ++i) {
                expect_same_bytes(one.geometry.meshes[i].positions, other.geometry.meshes[i].positions, what);
                expect_same_bytes(one.shading[i].normals.values, other.shading[i].normals.values, what);
            }
            expect_same_bytes(one.geometry.spheres, other.geometry.spheres, what);
            expect_same_bytes(one.geometry.planes, other.geometry.planes, what);
            ASSERT_EQ(one.geometry.instances.size(), other.geometry.instances.size());
            for (size_t i = 0; i < one.geometry.instances.size(); ++i)
                EXPECT_TRUE(std::memcmp(&one.geometry.instances[i].to_world, &other.geometry.instances[i].to_world,
                                        sizeof(Transform)) == 0)
                    << what;
            ASSERT_EQ(one.lights.lights.size(), other.lights.lights.size()) << what;
            for (uint32_t i = 0; i < one.lights.lights.size(); ++i) {
                EXPECT_EQ(one.lights.pick.probability(i), other.lights.pick.probability(i)) << what;
                if (const auto* p = std::get_if<PointLight>(&one.lights.lights[i])) {
                    EXPECT_EQ(p->position, std::get<PointLight>(other.lights.lights[i]).position) << what;
                    EXPECT_EQ(p->intensity, std::get<PointLight>(other.lights.lights[i]).intensity) << what;
                }
            }
            const Ray a = camera.ray({3.5f, 7.25f}, {0.1f, 0.7f});
            const Ray b = camera_of(scaled, other, 64, 48).ray({3.5f, 7.25f}, {0.1f, 0.7f});
            EXPECT_TRUE(a.org == b.org && a.dir == b.dir) << what;
        }
    }
}

// A mirroring transform turns the winding round, not the side that a face shows; in place and as an instance.
TEST(Mirrored, KeepsItsFront)
{
    for (const bool instanced : {false, true})
        for (const Vec3d scale :
             {Vec3d{1, 1, 1}, Vec3d{-1, 1, 1}, Vec3d{1, -2, 1}, Vec3d{1, 1, -0.5}, Vec3d{-1, -1, -1}}) {
            SceneDescription d;
            d.meshes.push_back(make_mesh(make_uv_sphere(8, 16)));
            d.lights.push_back(sky_of({1, 1, 1}));
            d.meshes[0].name = "ball";
            const TransformDescription t{{0.1, 0.2, 0.3}, {20, 30, 40}, scale};
            if (instanced) {
                d.instances.push_back(instance_of("ball", t));
            } else {
                d.meshes[0].transform = t;
            }
            const Stage stage(d);
            const Vec3 center = stage.to_scene({0.1, 0.2, 0.3});
            for (const Vec3 w : {Vec3{1, 0.1f, 0.2f}, Vec3{-0.3f, 1, 0}, Vec3{0.2f, 0.3f, -1}}) {
                const auto outside = stage.look(center - w * 9.0f, w), inside = stage.look(center, w);
                ASSERT_TRUE(outside && inside);
                EXPECT_TRUE(outside->front) << scale.x << scale.y << scale.z << instanced;
                EXPECT_FALSE(inside->front) << scale.x << scale.y << scale.z << instanced;
                EXPECT_LT(dot(outside->n, w), 0);
                EXPECT_LT(dot(inside->n, w), 0);
            }
        }
}

}  // namespace
}  // namespace lancer
