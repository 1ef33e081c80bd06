// Translucent sheets: in furnaces, against closed forms, and the same by every way to find light.
#include <gtest/gtest.h>

#include "support/ways.h"

namespace lancer {
namespace {

constexpr Color reflected{0.2f, 0.3f, 0.5f}, transmitted{0.7f, 0.6f, 0.1f};

// A sheet in the plane z = 0, as a mesh or as a plane, or turned round, looked at from z > 0 or from behind.
enum class Sheet { mesh, turned, plane };
constexpr std::array sheets{Sheet::mesh, Sheet::turned, Sheet::plane};

SceneDescription sheet_at(Sheet sheet, double from, double fov = 1e-4)
{
    SceneDescription d;
    d.materials = {make_translucent("paper", reflected, transmitted)};
    if (sheet == Sheet::plane) {
        d.planes = {plane_of({0, 0, 0}, {0, 0, 1}, "paper")};
    } else {
        const double w = sheet == Sheet::turned ? -4 : 4;
        d.meshes = {make_mesh(make_quad({-w, -4, 0}, {w, -4, 0}, {w, 4, 0}, {-w, 4, 0}))};
        d.meshes[0].material = "paper";
    }
    d.camera = make_camera({0.3, 0.2, from}, {0, 0, 0}, fov);
    return d;
}

void expect_color(const Film& film, Color expected, double relative, const std::string& what)
{
    const Color seen = film.at(1, 1).mean();
    for (const auto channel : {&Color::r, &Color::g, &Color::b})
        EXPECT_NEAR(seen.*channel, expected.*channel, relative * double{expected.*channel}) << what;
}

// f(request, name) for both integrators and both kernels.
template <class F>
void for_each_renderer(const F& f)
{
    for (const bool direct : {false, true})
        for (const bool by_one : {false, true}) {
            RenderRequest r;
            r.width = r.height = 4, r.spp = {16};
            r.settings.integrator = Path{};
            if (direct) r.settings.integrator = Direct{};
            if (by_one) r.settings.kernel.profile = Profile::all;
            f(r, std::string(direct ? "direct" : "path") + (by_one ? ", one by one" : ", eight at a time"));
        }
}

// Radiance T / pi E from behind and R / pi E from before, without noise.
TEST(TranslucentSheet, ShowsTheIrradianceOfPointsAndSuns)
{
    const double lamp = 3, height = 1.5;
    const Vec3d at{0.4, -0.3, height}, sun = normalize(Vec3d{0.3, 0.5, 1});
    const double by_point = lamp * height / std::pow(dot(at, at), 1.5), by_sun = lamp * sun.z;
    for (const Sheet sheet : sheets)
        for (const double side : {1.0, -1.0})
            for_each_renderer([&](const RenderRequest& r, const std::string& name) {
                const auto seen = [&](const LightDescription& light) {
                    SceneDescription d = sheet_at(sheet, 3 * side);
                    d.lights = {light};
                    return render(d, r).film;
                };
                const Color albedo = side > 0 ? reflected : transmitted;
                expect_color(seen(light_of(LightType::point, {3, 3, 3}, at)),
                             albedo * static_cast<float>(by_point / pi_d), 2e-5, name + ", point");
                expect_color(seen(directional_of({3, 3, 3}, -sun)), albedo * static_cast<float>(by_sun / pi_d), 2e-5,
                             name + ", sun");
            });
}

// E = pi L (r / d)^2 cos(theta). The camera looks past the ball.
TEST(TranslucentSheet, ShowsTheIrradianceOfABallByAllWays)
{
    stats::Family family;
    const double radius = 0.25;
    const Vec3d at{0.4, -0.3, 1.5};
    const double expected = 3 * radius * radius * at.z / std::pow(dot(at, at), 1.5);
    for (const Sheet sheet : sheets)
        for (const double side : {1.0, -1.0})
            for (size_t way = 0; way < ways.size(); ++way) {
                SceneDescription d = sheet_at(sheet, side > 0 ? 3.0 : -3.0);
                d.lights = {light_of(LightType::sphere, {3, 3, 3}, at, radius)};
                const stats::Tally t = tally(shoot(d, {.integrator = Path{.max_depth = 1, .direct = ways[way]},
                                                       .width = 8,
                                                       .height = 8,
                                                       .spp = 1024,
                                                       .sampler = SamplerKind::independent}));
                const double albedo = static_cast<double>(luminance(side > 0 ? reflected : transmitted));
                EXPECT_LE(t.error(), 0.05 * albedo * expected) << "too noisy to tell";
                family.add(stats::mean_p(t, albedo * expected, 2e-5), std::string(way_names[way]));
            }
}

// The near side of the light is what it is to paths; the far side is dark, and nothing passes on.
TEST(TranslucentSheet, IsOpaqueToClassicIntegrators)
{
    for (const char* name : {"whitted", "random-decision"})
        for (const double side : {1.0, -1.0}) {
            RenderRequest r;
            r.width = r.height = 4, r.spp = {16};
            RenderSettings settings;
            settings.integrator = value_of<IntegratorKind>(name).value();
            r.settings.integrator = make_integrator(settings);
            SceneDescription d = sheet_at(Sheet::mesh, 3 * side);
            d.lights = {directional_of({3, 3, 3}, {0, 0, -1})};
            expect_color(render(d, r).film, side > 0 ? reflected * (3 / pi) : Color{}, 2e-5, name);
        }
}

constexpr Color even_sky{0.5f, 1, 2};
constexpr double sky_luminance = 0.2126 * 0.5 + 0.7152 + 0.0722 * 2;

// In a uniform sky an open sheet shows R + T of it.
TEST(TranslucentFurnace, OpenSheetsShowBothParts)
{
    stats::Family family;
    for (const Sheet sheet : sheets)
        for (const double side : {1.0, -1.0})
            for (const float lost : {0.0f, 0.4f})
                for (size_t way = 0; way < ways.size(); ++way) {
                    SceneDescription d = sheet_at(sheet, 3 * side, 30);
                    d.materials[0].base_color = Color{0.25f, 0.25f, 0.25f} * (1 - lost);
                    d.materials[0].transmittance = Color{0.75f, 0.75f, 0.75f} * (1 - lost);
                    d.lights = {sky_of(even_sky)};
                    const Film film = shoot(d, {.integrator = Path{.direct = ways[way]},
                                                .width = 16,
                                                .height = 16,
                                                .spp = 64,
                                                .sampler = SamplerKind::independent});
                    for (const Pixel& p : film.pixels)
                        family.add(stats::mean_p(tally(p), sky_luminance * (1 - double{lost}), 1e-5),
                                   std::string(way_names[way]) + (lost > 0 ? ", grey" : ", white"));
                }
}

// Inside a shell of any thin material the light is even: L = T + R L of the sky's. Outside it shows R + T L.
TEST(TranslucentFurnace, ShellsShowTheGeometricSeries)
{
    stats::Family family;
    for (const auto& [r, t] : {std::pair{0.3, 0.7}, {0.6, 0.4}, {0.3, 0.5}, {0.0, 0.8}})
        for (const bool inside : {false, true})
            for (size_t way = 0; way < ways.size(); ++way) {
                const double within = t / (1 - r), seen = inside ? within : r + t * within;
                const auto grey = [](double x) {
                    const auto c = static_cast<float>(x);
                    return Color{c, c, c};
                };
                SceneDescription d;
                d.materials = {make_translucent("lantern", grey(r), grey(t))};
                d.spheres = {sphere_of({0, 0, 0}, 1, "lantern")};
                d.lights = {sky_of(even_sky)};
                d.camera = make_camera({0.1, 0.2, inside ? 0.3 : 3}, {0, 0, 0}, 24);  // nothing but the shell
                const Film film = shoot(d, {.integrator = Path{.direct = ways[way]},
                                            .width = 16,
                                            .height = 16,
                                            .spp = 256,
                                            .sampler = SamplerKind::independent});
                const stats::Tally all = tally(film);
                EXPECT_LE(all.error(), 0.005 * sky_luminance * seen) << "too noisy to tell";
                family.add(stats::mean_p(all, sky_luminance * seen, 1e-5),
                           std::to_string(r) + (inside ? ", inside, " : ", outside, ") + way_names[way]);
            }
}

// A closed cube, and a body that sees itself, of what loses nothing.
TEST(TranslucentFurnace, WhiteBodiesAreInvisible)
{
    stats::Family family;
    const MaterialDescription white = make_translucent("white", {0.5f, 0.25f, 1}, {0.5f, 0.75f, 0});
    for (const auto& mesh : {make_cube(white), make_uv_sphere(12, 24, 0.15, white)})
        for (size_t way = 0; way < ways.size(); ++way) {
            SceneDescription d;
            d.meshes = {make_mesh(mesh, {{0, 0, 0}, {20, 30, 40}, {0.8, 0.8, 0.8}})};
            d.lights = {sky_of(even_sky)};
            d.camera = make_camera({0.4, 0.5, 3}, {0, 0, 0}, 45);
            const Film film = shoot(d, {.integrator = Path{.direct = ways[way]},
                                        .width = 16,
                                        .height = 16,
                                        .spp = 128,
                                        .sampler = SamplerKind::independent});
            for (const Pixel& p : film.pixels) family.add(stats::mean_p(tally(p), sky_luminance, 1e-5), way_names[way]);
        }
}

// A lamp behind its shade: the room gets all of its light through paper, by every way to find it and with every plan.
SceneDescription shaded_lamp(bool many)
{
    SceneDescription d;
    d.meshes = {make_mesh(make_quad({-2, -1, 2}, {2, -1, 2}, {2, -1, -2}, {-2, -1, -2})),
                make_mesh(make_quad({-2, -1, -1.5}, {2, -1, -1.5}, {2, 2, -1.5}, {-2, 2, -1.5}))};
    d.materials = {make_translucent("paper", reflected, transmitted), make_lambert("grey", {0.6f, 0.6f, 0.6f})};
    d.materials[0].bump_map.emplace();
    d.materials[0].bump_map->type = TextureType::waves;
    d.materials[0].bump_map->waves = {{0.02, 0.4, 0.5, 0.3}};
    for (MeshDescription& m : d.meshes) m.material = "grey";
    d.meshes.push_back(make_mesh(make_cube(), {{-0.3, -0.2, -0.2}, {0, 30, 0}, {0.5, 0.5, 0.5}}));
    d.meshes.back().material = "paper";
    d.lights = {light_of(LightType::sphere, {8, 7, 5}, {-0.3, -0.2, -0.2}, 0.3)};
    for (int i = 0; many && i < 40; ++i)
        d.lights.push_back(light_of(LightType::sphere, {2, 2, 3}, {0.08 * i - 1.6, 1.2, 0.6}, 0.03));
    d.camera = make_camera({0.5, 0.5, 3.5}, {0, -0.2, 0}, 40);
    return d;
}

TEST(TranslucentSheet, LightsARoomTheSameByAllWays)
{
    const SameByAllWays same(0.03);
    same.add("a lamp in its shade", shaded_lamp(false), {.spp = 32}, Path{.max_depth = 5}, 8, {1, 2, 2});
}

// Of many lights, which a tree chooses, those behind the sheet count as well as those before it.
TEST(TranslucentSheet, IsLitByManyLightsOnBothSides)
{
    std::vector<TilesOverSeeds> found;
    for (const bool mis : {true, false})
        found.emplace_back(shaded_lamp(true), Shot{.integrator = Path{.max_depth = 3, .direct = {true, mis}},
                                                   .spp = mis ? 32u : 64u,
                                                   .seed = found.size() + 1});
    Path plain{.max_depth = 3};
    plain.split = plain.roulette_by_pixel = plain.learned_nee = false;
    found.emplace_back(shaded_lamp(true), Shot{.integrator = plain, .spp = 32, .seed = 3});
    expect_one_mean(std::move(found),
                    {.pictures = 8, .detectable = 0.04, .names = {"nee and mis", "nee", "without a plan"}},
                    "many lights about a sheet");
}

}  // namespace
}  // namespace lancer
