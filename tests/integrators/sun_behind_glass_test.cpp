// A room that a sun lights through a window. Light sampling of a directional light, which passes thin sheets of glass
// straight on, against brute force: a ball far away with the same irradiance, which BSDF sampling alone finds.
#include <gtest/gtest.h>

#include "materials/fresnel.h"
#include "materials/thin_sheet.h"
#include "support/shoot.h"

namespace lancer {
namespace {

const Vec3d to_sun = normalize(Vec3d{1, 0.5, 0.1});
constexpr float sun_irradiance = 5;

// Large enough to be hit by chance, small and far enough that the room is lit as by the sun, but for the soft edges.
LightDescription ball()
{
    constexpr double distance = 4000, sine = 0.1;
    const auto radiance = static_cast<float>(double{sun_irradiance} / (pi_d * sine * sine));
    return light_of(LightType::sphere, {radiance, radiance, radiance}, to_sun * distance, distance * sine);
}

// What closes the side of the room at x = 2.
struct WindowCase {
    std::string name;
    std::shared_ptr<const MeshData> data;  // null: open
};
std::vector<WindowCase> windows()
{
    MaterialDescription glass = make_glossy("glass", MaterialType::glass, {1, 1, 1}, 0);
    const std::vector<Vec3d> corners{{2, -0.1, -2.1}, {2, 3.1, -2.1}, {2, 3.1, 2.1}, {2, -0.1, 2.1}};
    MeshData slab = *make_cube(glass);
    for (Vec3d& p : slab.positions) p = {2.02 + 0.02 * p.x, 1.5 + 1.6 * p.y, 2.1 * p.z};
    return {{"open", {}},
            {"pane", make_mesh_data(corners, {{0, 1, 2}, {0, 2, 3}}, glass)},
            {"slab", std::make_shared<const MeshData>(slab)}};
}

// From -2 to 2 and up to 3.
SceneDescription room_with(const WindowCase& window, const LightDescription& sun)
{
    SceneDescription d;
    const auto add = [&](Vec3d a, Vec3d b, Vec3d c, Vec3d e) {
        d.meshes.push_back(make_mesh(make_quad(a, b, c, e, make_lambert("wall", {0.6f, 0.5f, 0.4f}))));
    };
    for (const double y : {0.0, 3.0}) add({-2, y, 2}, {2, y, 2}, {2, y, -2}, {-2, y, -2});
    for (const double z : {-2.0, 2.0}) add({-2, 0, z}, {2, 0, z}, {2, 3, z}, {-2, 3, z});
    add({-2, 0, 2}, {-2, 0, -2}, {-2, 3, -2}, {-2, 3, 2});
    if (window.data) d.meshes.push_back(make_mesh(window.data));
    d.lights = {sun};
    d.camera = make_camera({1.5, 1.6, 1.5}, {-2, 0.8, -2}, 80);
    return d;
}

// Pictures are of one tile, as the soft edges of the ball's light are not those of the sun.
TEST(SunBehindGlass, IsWhatBruteForceFinds)
{
    const double c = to_sun.x;
    const double through = 1 - reflectance_of_sheet(fresnel_dielectric_double(c, (1 - c) * (1 + c), 1.5).reflectance);
    double open = 0;
    for (const WindowCase& window : windows()) {
        const LightDescription sun = directional_of({sun_irradiance, sun_irradiance, sun_irradiance}, -to_sun);
        std::vector<TilesOverSeeds> ways;
        const auto add = [&](const LightDescription& light, const DirectLight& how, uint32_t spp) {
            ways.emplace_back(room_with(window, light), Shot{.integrator = Path{.max_depth = 5, .direct = how},
                                                             .width = 8,
                                                             .height = 8,
                                                             .spp = spp,
                                                             .seed = ways.size() + 1});
        };
        add(sun, {}, 64);
        add(ball(), {.nee = false}, 512);
        const double mean = expect_one_mean(
            std::move(ways),
            {.pictures = 16, .detectable = 0.04, .rounding = 0.005, .names = {"sun", "ball by brute force"}},
            window.name);
        if (window.data) {  // what the glass sends back into the room is a part of the rest
            EXPECT_NEAR(mean / open, through, 0.08 * through) << window.name;
        } else {
            open = mean;
        }
    }
}

}  // namespace
}  // namespace lancer
