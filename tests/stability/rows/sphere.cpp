// Rows P of the stability matrix: spheres and planes.
#include "app/run_program.h"
#include "stability/double_room.h"
#include "stability/pictures.h"
#include "stability/sphere_cases.h"

namespace lancer::stability {
namespace {

Path plain_path(uint32_t max_depth = 0, DirectLight direct = {})
{
    return {.max_depth = max_depth, .direct = direct, .split = false, .roulette_by_pixel = false};
}
// By the BSDF alone and without roulette: every sample of a closed form is the closed form.
Path no_noise(uint32_t max_depth)
{
    Path path = plain_path(max_depth, {false, false});
    path.roulette_depth = 1000000;
    return path;
}

// A room between spheres of radius 1e5 with a ball in it, the ceiling shining; against the same in double.
void compare_with_double(const Setup& setup, Outcome& out)
{
    constexpr uint32_t size = 24, vertices = 4;
    constexpr double r = 1e5, fov_deg = 60;
    SceneDescription d;
    std::vector<DoubleRoom::Ball> balls;
    const auto add = [&](Vec3d center, double radius, double emission) {
        MaterialDescription m = make_lambert("m" + std::to_string(balls.size()), {0.6f, 0.6f, 0.6f});
        m.emission = Color{1, 1, 1} * static_cast<float>(emission);
        d.spheres.push_back(sphere_of(center, radius, m.name));
        d.materials.push_back(std::move(m));
        balls.push_back({center, radius, static_cast<double>(0.6f), emission});
    };
    for (const Vec3d axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}})
        for (const double side : {-1.0, 1.0}) add(axis * (side * (r + 1)), r, axis.y > 0 && side > 0 ? 1 : 0);
    add({0.3, -0.7, 0.2}, 0.3, 0);
    d.camera = make_camera({0, 0, 0.9}, {0, 0, 0}, fov_deg);
    const CountedShot shot{.width = size,
                           .height = size,
                           .spp = static_cast<uint32_t>(setup.scaled(8, 256, 1024)),
                           .integrator = plain_path(vertices),
                           .seed = 1};
    const auto pictures = static_cast<uint32_t>(setup.scaled(16, 32, 64));
    const auto product = tiles_over_seeds(d, shot, pictures, out);

    DoubleRoom room(std::move(balls), 1);
    std::vector<stats::Tally> exact(product.size());
    const double half = std::tan(fov_deg / 2 * pi_d / 180);
    for (uint32_t k = 0; k < pictures; ++k) {
        std::vector<double> sum(exact.size());
        for (uint32_t y = 0; y < size; ++y)
            for (uint32_t x = 0; x < size; ++x)
                for (uint32_t i = 0; i < shot.spp; ++i) {
                    const double u = (x + room.uniform()) / size * 2 - 1, v = 1 - (y + room.uniform()) / size * 2;
                    const double l = room.sample({0, 0, 0.9}, normalize(Vec3d{u * half, v * half, -1}), vertices);
                    sum[size_t{y / 8} * (size / 8) + x / 8] += l / (64.0 * shot.spp);
                }
        for (size_t i = 0; i + 1 < sum.size(); ++i) sum.back() += sum[i] / static_cast<double>(sum.size() - 1);
        for (size_t i = 0; i < sum.size(); ++i) exact[i].add(sum[i]);
    }
    LeastP least;
    least.add(product, exact);
    out.measures.push_back(least.measure("least p of Welch's tests of the room, radius 1e5, against double"));
    out.measures.push_back(detectable(product, exact));
}
Outcome wall_spheres(const Setup& setup)
{
    Outcome out = wall_walk(setup);
    compare_with_double(setup, out);
    return out;
}

// The part of a picture that a ball of light covers.
Outcome far_spheres(const Setup& setup)
{
    Outcome out;
    for (const auto& [radius, distance] : {std::pair{1e-4, 1e3}, {1e-3, 1e3}, {1.0, 1e5}, {1.0, 1e2}})
        for (const Vec3d from : {Vec3d{0, 0, 1}, normalize(Vec3d{1, 2, 3})}) {
            // Aslant, a direction in float is half as coarse as that ball is wide.
            if (radius < 2e-7 * distance && from.x > 0) continue;
            const double angle = std::asin(radius / distance), half = 1.5 * std::tan(angle);
            SceneDescription d;
            d.lights.push_back(light_of(LightType::sphere, {1, 1, 1}, {0, 0, 0}, radius));
            d.camera = make_camera(from * distance, {0, 0, 0}, 2 * std::atan(half) * 180 / pi_d);
            const double expected = pi_d * std::pow(std::tan(angle) / half, 2) / 4;
            CountedShot shot{.width = 64, .height = 64, .spp = static_cast<uint32_t>(setup.scaled(64, 256, 1024))};
            shot.integrator = no_noise(1);
            const std::string where = ", radius over distance 1e" +
                                      std::to_string(std::lround(std::log10(radius / distance))) +
                                      (from.x > 0 ? ", aslant" : "");
            const double sobol = mean_luminance(take(d, shot, out));
            out.measures.push_back(
                at_most("error of the covered part, relative" + where, std::abs(sobol / expected - 1), 1e-3));
            shot.sampler = SamplerKind::independent;
            // Hit or not: the variance is known.
            const double n = 64.0 * 64 * shot.spp, part = mean_luminance(take(d, shot, out));
            out.measures.push_back(at_most("error by independent samples, sigma" + where,
                                           std::abs(part - expected) / std::sqrt(expected * (1 - expected) / n), 4));
        }
    return out;
}

Outcome odd_radii(const Setup&)
{
    const TempFolder folder;
    const auto render = [&](const std::string& balls) {
        write_bytes(folder.file("s.toml"),
                    "version = 1\n[[light]]\ntype = \"environment\"\nradiance = [1, 1, 1]\n" + balls);
        return run_program(folder, {"render", "s.toml", "-o", "s.exr", "--size", "8x8", "-s", "4"});
    };
    double codes = 0, unnamed = 0;
    for (const char* radius : {"0", "-0.0", "-1", "nan", "inf", "-inf", "\"wide\""}) {
        const Said said = render("[[sphere]]\nradius = " + std::string(radius) + "\n");
        codes += said.code != 65;
        unnamed += said.err.find("s.toml:6:") == std::string::npos || said.err.find("error: ") == std::string::npos;
    }
    // Large alone is a matter of units; large beside what is small is a wall, up to a limit that is an error.
    const auto is_shown = [&](const std::string& balls) {
        std::filesystem::remove(folder.file("s.exr"));
        const Said said = render(balls);
        if (said.code == 65) return said.err.find("too far") != std::string::npos;
        if (said.code != 0) return false;
        // Grey, and not the sky all over.
        double least = 1;
        for (const Color& c : read_exr(folder.file("s.exr")).pixels) least = std::min(least, double{luminance(c)});
        return least > 0.01 && least < 0.99;
    };
    double lost = 0;
    for (const char* radius : {"1e-30", "1e15", "1e19", "1e30"})
        lost += !is_shown("[[sphere]]\nradius = " + std::string(radius) + "\n");
    for (const char* radius : {"1e5", "1e10", "1e14", "1e19", "1e30"})
        lost += !is_shown(
            "[camera]\nposition = [0, 3, 6]\ntarget = [0, 0, 0]\n[[sphere]]\ncenter = [0, 1, 0]\n[[sphere]]\n"
            "center = [0, -" +
            std::string(radius) + ", 0]\nradius = " + radius + "\n");
    Outcome out;
    out.measures = {at_most("exit codes other than 65 of 7 radii that are none", codes, 0),
                    at_most("messages that do not name the line", unnamed, 0),
                    at_most("radii up to 1e30 that are neither shown nor refused", lost, 0)};
    return out;
}

MaterialDescription shining(const char* name, float albedo, float emission)
{
    MaterialDescription m = make_lambert(name, {albedo, albedo, albedo});
    m.emission = {emission, emission, emission};
    m.emission_both_sides = true;
    return m;
}
Outcome camera_in_spheres(const Setup&)
{
    Outcome out;
    double worst = 0, pictures = 0;
    const auto look = [&](const SceneDescription& d, uint32_t depth, double expected) {
        for (const AccelKind accel : judged_kinds) {
            const Film film =
                take(d, {.width = 12, .height = 12, .spp = 4, .integrator = no_noise(depth), .accel = accel}, out);
            for (const Pixel& p : film.pixels) worst = std::max(worst, std::abs(p.sum[1] / p.n / expected - 1));
            ++pictures;
        }
    };
    // Inside a ball that shines with 1 and reflects a half: 2 (1 - 1/2^(depth + 1)). From its surface outwards: the
    // sky.
    SceneDescription furnace;
    furnace.materials = {shining("wall", 0.5f, 1)};
    furnace.spheres.push_back(sphere_of({}, 1, "wall"));
    furnace.lights.push_back(sky_of({0.25f, 0.25f, 0.25f}));
    for (const double x : {0.0, 0.5, 1 - 1e-6, 1.0}) {
        furnace.camera = make_camera({x, 0, 0}, {x - 1, 0, 0}, 90);
        look(furnace, 6, 2 - 1.0 / 64);
        furnace.camera = make_camera({x, 0, 0}, {x + 1, 0, 0}, 90);
        look(furnace, 6, x == 1 ? 0.25 : 2 - 1.0 / 64);
    }
    // Between two shells: each fills a picture of its own.
    SceneDescription shells;
    shells.materials = {shining("inner", 0, 0.5f), shining("outer", 0, 3)};
    shells.spheres = {sphere_of({}, 0.999, "inner"), sphere_of({}, 1, "outer")};
    shells.lights.push_back(sky_of({0.25f, 0.25f, 0.25f}));
    for (const double x : {0.9991, 0.9995, 0.9999}) {
        shells.camera = make_camera({x, 0, 0}, {0, 0, 0}, 60);
        look(shells, 1, 0.5);
        shells.camera = make_camera({x, 0, 0}, {2, 0, 0}, 60);
        look(shells, 1, 3);
    }
    // In glass of index n a constant sky L is n^2 L, wherever no ray is reflected totally for ever.
    SceneDescription glass;
    for (const float ior : {1.0f, 1.5f}) {
        glass.materials = {make_glossy("glass", MaterialType::glass, {1, 1, 1}, 0)};
        glass.materials[0].ior = ior;
        glass.spheres = {sphere_of({}, 1, "glass")};
        glass.lights = {sky_of({0.25f, 0.25f, 0.25f})};
        for (const double x : {0.0, 0.3, 0.6}) {
            glass.camera = make_camera({x, 0, 0}, {x, 0, -1}, 120);
            look(glass, 0, 0.25 * static_cast<double>(ior * ior));
        }
    }
    out.measures = {at_most("error of a pixel, relative", worst, 1e-6), told("pictures", pictures)};
    return out;
}

Outcome planes_in_place(const Setup& setup)
{
    Outcome out;
    double bias = 0;
    const auto by_all_ways = [&](const SceneDescription& d, const std::string& what) {
        LeastP least;
        const auto pictures = static_cast<uint32_t>(setup.scaled(16, 32, 64));
        CountedShot shot{.spp = static_cast<uint32_t>(setup.scaled(6, 128, 256)), .seed = 1};
        const auto by = [&](DirectLight direct) {
            shot.integrator = plain_path(4, direct), ++shot.seed;
            return tiles_over_seeds(d, shot, pictures, out);
        };
        const auto reference = by({true, true}), lights = by({true, false}), scattering = by({false, false});
        least.add(reference, lights), least.add(reference, scattering);
        out.measures.push_back(least.measure("least p of Welch's tests, three ways to find light, " + what));
        bias = std::max(bias, detectable(reference, scattering).value);
    };
    const auto scene = [] {
        SceneDescription d;
        d.materials = {make_lambert("dark", {0.2f, 0.2f, 0.2f}), make_lambert("light", {0.8f, 0.8f, 0.8f}),
                       make_emitter("lamp", {1, 1, 1})};
        d.spheres.push_back(sphere_of({0, 0.5, 0}, 0.5, "light"));
        // Large: what is rarely found by chance alone is not yet normal in a few pictures.
        d.lights.push_back(light_of(LightType::sphere, {1.5f, 1.5f, 1.5f}, {1, 3, 1.5}, 1.4));
        d.lights.push_back(sky_of({0.2f, 0.2f, 0.2f}));
        d.camera = make_camera({0, 1.2, 4}, {0, 0.4, 0}, 35);
        return d;
    };
    SceneDescription coincident = scene();
    coincident.planes = {plane_of({}, {0, 1, 0}, "dark"), plane_of({3, 0, 1}, {0, 1, 0}, "light")};
    by_all_ways(coincident, "two planes in one place");
    SceneDescription middle = scene();
    middle.planes = {plane_of({0, 0.5, 0}, {0, 1, 0}, "light")};
    by_all_ways(middle, "a plane through a ball");
    SceneDescription shines = scene();
    shines.planes = {plane_of({}, {0, 1, 0}, "light"), plane_of({0, 3, 0}, {0, -1, 0}, "lamp")};
    by_all_ways(shines, "a plane that shines");
    out.measures.push_back(told("bias of the whole that would show, relative", bias));
    return out;
}

// A black ball of radius 1 on a floor of albedo 0.8 under a sky of 1: at a distance d from where it touches the floor
// the ball hides (1 + d^2)^(-3/2) of the light.
SceneDescription ball_on_floor(double gap)
{
    SceneDescription d;
    d.materials = {make_lambert("floor", {0.8f, 0.8f, 0.8f}), make_lambert("ball", {0, 0, 0})};
    d.planes = {plane_of({}, {0, 1, 0}, "floor")};
    d.spheres = {sphere_of({0, 1 + gap, 0}, 1, "ball")};
    d.lights = {sky_of({1, 1, 1})};
    d.camera = make_camera({2, 1.5, 5}, {0, 0.7, 0}, 35);
    return d;
}
Outcome resting_ball(const Setup& setup)
{
    Outcome out;
    double differ = 0;
    LeastP least;
    for (const double gap : {0.0, 1e-7, -1e-7}) {
        SceneDescription d = ball_on_floor(gap);
        for (const AccelKind accel : judged_kinds) {
            const CountedShot shot{.width = 16, .height = 12, .spp = 4, .accel = accel};
            const Film one = take(d, shot, out);
            for (const int k : {-20, -7, 1, 20})
                differ += pixels_that_differ(one, take(scaled_by(d, std::ldexp(1.0, k)), shot, out));
        }
        for (const double away : {0.03, 0.1, 0.3, 1.0}) {
            // From outside and so low that the ball is not in the way.
            const Vec3d at{away, 0, 0}, towards{std::cos(away / 2), std::sin(away / 2), 0};
            d.camera = make_camera(at + towards, at, 1e-4);
            const Film film = take(d,
                                   {.width = 1,
                                    .height = 1,
                                    .spp = static_cast<uint32_t>(setup.scaled(20000, 500000, 2000000)),
                                    .integrator = plain_path(1),
                                    .sampler = SamplerKind::independent},
                                   out);
            const Pixel& p = film.pixels[0];
            stats::Tally t;
            t.n = p.n, t.mean = luminance_of(p), t.m2 = std::max(0.0, p.sum_sq - t.n * t.mean * t.mean);
            const double height = 1 + gap;
            const double hidden = height / std::pow(height * height + away * away, 1.5);
            least.add(stats::mean_p(t, static_cast<double>(0.8f) * (1 - hidden), 1e-5));
        }
    }
    out.measures = {at_most("pixels with other bits, times 2^-20 to 2^20", differ, 0),
                    least.measure("least p that the shade around the foot is what it should be")};
    return out;
}

}  // namespace

std::vector<Row> sphere_rows()
{
    return {
        {"P1", "walls of spheres of radius 1e5, 1e6", "policy, double", Tier::A, false, wall_spheres},
        {"P2", "small spheres far away", "closed form", Tier::A, false, far_spheres},
        {"P3", "radii of 0, negative, none and huge", "policy", Tier::A, false, odd_radii},
        {"P4", "shells of glass of thickness 1e-4 to 1e-6", "closed form", Tier::A, false, nested_shells},
        {"P5", "camera in, between and on spheres", "closed form", Tier::A, false, camera_in_spheres},
        {"P6", "rays that graze spheres", "long double", Tier::A, false, tangent_rays},
        {"P7", "a plane of squares out to 1e7", "long double", Tier::A, false, grazing_checker},
        {"P8", "slopes of 0, denormal and 1e-8 at the horizon", "policy", Tier::A, false, horizon},
        {"P9", "planes in one place, through a sphere, and of light", "other ways", Tier::A, false, planes_in_place},
        {"P10", "a sphere that rests on a plane", "itself times 2^k, closed form", Tier::A, false, resting_ball},
    };
}

}  // namespace lancer::stability
