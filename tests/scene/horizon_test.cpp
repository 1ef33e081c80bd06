// Regression: an infinite plane fills what lies below the horizon, all of it and nothing else; also one that does not
// go through the origin, and nothing of one behind the camera. tests/mutations/plane_missed.patch puts the fault back.
#include <gtest/gtest.h>

#include "support/random.h"
#include "support/stage.h"

namespace lancer {
namespace {

struct Seen {
    int plane = 0, above = 0;
};

// Every ray of a picture, by both accelerators.
Seen look_at_plane(SceneDescription d, const CameraDescription& camera)
{
    constexpr uint32_t width = 48, height = 40;
    d.camera = camera;
    d.spheres.push_back(sphere_of({0, 30, 0}, 1));  // gives the scene its size
    d.lights.push_back(sky_of({1, 1, 1}));
    const Stage stage(d);
    const Camera rays = camera_of(d, stage.scene, width, height);
    Seen seen;
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            const Ray ray = rays.ray({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f}, {});
            const Hit hit = stage.list.closest(ray);
            EXPECT_EQ(hit.kind, stage.embree->closest(ray).kind) << x << ' ' << y;
            if (hit.kind == Kind::sphere) continue;
            const Vec3d n = normalize(d.planes[0].normal);
            const double to_plane = dot(d.planes[0].point - camera.position, n), along = dot(to_double(ray.dir), n);
            EXPECT_EQ(hit.kind == Kind::plane, to_plane * along > 0) << x << ' ' << y;
            ++(hit.kind == Kind::plane ? seen.plane : seen.above);
        }
    return seen;
}

TEST(Horizon, ThePlaneFillsTheHalfBelowIt)
{
    for (const double floor : {0.0, -3.0, 7.5, 1e4}) {
        SceneDescription d;
        d.planes.push_back(plane_of({2, floor, -5}, {0, 1, 0}));
        const Seen level = look_at_plane(d, make_camera({1, floor + 2, 8}, {0, floor + 2, 0}, 50));
        EXPECT_EQ(level.plane, 48 * 20) << floor;
        EXPECT_EQ(level.above, 48 * 20) << floor;
        EXPECT_EQ(look_at_plane(d, make_camera({0, floor + 2, 8}, {0, floor - 18, 0}, 50)).above, 0)
            << "straight at it";
        EXPECT_EQ(look_at_plane(d, make_camera({0, floor + 2, 8}, {0, floor + 19, 0}, 50)).plane, 0)
            << "all of it behind the camera, " << floor;
        EXPECT_EQ(look_at_plane(d, make_camera({1, floor - 2, 8}, {0, floor - 2, 0}, 50)).plane, 48 * 20)
            << "from below";
    }
}

TEST(Horizon, OfAnyPlaneFromAnywhere)
{
    Random random(1);
    for (int k = 0; k < 50; ++k) {
        SceneDescription d;
        const Vec3d point = random.point(-9, 9);
        d.planes.push_back(plane_of(point, random.direction() * 3.0));
        const Vec3d eye = random.point(-9, 9);
        look_at_plane(d, make_camera(eye, eye + random.direction(), 70));
    }
}

}  // namespace
}  // namespace lancer
