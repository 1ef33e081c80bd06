// The lamp of the Cornell box lies in the ceiling: high on the walls it is seen at a grazing angle, from one side of
// its plane. How bright the walls are there has a closed form.
#include <gtest/gtest.h>

#include "reference/same_light.h"
#include "reference/shipped.h"
#include "reference/surface.h"

namespace lancer {
namespace {

using reference::Vec;

// Irradiance at p by a polygon of even radiance 1 that lies above p's horizon: Lambert, "Photometria", 1760; Arvo,
// "Analytic Methods for Simulated Light Transport", 1995, section 2.3. Each edge adds the angle under which it is seen,
// times the cosine between n and the normal of the plane through p and the edge.
double irradiance(Vec p, Vec n, const std::vector<Vec>& corners)
{
    double sum = 0;
    for (size_t i = 0; i < corners.size(); ++i) {
        const Vec a = unit(corners[i] - p), b = unit(corners[(i + 1) % corners.size()] - p), across = cross(a, b);
        sum += std::atan2(norm(across), dot(a, b)) * dot(n, unit(across));
    }
    return std::abs(sum) / 2;
}

// The Cornell box with its lamp, seen from its middle through a small window on a place.
struct Room {
    SceneDescription d = shipped_scene("cornell");
    reference::World world{d, {}};
    std::vector<Vec> lamp;  // its corners in order
    reference::Rgb radiance;

    Room()
    {
        for (const reference::Triangle& t : world.triangles) {
            const reference::Rgb e = reference::rgb(world.materials[t.material].what.emission);
            if (black(e)) continue;
            radiance = e;
            if (lamp.empty())
                lamp = {t.a, t.b, t.c};
            else
                lamp.push_back(t.c);  // of a fan
        }
    }
    void look_at(Vec3d place, double fov_deg)
    {
        d.camera = make_camera({2.78, place.y < 5.2 ? place.y : 5.2, 2.8}, place, fov_deg);
    }
    // What the camera should see, in luminance.
    double expected(uint32_t size) const
    {
        constexpr uint32_t fine = 4;
        double sum = 0;
        for (uint32_t y = 0; y < fine * size; ++y)
            for (uint32_t x = 0; x < fine * size; ++x) {
                const reference::Ray ray =
                    reference::camera_ray(*d.camera, (x + 0.5) / fine, (y + 0.5) / fine, size, size);
                const reference::Surface s = surface_at(world, ray, closest(world, ray));
                const reference::Rgb albedo = reference::rgb(world.materials[s.material].what.base_color);
                sum += luminance(albedo * radiance) * irradiance(s.p, s.n, lamp) / reference::pi;
            }
        return sum / (fine * fine * size * size);
    }
};

struct Place {
    const char* name;
    Vec3d at;
};

class Walls : public testing::TestWithParam<Place> {};

TEST_P(Walls, GetWhatLambertsFormulaSays)
{
    constexpr uint32_t size = 16;
    Room room;
    ASSERT_EQ(room.lamp.size(), 4u);
    room.look_at(GetParam().at, 0.5);
    const double expected = room.expected(size);
    ASSERT_GT(expected, 0);
    for (const bool mis : {true, false}) {
        Path path;
        path.max_depth = 1;
        path.direct.mis = mis;
        Shot shot{
            .integrator = path, .width = size, .height = size, .spp = 2048, .sampler = SamplerKind::sobol, .seed = 5};
        const stats::Tally found = tally(shoot(room.d, shot));
        EXPECT_LT(std::abs(found.mean - expected), 4 * found.error() + 2e-6 * expected)
            << found.mean << " for " << expected;
        EXPECT_NEAR(found.mean, expected, 1e-3 * expected);
        std::printf("%s, %s: %.6f for %.6f, %+.3f %%, one sigma %.3f %%\n", GetParam().name, mis ? "mis" : "nee",
                    found.mean, expected, 100 * (found.mean / expected - 1), 100 * found.error() / expected);
    }
}

// The ceiling is at 5.488, the lamp at 5.487.
INSTANTIATE_TEST_SUITE_P(Cornell, Walls,
                         testing::Values(Place{"right_wall_5", {0, 5, 2.8}}, Place{"right_wall_5_4", {0, 5.4, 2.8}},
                                         Place{"right_wall_5_47", {0, 5.47, 1}},
                                         Place{"left_wall_5_3", {5.55, 5.3, 2.8}},
                                         Place{"left_wall_5_45", {5.555, 5.45, 4}},
                                         Place{"back_wall_5_2", {2.8, 5.2, 5.592}},
                                         Place{"back_wall_5_45", {1, 5.45, 5.592}}),
                         [](const testing::TestParamInfo<Place>& which) { return which.param.name; });

}  // namespace
}  // namespace lancer
