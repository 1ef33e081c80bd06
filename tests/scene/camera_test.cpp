// From film to rays, by geometry.
#include <gtest/gtest.h>

#include "support/random.h"
#include "support/scenes/scenes.h"

namespace lancer {
namespace {

const Normalisation plain{};

TEST(Camera, PinholeLooksThroughKnownPixels)
{
    CameraDescription c = make_camera({0, 0, 5}, {0, 0, 0}, 90);
    const Camera camera(c, plain, 200, 100);
    const auto along = [&](float x, float y) { return camera.ray({x, y}, {}).dir; };
    EXPECT_LE(length(along(100, 50) - Vec3{0, 0, -1}), 1e-7f);
    // 90 degrees from top to bottom: half the height is one unit at distance one; y goes down.
    EXPECT_LE(length(along(100, 0) - normalize(Vec3{0, 1, -1})), 1e-6f);
    EXPECT_LE(length(along(100, 100) - normalize(Vec3{0, -1, -1})), 1e-6f);
    EXPECT_LE(length(along(0, 50) - normalize(Vec3{-2, 0, -1})), 1e-6f);
    EXPECT_LE(length(along(200, 0) - normalize(Vec3{2, 1, -1})), 1e-6f);
    EXPECT_EQ(camera.ray({3, 4}, {0.2f, 0.9f}).org, (Vec3{0, 0, 5}));
}

TEST(Camera, FieldOfViewIsVertical)
{
    for (const double fov : {1.0, 40.0, 120.0, 179.0})
        for (const uint32_t width : {10u, 300u}) {
            const Camera camera(make_camera({0, 0, 0}, {0, 0, -1}, fov), plain, width, 100);
            const Vec3 top = camera.ray({0.5f * static_cast<float>(width), 0}, {}).dir;
            const Vec3 bottom = camera.ray({0.5f * static_cast<float>(width), 100}, {}).dir;
            const double angle =
                std::atan2(static_cast<double>(length(cross(top, bottom))), static_cast<double>(dot(top, bottom)));
            EXPECT_NEAR(angle, fov * std::numbers::pi / 180, 1e-5);
        }
}

// One row lower on the film: what the student's program computed for pixel (j, i) of a square picture.
TEST(Camera, TheShiftedGridLooksOneRowHigher)
{
    constexpr uint32_t side = 512;
    const Camera camera(make_camera({0, 0, 55}, {0, 0, 0}, 60), plain, side, side, PixelGrid::shifted);
    for (const auto& [j, i] : {std::pair{0, 0}, {511, 0}, {17, 300}, {255, 511}}) {
        const Vec3d expected =
            normalize(Vec3d{j - 256 + 0.5, 256 - i + 0.5, -512 / (2 * std::tan(std::numbers::pi / 6))});
        const Vec3 got = camera.ray({static_cast<float>(j) + 0.5f, static_cast<float>(i) + 0.5f}, {}).dir;
        EXPECT_LE(length(to_double(got) - expected), 2e-7) << j << ", " << i;
    }
}

// What the course's program did: from the directions of the corners those of the two ends of a row, normalised, and
// between them the pixel's.
TEST(Camera, TheGridOfCornersReachesFromEdgeToEdge)
{
    for (const auto& [width, height] : {std::pair{7u, 5u}, {600u, 400u}, {1u, 1u}}) {
        const CameraDescription c = make_camera({1, 2, 3}, {-1, 0.5, 0}, 45);
        const Camera camera(c, plain, width, height, PixelGrid::corners), usual(c, plain, width, height);
        const auto w = static_cast<float>(width), h = static_cast<float>(height);
        const auto corner = [&](float x, float y) { return to_double(usual.ray({x, y}, {}).dir); };
        const Vec3d ul = corner(0, 0), ur = corner(w, 0), ll = corner(0, h), lr = corner(w, h);
        const auto part = [](uint32_t i, uint32_t count) { return count > 1 ? double(i) / (count - 1) : 0.5; };
        const auto lerp = [](Vec3d a, Vec3d b, double t) { return a * (1 - t) + b * t; };
        for (uint32_t y = 0; y < height; y += 1 + height / 7)
            for (uint32_t x = 0; x < width; x += 1 + width / 7) {
                const double ty = part(y, height), tx = part(x, width);
                const Vec3d expected = normalize(lerp(normalize(lerp(ul, ll, ty)), normalize(lerp(ur, lr, ty)), tx));
                const Vec3 got = camera.ray({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f}, {}).dir;
                EXPECT_LE(length(to_double(got) - expected), 5e-7) << x << ", " << y << " of " << width;
            }
    }
}

TEST(Camera, UpAndRightInAnyDirection)
{
    Random random(1);
    for (int i = 0; i < 100; ++i) {
        CameraDescription c = make_camera(random.point(-5, 5), random.point(-5, 5), 50);
        c.up = random.point(-1, 1);
        const Camera camera(c, plain, 64, 64);
        const Vec3d forward = normalize(c.target - c.position), right = normalize(cross(forward, c.up));
        const Vec3 centre = camera.ray({32, 32}, {}).dir;
        EXPECT_LE(length(to_double(centre) - forward), 1e-6);
        EXPECT_GT(dot(to_double(camera.ray({60, 32}, {}).dir), right), 0.1) << "x to the right";
        EXPECT_GT(dot(to_double(camera.ray({32, 4}, {}).dir), cross(right, forward)), 0.1) << "y down";
        EXPECT_GT(dot(cross(right, forward), c.up), 0);
        EXPECT_NEAR(length(camera.ray({1, 2}, {}).dir), 1, 1e-6f);
    }
}

TEST(Camera, EightDirectionsAreThoseOfSingleRays)
{
    Random random(3);
    for (int round = 0; round < 100; ++round) {
        const Camera camera(make_camera(random.point(-9, 9), random.point(-1, 1), 1 + 100 * random.unit()), plain, 80,
                            60);
        Vec2x8 film;
        for (uint32_t i = 0; i < float_lanes; ++i)
            film.x[i] = static_cast<float>(80 * random.unit()), film.y[i] = static_cast<float>(60 * random.unit());
        const Vec3x8 dir = camera.middle_directions(film);
        for (uint32_t i = 0; i < float_lanes; ++i)
            EXPECT_EQ(lane(dir, i), camera.middle_ray({film.x[i], film.y[i]}).dir);
    }
}

// All rays of one film point meet in the plane in focus, where the ray through the middle of the lens meets it.
TEST(Camera, ThinLensRaysMeetInFocus)
{
    CameraDescription c = make_camera({1, 2, 3}, {-1, 0.5, 0}, 50);
    c.type = CameraType::thin_lens;
    c.aperture = 0.25;
    for (const std::optional<double> focus : {std::optional<double>{}, std::optional<double>{7.0}}) {
        c.focus = focus;
        const Normalisation n{{0.5, 0, 0}, 0.25};
        const Camera camera(c, n, 80, 60);
        const Vec3d forward = normalize(c.target - c.position), eye = n.to_scene(c.position);
        const double distance = (focus ? *focus : length(c.target - c.position)) * n.scale;
        Random random(2);
        double widest = 0;
        for (int i = 0; i < 200; ++i) {
            const Vec2 film{80 * random.unit(), 60 * random.unit()};
            const auto meets = [&](const Ray& r) {
                const Vec3d o = to_double(r.org), d = to_double(r.dir);
                return o + d * ((distance - dot(o - eye, forward)) / dot(d, forward));
            };
            const Ray a = camera.ray(film, random.unit2()), b = camera.ray(film, {0.5f, 0.5f});
            EXPECT_LE(length(meets(a) - meets(b)), 1e-6 * distance);
            EXPECT_LE(length(to_double(b.org) - eye), 1e-6) << "the middle of the lens";
            EXPECT_NEAR(dot(to_double(a.org) - eye, forward), 0, 1e-6) << "the lens is flat";
            widest = std::max(widest, length(to_double(a.org) - eye));
        }
        EXPECT_LE(widest, 0.25 * n.scale * (1 + 1e-5));
        EXPECT_GE(widest, 0.9 * 0.25 * n.scale);
    }
}

TEST(Camera, PinholeHasNoLens)
{
    CameraDescription c = make_camera({1, 2, 3}, {-1, 0.5, 0}, 50);
    c.aperture = 0.25;  // of no effect unless the type says so
    const Camera camera(c, plain, 80, 60);
    EXPECT_EQ(camera.ray({1, 1}, {0.9f, 0.1f}).org, camera.ray({1, 1}, {0.1f, 0.2f}).org);
}

// The whole subject is in the picture, whatever its shape, and the camera outside it.
TEST(Camera, FittedCameraSeesAll)
{
    for (const auto& [name, d] : all_test_scenes())
        for (const uint32_t width : {40u, 100u, 300u}) {
            const Bounds b = subject_bounds(d);
            const CameraDescription c = fit_camera(b, width / 100.0);
            const Vec3d forward = normalize(c.target - c.position);
            const Vec3d right = normalize(cross(forward, c.up)), up = cross(right, forward);
            const double half = std::tan(c.fov_deg * std::numbers::pi / 360);
            for (int corner = 0; corner < 8; ++corner) {
                const Vec3d p = Vec3d{corner & 1 ? b.upper.x : b.lower.x, corner & 2 ? b.upper.y : b.lower.y,
                                      corner & 4 ? b.upper.z : b.lower.z} -
                                c.position;
                const double z = dot(p, forward);
                EXPECT_GT(z, 0) << name;
                EXPECT_LE(std::abs(dot(p, right)), z * half * width / 100.0 * (1 + 1e-9)) << name;
                EXPECT_LE(std::abs(dot(p, up)), z * half * (1 + 1e-9)) << name;
            }
        }
}

}  // namespace
}  // namespace lancer
