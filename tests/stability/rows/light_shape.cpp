// Rows L1 to L5 and L12: single lights where they are far, close, hidden, nothing or cut to pieces.
#include "app/run_program.h"
#include "integrators/path/transport.h"
#include "io/scene/scene_file.h"
#include "stability/groups.h"
#include "stability/shots.h"
#include "support/scenes/lit_places.h"

namespace lancer::stability {
namespace {

Outcome sphere_lights(const Setup& setup)
{
    Outcome out;
    double not_finite = 0;
    for (const double ratio : {1.0001, 2.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6}) {
        const Scene scene = sphere_at(ratio, 1);
        const Surface from = receiver(to_float(scene.normalisation.to_scene({0, 0, 0})), {0, 1, 0});
        Random random(1);
        const stats::Tally e = irradiance(scene, from, static_cast<int>(setup.scaled(128, 1024, 2048)), random);
        const double expected = pi_d * 2 / (ratio * ratio), sigma = e.error() / expected;
        out.measures.push_back(at_most("distance " + significant(ratio, 5) + " radii, irradiance",
                                       std::abs(e.mean / expected - 1), std::max(1e-5, 4 * sigma)));
        for (int i = 0; i < 1000; ++i) {
            const float u = i % 10 ? random.unit() : 1 - 0x1p-24f;
            const auto s = sample_light(scene, from, 0, {u, random.unit()});
            not_finite += !s || !std::isfinite(s->pdf) || !(s->pdf > 0) || !is_finite(s->wi);
        }
    }
    out.measures.push_back(exactly("samples without a finite density", not_finite, 0));
    return out;
}

// A lamp of intensity 3 at that height over a plane; below it a ball for the frame.
SceneDescription lamp_over_plane(double height)
{
    SceneDescription d;
    d.materials = {make_lambert("floor", {0.5f, 0.5f, 0.5f})};
    d.planes.push_back(plane_of({0, 0, 0}, {0, 1, 0}, "floor"));
    d.spheres.push_back(sphere_of({2, -1.5, 0}, 0.5));
    d.lights.push_back(light_of(LightType::point, {3, 3, 3}, {0.1, height, 0.2}));
    d.camera = make_camera({0.5, 1, 2}, {0.1, 0, 0.2}, 30);
    return d;
}

// The flux on a disc of radius 1 below the lamp, by places drawn as the lamp sees them, over 2 pi I (1 - cos of its
// rim).
struct Flux {
    stats::Tally part;
    double hidden = 0, not_finite = 0;
};
Flux flux_of(double height, size_t count)
{
    const Stage stage(lamp_over_plane(height));
    const auto& lamp = std::get<PointLight>(stage.scene.delta_lights[0]);
    const Plane& plane = stage.scene.geometry.planes[0];
    const Vec3d at = to_double(lamp.position);
    // As high as float leaves it.
    const double h = dot(plane.normal, at) - plane.offset, r = stage.scene.normalisation.scale,
                 rim = h / std::sqrt(r * r + h * h);
    Flux flux;
    Random random(7);
    for (size_t i = 0; i < count; ++i) {
        const double cos = rim + (1 - rim) * (1 - random.uniform()), phi = random.uniform(0, 2 * pi_d);
        const double t = h / cos, away = t * std::sqrt((1 - cos) * (1 + cos));
        const Vec3d place{at.x + away * std::cos(phi), at.y - h, at.z + away * std::sin(phi)};
        const auto surface = stage.look(to_float(place + Vec3d{0, 0.25, 0}), {0, -1, 0});
        if (!surface) {
            ++flux.not_finite;
            continue;
        }
        const auto s = sample_light(stage.scene, *surface, 0, {});
        const double e = s ? double{s->radiance.r} * double{dot(s->wi, surface->ns)} / double{s->pdf} : 0;
        flux.not_finite += !std::isfinite(e);
        flux.part.add(e * t * t / cos / double{lamp.intensity.r});
        if (s) flux.hidden += stage.embree->any(shadow_ray(*surface, *s)) + stage.list.any(shadow_ray(*surface, *s));
    }
    return flux;
}

Outcome low_lamps(const Setup& setup)
{
    Outcome out;
    const size_t count = setup.scaled(20000, 2000000, 10000000);
    for (const double height : {1.0, 1e-3, 1e-6}) {
        const Flux flux = flux_of(height, count);
        const std::string name = "height " + significant(height, 1);
        out.measures.push_back(
            at_most(name + ", flux on the disc", std::abs(flux.part.mean - 1), std::max(1e-5, 4 * flux.part.error())));
        out.measures.push_back(exactly(name + ", shadow rays that meet something", flux.hidden, 0));
        out.measures.push_back(exactly(name + ", not finite", flux.not_finite, 0));
        const Film film = shoot(lamp_over_plane(height), {.spp = 16}, setup, out);
        out.measures.push_back(exactly(name + ", picture not finite", !std::isfinite(all_light(film)), 0));
    }
    for (const double height : {0.0, -1e-6})
        out.measures.push_back(exactly("height " + significant(height, 1) + ", all light",
                                       all_light(shoot(lamp_over_plane(height), {.spp = 16}, setup, out)), 0));
    return out;
}

Outcome hidden(const Setup& setup)
{
    Outcome out;
    for (const char* name : {"embree", "bvh2", "bvh8", "list"}) {
        double light = 0;
        for (const SceneDescription& d : hidden_lights())
            light += all_light(shoot(d,
                                     {.spp = static_cast<uint32_t>(setup.scaled(32, 1024, 8192)),
                                      .accel = value_of<AccelKind>(name).value()},
                                     setup, out));
        out.measures.push_back(exactly(std::string("light that gets through, ") + name, light, 0));
    }
    return out;
}

// A floor in y = 0 and a square of light over its half x > 0, facing down at a height of `gap`, or in the same plane. A
// ball keeps x = 0 and y = 0 where float has its smallest steps.
SceneDescription close_panel(double gap)
{
    SceneDescription d;
    d.materials = {make_lambert("floor", {0.5f, 0.5f, 0.5f})};
    if (gap > 0) {
        d.planes.push_back(plane_of({0, 0, 0}, {0, 1, 0}, "floor"));
        d.spheres.push_back(sphere_of({-0.9, 0, 0}, 0.1));
    } else {
        d.meshes.push_back(make_mesh(make_quad({-1, 0, 1}, {0, 0, 1}, {0, 0, -1}, {-1, 0, -1})));
        d.meshes[0].material = "floor";
    }
    MaterialDescription lamp = make_emitter("lamp", {4, 4, 4});
    lamp.emission_both_sides = gap == 0;
    d.meshes.push_back(make_mesh(make_quad({0, gap, -0.5}, {1, gap, -0.5}, {1, gap, 0.5}, {0, gap, 0.5}, lamp)));
    return d;
}

// What a place at x of the floor below the panel shows by two ways, against Lambert's formula, in sigma.
struct BesidePanel {
    Claim claim;
    double farthest = 0, noise = 0;  // both relative to sigma, to the mean
};
BesidePanel beside_panel(std::initializer_list<double> places, AccelKind accel, uint32_t spp, const Setup& setup,
                         Outcome& out)
{
    constexpr double gap = 1e-6;
    const std::array<Vec3d, 4> corners{Vec3d{0, gap, -0.5}, {1, gap, -0.5}, {1, gap, 0.5}, {0, gap, 0.5}};
    BesidePanel all;
    for (const double x : places) {
        SceneDescription d = close_panel(gap);
        // From above, or from within the gap.
        const double eye = x > 0 ? 0.5 * gap : 0.5;
        d.camera = make_camera({x, eye, 0}, {x, eye - 1, 0}, 1e-6);
        d.camera->up = {0, 0, 1};
        const double expected = 0.5 / pi_d * 4 * lambert({x, 0, 0}, {0, 1, 0}, corners);
        for (const DirectLight how : {DirectLight{true, true}, DirectLight{false, false}}) {
            const Shot shot{.integrator = Path{.max_depth = 1, .direct = how},
                            .width = 4,
                            .height = 4,
                            .spp = spp,
                            .sampler = SamplerKind::independent,
                            .accel = accel};
            const stats::Tally t = tally(shoot(d, shot, setup, out));
            all.claim.add(stats::mean_p(t, expected, 1e-4));
            if (t.error() > 0) all.farthest = std::max(all.farthest, std::abs(t.mean - expected) / t.error());
            all.noise = std::max(all.noise, t.error() / expected);
        }
    }
    return all;
}

Outcome panels_close_by(const Setup& setup)
{
    Outcome out;
    const auto spp = static_cast<uint32_t>(setup.scaled(2048, 16384, 1 << 20));
    // Under the panel and beside it, as far from its edge as a few gaps.
    for (const AccelKind accel : {AccelKind::bvh2, AccelKind::bvh8}) {
        const BesidePanel found = beside_panel({0.3, 2e-6, -3e-6, -1e-5}, accel, spp, setup, out);
        out.measures.push_back(found.claim.measure("1e-6 above, " + std::string(name_of(accel))));
        out.measures.push_back(at_most("the largest sigma, relative", found.noise, 0.2));
    }
    // Embree lets a ray that misses an edge by a ten millionth of the triangle's size hit it.
    out.measures.push_back(beside_panel({0.3, 2e-5, -2e-5}, AccelKind::embree, spp, setup, out)
                               .claim.measure("1e-6 above, embree, 2e-5 from the edge"));
    out.measures.push_back(told("embree, 3e-6 from the edge, in sigma",
                                beside_panel({2e-6, -3e-6}, AccelKind::embree, spp, setup, out).farthest));
    SceneDescription flat = close_panel(0);
    flat.camera = make_camera({-0.5, 1, 0.3}, {-0.5, 0, 0}, 40);
    for (const DirectLight how : {DirectLight{true, true}, DirectLight{true, false}, DirectLight{false, false}}) {
        const Film film = shoot(flat, {.integrator = Path{.direct = how}, .spp = 64}, setup, out);
        out.measures.push_back(exactly(std::string("in one plane, all light, ") + (how.mis   ? "both ways"
                                                                                   : how.nee ? "by light sampling"
                                                                                             : "by the BSDF"),
                                       all_light(film), 0));
    }
    return out;
}

Outcome lights_of_nothing(const Setup& setup)
{
    Outcome out;
    const std::vector<std::string> wrong{"type = \"point\"\nposition = [0, 1, 0]\nintensity = [-1, 1, 1]",
                                         "type = \"point\"\nposition = [0, 1, 0]\nintensity = [1, nan, 1]",
                                         "type = \"point\"\nposition = [0, 1, 0]\nintensity = [1, 1, inf]",
                                         "type = \"point\"\nposition = [0, nan, 0]\nintensity = [1, 1, 1]",
                                         "type = \"sphere\"\ncenter = [0, 1, 0]\nradius = 0\nradiance = [1, 1, 1]",
                                         "type = \"sphere\"\ncenter = [0, 1, 0]\nradius = -1\nradiance = [1, 1, 1]",
                                         "type = \"sphere\"\ncenter = [0, 1, 0]\nradius = nan\nradiance = [1, 1, 1]",
                                         "type = \"sphere\"\ncenter = [0, 1, 0]\nradius = 1\nradiance = [1, -1, 1]",
                                         "type = \"directional\"\ndirection = [0, 0, 0]\nirradiance = [1, 1, 1]",
                                         "type = \"environment\"\nradiance = [nan, 1, 1]"};
    double refused = 0;
    for (const std::string& light : wrong) {
        Diagnostics problems;
        parse_scene("version = 1\n[[sphere]]\nradius = 1\n[[light]]\n" + light + "\n", "a.toml", {}, problems);
        refused += problems.has_errors();
    }
    out.measures.push_back(exactly("lights that cannot be, refused", refused, static_cast<double>(wrong.size())));
    // Lights of no power are as if they were not there.
    SceneDescription some = lamp_over_plane(1), more = some;
    some.lights.push_back(light_of(LightType::sphere, {3, 3, 3}, {-0.5, 1, 0}, 0.2));
    more.lights = {light_of(LightType::point, {}, {0.2, 1, 0.2}),         some.lights[0],
                   light_of(LightType::point, {}, {0.3, 1, 0.2}),         some.lights[1],
                   light_of(LightType::sphere, {}, {0.3, 0.5, 0.2}, 0.1), sky_of({})};
    const Shot shot{.spp = 16};
    out.measures.push_back(exactly("pixels that lights without power change",
                                   pixels_that_differ(shoot(some, shot, setup, out), shoot(more, shot, setup, out)),
                                   0));
    const Scene scene = build_scene(more);
    double chosen = 0;
    for (const Light& light : scene.lights.lights)
        if (const auto* point = std::get_if<PointLight>(&light))
            chosen += is_black(point->intensity) &&
                      scene.lights.pick.probability(static_cast<uint32_t>(&light - scene.lights.lights.data())) > 0;
    out.measures.push_back(exactly("lights without power that are chosen", chosen, 0));
    // Emitting triangles without area are told and left out.
    const TempFolder folder;
    const std::string lit = "mtllib a.mtl\nusemtl lamp\nv 0 2 0\nv 1 2 0\nv 0 2 1\nv 2 2 0\nf 1 2 3\n";
    write_bytes(folder.file("a.mtl"), "newmtl lamp\nKe 3 3 3\nKd 0 0 0\n");
    write_bytes(folder.file("a.obj"), lit);
    write_bytes(folder.file("b.obj"), lit + "f 1 2 4\nf 1 1 2\nf 3 3 3\n");
    for (const std::string name : {"a", "b"})
        write_bytes(folder.file(name + ".toml"),
                    "version = 1\n[camera]\nposition = [0, 1, 5]\n[[plane]]\nnormal = [0, 1, 0]\n[[mesh]]\nfile = \"" +
                        name + ".obj\"\n");
    std::vector<Image> pictures;
    for (const std::string name : {"a", "b"}) {
        const Said said =
            run_program(folder, {"render", name + ".toml", "--size", "16x16", "-s", "16", "-o", name + ".exr"});
        out.measures.push_back(
            exactly("exit code, " + std::string(name == "a" ? "without" : "with") + " empty triangles", said.code, 0));
        if (said.code == 0) pictures.push_back(read_exr(folder.file(name + ".exr")));
        if (name == "b") {
            out.measures.push_back(
                exactly("warned of, with their number", said.err.find("(3 times)") != std::string::npos, 1));
        }
    }
    out.measures.push_back(exactly("pictures alike", pictures.size() == 2 && same_pixels(pictures[0], pictures[1]), 1));
    return out;
}

// A square of 2 x 2 over a floor in strips so thin that a million of them fit.
Outcome slivers(const Setup& setup)
{
    Outcome out;
    const size_t strips = setup.scaled(2000, 500000, 500000);
    std::vector<Vec3d> p;
    std::vector<std::array<uint32_t, 3>> t;
    for (size_t i = 0; i <= strips; ++i) {
        const double x = -1 + 2.0 * static_cast<double>(i) / static_cast<double>(strips);
        p.push_back({x, 1, -1}), p.push_back({x, 1, 1});
        if (i == strips) break;
        const auto at = static_cast<uint32_t>(2 * i);
        t.push_back({at, at + 2, at + 3}), t.push_back({at, at + 3, at + 1});
    }
    SceneDescription d;
    d.meshes.push_back(make_mesh(make_mesh_data(std::move(p), std::move(t), make_emitter("lamp", {4, 4, 4}))));
    d.meshes.push_back(make_mesh(
        make_quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, make_lambert("floor", {0.5f, 0.5f, 0.5f}))));
    const std::array<Vec3d, 4> corners{Vec3d{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}};
    for (const bool tree : {true, false}) {
        d.render.light_tree = tree;
        RendererConfig settings;
        settings.integrator = Path{.max_depth = 1, .direct = {true, false}};
        settings.kernel.sampler = SamplerKind::independent;
        with_threads(setup.tier == Tier::A ? 1 : available_threads(), [&] {
            const Renderer renderer(build_scene(d), settings);
            double worst = 0, noise = 0;
            for (const Vec3d& at : {Vec3d{0, 0, 0}, Vec3d{0.9, 0, 0.3}, Vec3d{-1.8, 0, 1.5}}) {
                CameraDescription camera = make_camera(at + Vec3d{0.1, 0.5, 0.1}, at, 1e-4);
                Film film(4, 4, {0, 0, 4, 4});
                const auto spp = static_cast<uint32_t>(setup.scaled(1024, 65536, 1 << 20));
                const auto tiles = make_tiles(film.crop, 16);
                const PassResult result =
                    renderer.pass(Camera(camera, renderer.scene().normalisation, 4, 4), film, tiles, {0, spp});
                out.samples += 16 * spp, out.dropped += result.counters.dropped;
                const stats::Tally found = tally(film);
                const double expected = 0.5 / pi_d * 4 * lambert(at, {0, 1, 0}, corners);
                worst = std::max(worst, std::abs(found.mean / expected - 1) / std::max(1e-5, found.error() / expected));
                noise = std::max(noise, found.error() / expected);
            }
            const std::string name = tree ? "by the tree" : "by power";
            out.measures.push_back(at_most(name + ", distance from Lambert's formula in sigma", worst, 4));
            out.measures.push_back(at_most(name + ", the largest sigma", noise, 0.01));
        });
    }
    return out;
}

}  // namespace

std::vector<Row> light_shape_rows()
{
    return {
        {"L1", "ball of light at 1.0001 to 1e6 radii", "closed form", Tier::A, false, sphere_lights},
        {"L2", "point of light 1, 1e-3, 1e-6 and 0 over a plane", "closed form", Tier::A, false, low_lamps},
        {"L3", "light in an opaque body, 1e-4 behind a wall", "closed form", Tier::A, false, hidden},
        {"L4", "panel of light in the plane of a floor and 1e-6 above", "closed form", Tier::A, false, panels_close_by},
        {"L5", "light of no area, no power, less than none, NaN", "policy", Tier::A, false, lights_of_nothing},
        {"L12", "mesh of light of slivers", "closed form", Tier::A, false, slivers}};
}

}  // namespace lancer::stability
