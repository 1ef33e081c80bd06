// Rows D3 to D6: smooth boundaries between media, of indices near 1 and far from it.
#include "app/run_program.h"
#include "io/scene/scene_file.h"
#include "materials/glass.h"
#include "materials/interface.h"
#include "stability/groups.h"
#include "stability/shots.h"
#include "support/exact_fresnel.h"
#include "support/rasters.h"

namespace lancer::stability {
namespace {

std::vector<float> cosines()
{
    std::vector<float> all{1, 1 - 0x1p-24f, 1e-3f, 1e-5f, 1e-7f, 1e-20f};
    for (int i = 1; i < 2000; ++i) all.push_back(static_cast<float>(i) / 2000);
    return all;
}

MaterialDescription make_glass(float ior)
{
    MaterialDescription m = make_lambert("glass", {1, 1, 1});
    m.type = MaterialType::glass;
    m.ior = ior;
    return m;
}

// Light that changes slowly and is different everywhere.
RasterSource slow_sky()
{
    return picture_source(make_raster(64, 32, [](uint32_t x, uint32_t y) {
        const double lon = 2 * pi_d * (x + 0.5) / 64, lat = pi_d * (y + 0.5) / 32;
        const auto c = static_cast<float>(1 + 0.2 * std::cos(lon) * std::sin(lat));
        return Color{c, 2 - c, 1};
    }));
}

enum class Shape { none, pane, ball };

SceneDescription before_sky(Shape shape, float ior)
{
    SceneDescription d;
    d.materials = {make_glass(ior)};
    d.lights = {sky_map_of({1, 1, 1})};
    if (shape == Shape::ball) {
        d.spheres.push_back(sphere_of({0, 0, 0}, 1, "glass"));
    } else {  // without an object a far speck keeps the frame
        d.meshes.push_back(make_mesh(make_cube(), {{0, shape == Shape::none ? 1e3 : 0., 0}, {0, 0, 0}, {1, 1, 0.2}}));
        d.meshes[0].material = "glass";
    }
    d.camera = make_camera({0.1, 0.2, 3}, {0, 0, 0}, 20);
    return d;
}

// The largest difference of a pixel, the random numbers of both being the same.
double worst_difference(const Film& a, const Film& b)
{
    double worst = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i)
        for (size_t c = 0; c < 3; ++c)
            worst = std::max(worst, std::abs(a.pixels[i].sum[c] / a.pixels[i].n - b.pixels[i].sum[c] / b.pixels[i].n));
    return worst;
}

Outcome hardly_there(const Setup& setup)
{
    Outcome out;
    double most = 0;
    for (const float c : cosines()) {
        const Fresnel f = fresnel_dielectric(c, 1.0f);
        most = std::max(most, double{f.reflectance});
    }
    out.measures.push_back(at_most("index 1, part reflected", most, 1e-6));
    for (const float eta : {1.000001f, 1.0001f, 0.999999f, 0.9999f}) {
        double error = 0;
        for (const float c : cosines())
            error = std::max(error, static_cast<double>(std::abs(fresnel_dielectric(c, eta).reflectance -
                                                                 exact_fresnel(c, eta).reflectance)));
        out.measures.push_back(
            at_most("index 1 + " + significant(double{eta} - 1, 2) + ", error of the part reflected", error, 1e-6));
    }
    const auto side = static_cast<uint32_t>(setup.scaled(16, 32, 64));
    Shot shot{.integrator = without_roulette({}),
              .width = side,
              .height = side,
              .spp = static_cast<uint32_t>(setup.scaled(32, 1024, 4096)),
              .sampler = SamplerKind::independent};
    shot.images = slow_sky();
    const Film nothing = shoot(before_sky(Shape::none, 1), shot, setup, out);
    Claim same;
    for (const float ior : {1.0f, 1.000001f, 1.0001f}) {
        const std::string name = ior == 1 ? "index 1" : "index 1 + " + significant(double{ior} - 1, 2);
        shot.seed = 0;
        out.measures.push_back(at_most(name + ", pane against no object, per pixel",
                                       worst_difference(nothing, shoot(before_sky(Shape::pane, ior), shot, setup, out)),
                                       1e-6));
        shot.seed = 1;
        for (const Shape shape : {Shape::pane, Shape::ball})
            same.add_tiles(nothing, shoot(before_sky(shape, ior), shot, setup, out));
    }
    out.measures.push_back(same.measure("panes and balls against no object, by tile"));
    return out;
}

Outcome far_indices(const Setup&)
{
    Outcome out;
    for (const float eta : {1e3f, 1e6f, 1e-3f, 1e-6f}) {
        double error = 0;
        for (const float c : cosines()) {
            const ExactFresnel exact = exact_fresnel(c, eta);
            const float found = fresnel_dielectric(c, eta).reflectance;
            error = std::max(error, static_cast<double>(std::abs(found - exact.reflectance) / exact.reflectance));
        }
        out.measures.push_back(at_most("index " + significant(double{eta}, 1) + ", relative error of R", error, 1e-5));
    }
    // What a scene may say, alone and to the program.
    const TempFolder folder;
    double refused = 0, codes = 0, named = 0;
    const std::vector<std::string> wrong{"0", "-1", "nan", "inf", "-0.0", "1e39", "1e-60"};
    for (const std::string& ior : wrong) {
        const std::string text = "version = 1\n[material.a]\ntype = \"glass\"\nior = " + ior +
                                 "\n[[sphere]]\nradius = 1\nmaterial = \"a\"\n";
        Diagnostics problems;
        parse_scene(text, "a.toml", {}, problems);
        refused += problems.has_errors();
        if (ior != "0" && ior != "-1" && ior != "nan") continue;
        write_bytes(folder.file("a.toml"), text);
        const Said said = run_program(folder, {"render", "a.toml", "--size", "4x4", "-s", "1", "-o", "a.exr"});
        codes += said.code == 65;
        named += said.err.find("a.toml:4") != std::string::npos && !std::filesystem::exists(folder.file("a.exr"));
    }
    out.measures.push_back(exactly("indices refused", refused, static_cast<double>(wrong.size())));
    out.measures.push_back(exactly("of 0, -1 and NaN exit code 65", codes, 3));
    out.measures.push_back(exactly("and the line named, no picture written", named, 3));
    return out;
}

// R + T - 1 of a boundary at 8 floats on either side of the angle where total reflection begins.
Outcome critical_angle(const Setup&)
{
    Outcome out;
    double sum = 0, error = 0, not_numbers = 0, disagree = 0;
    const auto look = [&](const auto& bsdf, Vec3 wo) {
        const auto low = bsdf.sample(wo, 0, {}), high = bsdf.sample(wo, 1 - 0x1p-24f, {});
        if (!low || !high) return void(++not_numbers);
        for (const auto& s : {*low, *high})
            not_numbers += !is_finite(s.wi) || !is_finite(s.weight) || !std::isfinite(s.pdf) || !(s.pdf >= 0);
        const double r = low->wi.z > 0 ? double{low->pdf} : 0, t = high->wi.z < 0 ? double{high->pdf} : 0;
        sum = std::max(sum, std::abs(r + t - 1));
    };
    for (const float ior : {1.000001f, 1.0001f, 1.33f, 1.5f, 2.42f, 10.0f, 1000.0f}) {
        const float eta = 1 / ior;
        auto c = static_cast<float>(std::sqrt((1 - double{eta}) * (1 + double{eta})));
        for (int i = 0; i < 8; ++i) c = std::nextafter(c, 0.0f);
        for (int i = -8; i <= 8; ++i, c = std::min(1.0f, std::nextafter(c, 2.0f))) {
            const Fresnel f = fresnel_dielectric(c, eta);
            const ExactFresnel exact = exact_fresnel(c, eta);
            error = std::max(error, static_cast<double>(std::abs(f.reflectance - exact.reflectance)));
            disagree += (f.cos_t == 0) != (exact.cos_t == 0);
            for (const double turn : {0.0, 0.7, 2.0}) {
                const double s = std::sqrt((1 - double{c}) * (1 + double{c}));
                const Vec3 wo = to_float(Vec3d{s * std::cos(turn), s * std::sin(turn), double{c}});
                look(GlassBsdf{.tint = {1, 1, 1}, .eta = double{eta}}, wo);
                Phong glass{.diffuse = {1, 1, 1}, .specular = {1, 1, 1}, .diffusion = 0, .refraction = 1};
                glass.inside_ior = eta;
                look(InterfaceBsdf(glass, true), wo);
            }
        }
    }
    out.measures = {at_most("R + T - 1", sum, 1e-7), exactly("not a number", not_numbers, 0),
                    at_most("error of R", error, 1e-7), exactly("total reflection on the wrong side", disagree, 0)};
    return out;
}

SceneDescription glass_in_glass(const std::vector<std::pair<float, std::optional<int32_t>>>& balls, double smaller)
{
    SceneDescription d;
    d.lights = {sky_map_of({1, 1, 1})};
    double radius = 1;
    for (const auto& [ior, priority] : balls) {
        MaterialDescription m = make_glass(ior);
        m.name = "glass" + std::to_string(d.spheres.size());
        m.priority = priority;
        d.materials.push_back(m);
        d.spheres.push_back(sphere_of({0, 0, 0}, radius, m.name));
        radius -= smaller;
    }
    d.camera = make_camera({0.1, 0.2, 4}, {0, 0, 0}, 40);
    return d;
}

// By the program, of which each run has its own threads.
double pictures_that_differ_by_threads(const std::string& priority)
{
    const TempFolder folder;
    std::string text =
        "version = 1\n[camera]\nposition = [0.1, 0.2, 4]\n[[plane]]\npoint = [0, -1, 0]\n[[light]]\n"
        "type = \"sphere\"\ncenter = [1, 3, 1]\nradius = 0.5\nradiance = [9, 8, 7]\n";
    for (const std::string name : {"a", "b"})
        text += "[material." + name + "]\ntype = \"glass\"\nior = 1." + (name == "a" ? "5" : "2") + "\n" + priority +
                "[[sphere]]\nradius = 1\nmaterial = \"" + name + "\"\n";
    write_bytes(folder.file("a.toml"), text);
    std::vector<Image> pictures;
    for (const std::string threads : {"1", "2", "7"}) {
        const Said said = run_program(folder, {"render", "a.toml", "--size", "32x32", "-s", "16", "--tile", "8",
                                               "--threads", threads, "-o", threads + ".exr"});
        if (said.code != 0) throw Error(ErrorKind::failed, said.err);
        pictures.push_back(read_exr(folder.file(threads + ".exr")));
    }
    return !same_pixels(pictures[0], pictures[1]) + !same_pixels(pictures[0], pictures[2]);
}

Outcome coincident_glass(const Setup& setup)
{
    Outcome out;
    const auto side = static_cast<uint32_t>(setup.scaled(24, 64, 128));
    Shot shot{.integrator = without_roulette({.max_depth = 50}), .width = side, .height = side, .spp = 16};
    shot.images = slow_sky();
    const auto picture = [&](const SceneDescription& d, AccelKind accel) {
        shot.accel = accel;
        return shoot(d, shot, setup, out);
    };
    double threads = 0, accelerators = 0, winner = 0;
    for (const bool listed : {false, true}) {  // in the list of media, or without
        const auto priority = [&](int32_t p) { return listed ? std::optional(p) : std::nullopt; };
        const SceneDescription both = glass_in_glass({{1.5f, priority(1)}, {1.2f, priority(1)}}, 0);
        const Film one = picture(both, AccelKind::embree);
        threads += pictures_that_differ_by_threads(listed ? "priority = 1\n" : "");
        for (const AccelKind accel : {AccelKind::bvh2, AccelKind::bvh8, AccelKind::list})
            accelerators += pixels_that_differ(one, picture(both, accel));
        winner += pixels_that_differ(one, picture(glass_in_glass({{1.5f, priority(1)}}, 0), AccelKind::embree));
        const SceneDescription swapped = glass_in_glass({{1.2f, priority(1)}, {1.5f, priority(1)}}, 0);
        winner += pixels_that_differ(picture(swapped, AccelKind::embree),
                                     picture(glass_in_glass({{1.2f, priority(1)}}, 0), AccelKind::embree));
    }
    out.measures = {exactly("pictures that differ from that of 1 thread with 2 and 7", threads, 0),
                    exactly("pixels that differ between accelerators", accelerators, 0),
                    exactly("from the first of two alone, as documented", winner, 0)};
    // That the second is there at all, were it a hair smaller.
    const Film nested = picture(glass_in_glass({{1.5f, {}}, {1.2f, {}}}, 1e-3), AccelKind::embree),
               alone = picture(glass_in_glass({{1.5f, {}}}, 0), AccelKind::embree);
    out.measures.push_back(at_least("from a ball that is a thousandth smaller", pixels_that_differ(nested, alone), 10));
    return out;
}

}  // namespace

std::vector<Row> dielectric_rows()
{
    return {
        {"D3", "index 1, 1 + 1e-6, 1 + 1e-4: glass that is hardly there", "closed form", Tier::A, false, hardly_there},
        {"D4", "index 1e3, 1e6, 1e-3; 0, -1, NaN", "closed form, policy", Tier::A, false, far_indices},
        {"D5", "within 8 ulp of the critical angle", "long double", Tier::A, false, critical_angle},
        {"D6", "ball of glass in one of the same size", "itself, policy", Tier::A, false, coincident_glass}};
}

}  // namespace lancer::stability
