// Rows L8 to L10: pictures of the sky with a sun of one texel, with nothing, with what is no number, and of odd shapes.
#include "scene/environment/environment.h"
#include "stability/groups.h"
#include "stability/shots.h"
#include "support/random.h"
#include "support/rasters.h"

namespace lancer::stability {
namespace {

// A floor of albedo 1/2 that faces up, looked at in one point.
SceneDescription floor_under_sky()
{
    SceneDescription d;
    d.meshes.push_back(make_mesh(
        make_quad({-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}, make_lambert("floor", {0.5f, 0.5f, 0.5f}))));
    d.lights = {sky_map_of({1, 1, 1})};
    d.camera = make_camera({-3, 0.4, 2}, {0, 0, 0}, 1e-4);
    return d;
}

// The largest distance of a pixel, relative, with points that are spread evenly; and of the mean, in sigma, with
// independent ones.
void add_errors(Outcome& out, const Setup& setup, const std::string& name, const SceneDescription& d,
                const RasterSource& images, double expected, uint32_t spp)
{
    Shot shot{.integrator = Path{.max_depth = 1}, .width = 4, .height = 4, .spp = spp};
    shot.images = images;
    const auto e = static_cast<float>(expected);
    out.measures.push_back(
        at_most(name + ", error of a pixel", worst_pixel(shoot(d, shot, setup, out), {e, e, e}), 0.005));
    shot.sampler = SamplerKind::independent;
    const stats::Tally t = tally(shoot(d, shot, setup, out));
    out.measures.push_back(at_most(name + ", distance of the mean in sigma",
                                   std::abs(t.mean - expected) / std::max(t.error(), 1e-6 * expected), 4));
}

Outcome one_texel_sun(const Setup& setup)
{
    Outcome out;
    const auto width = static_cast<uint32_t>(setup.scaled(1024, 8192, 8192)), height = width / 2;
    const uint32_t column = width * 3 / 10, row = height * 27 / 100;
    // One channel of bytes: the factor makes the sun of it, and the rest is a constant.
    Raster r{.width = width, .height = height, .channels = 1, .bytes = {}, .floats = {}};
    r.bytes.resize(size_t{width} * height);
    r.bytes[size_t{row} * width + column] = 255;
    const RasterSource picture = picture_source(std::move(r));
    SceneDescription d = floor_under_sky();
    d.lights = {sky_map_of({1e6f, 1e6f, 1e6f}), sky_of({0.1f, 0.1f, 0.1f})};
    // The ramps on all sides of the texel hold as much as all of it would.
    const double polar = pi_d * (row + 0.5) / height, angle = 2 * pi_d / width * pi_d / height * std::sin(polar);
    add_errors(out, setup, "a sun of one texel of " + std::to_string(width) + " x " + std::to_string(height), d,
               picture, 0.5 / pi_d * (1e6 * angle * std::cos(polar) + pi_d * 0.1), 1024);
    return out;
}

Outcome odd_texels(const Setup& setup)
{
    Outcome out;
    const SceneDescription d = floor_under_sky();
    const auto constant = [](uint32_t width, uint32_t height, Color c) {
        return picture_source(make_raster(width, height, [=](uint32_t, uint32_t) { return c; }));
    };
    Shot shot{.spp = 16};
    shot.images = constant(16, 8, {});
    out.measures.push_back(exactly("all black, all light", all_light(shoot(d, shot, setup, out)), 0));
    // One texel of the row at the pole: its ramps to both sides and down; above its middle it does not change.
    constexpr uint32_t width = 64, height = 32;
    const RasterSource at_pole = picture_source(make_raster(width, height, [](uint32_t x, uint32_t y) {
        return x == 7 && y == 0 ? Color{1e3f, 1e3f, 1e3f} : Color{};
    }));
    double sum = 0;
    constexpr int n = 200000;
    for (int i = 0; i < n; ++i) {
        const double texels = 1.5 * (i + 0.5) / n, polar = pi_d * texels / height;
        sum += std::min(1.0, 1.5 - texels) * std::cos(polar) * std::sin(polar) * pi_d * 1.5 / (n * height);
    }
    add_errors(out, setup, "one texel at the pole", d, at_pole, 0.5 / pi_d * 1e3 * 2 * pi_d / width * sum, 1024);
    // What cannot shine is black, and counted.
    const float nan = std::nanf(""), inf = std::numeric_limits<float>::infinity();
    const auto sky_with = [&](bool bad) {
        return picture_source(make_raster(16, 8, [=](uint32_t x, uint32_t y) {
            const Color odd = x == 3 ? Color{nan, 1, 1} : x == 6 ? Color{1, inf, 1} : Color{-inf, nan, -2};
            if (y == 2 && (x == 3 || x == 6 || x == 12)) return bad ? odd : Color{};
            if (y == 2 && x == 9) return Color{1, 1, bad ? -1.0f : 0.0f};  // as a colour, not as a texel
            return Color{0.5f + static_cast<float>(x), 1, 2};
        }));
    };
    shot.images = sky_with(true);
    const Film bad = shoot(d, shot, setup, out);
    shot.images = sky_with(false);
    out.measures.push_back(exactly("NaN, infinite and negative texels, pixels not as of black ones",
                                   pixels_that_differ(bad, shoot(d, shot, setup, out)), 0));
    Diagnostics diagnostics;
    Scene::build(d, d.render, diagnostics, sky_with(true));
    const auto count = diagnostics.warnings().size() == 1 ? diagnostics.warnings()[0].count : 0;
    out.measures.push_back(exactly("warned of, with their number", static_cast<double>(count), 4));
    return out;
}

Outcome odd_shapes(const Setup& setup)
{
    Outcome out;
    struct Odd {
        uint32_t width, height;
    };
    for (const auto& [width, height] : {Odd{1, 1}, Odd{1, 65535}, Odd{65535, 1}}) {
        const std::string name = std::to_string(width) + " x " + std::to_string(height);
        const auto flat = make_raster(width, height, [](uint32_t, uint32_t) { return Color{2, 3, 5}; });
        const EnvironmentMap map(std::make_shared<const Raster>(flat), {1, 1, 1}, {}, {20, 30, 40});
        out.measures.push_back(at_most(name + ", power of one colour",
                                       std::abs(map.power() / (4 * pi_d * luminance(2.0, 3.0, 5.0)) - 1), 1e-5));
        // Drawn as it is looked up: each sample brings the whole sky.
        Random random(90);
        double worst = 0;
        for (size_t i = 0; i < setup.scaled(20000, 1000000, 1000000); ++i) {
            const EnvironmentSample s = map.sample(random.unit2());
            worst = std::max({worst, std::abs(double{s.radiance.r} / 2 - 1), std::abs(double{s.pdf} * 4 * pi_d - 1)});
        }
        out.measures.push_back(at_most(name + ", a sample's radiance and density", worst, 1e-5));
        // 1 + cos along the long side has the mean 1.
        const auto wave = make_raster(width, height, [w = width, h = height](uint32_t x, uint32_t y) {
            const double phase = w > 1 ? 2 * pi_d * (x + 0.5) / w : h > 1 ? pi_d * (y + 0.5) / h : pi_d / 2;
            const auto c = static_cast<float>(1 + std::cos(phase));
            return Color{c, c, c};
        });
        const EnvironmentMap waving(std::make_shared<const Raster>(wave), {1, 1, 1}, {}, {});
        out.measures.push_back(at_most(name + ", mean of 1 + cos", std::abs(waving.power() / (4 * pi_d) - 1), 1e-5));
        SceneDescription d = floor_under_sky();
        Shot shot{.width = 4, .height = 4, .spp = 64};
        shot.images = picture_source(flat);
        d.camera = make_camera({0, 1, 0}, {0.3, 2, 0.1}, 60);
        out.measures.push_back(at_most(name + ", seen", worst_pixel(shoot(d, shot, setup, out), {2, 3, 5}), 1e-5));
        d = floor_under_sky();
        shot.sampler = SamplerKind::independent;
        const stats::Tally t = tally(shoot(d, shot, setup, out));
        const double expected = 0.5 * luminance(2.0, 3.0, 5.0);
        out.measures.push_back(
            at_most(name + ", on a floor, distance in sigma", std::abs(t.mean - expected) / t.error(), 4));
    }
    return out;
}

}  // namespace

std::vector<Row> sky_rows()
{
    return {
        {"L8", "sun of one texel, a million times brighter than the sky", "closed form", Tier::A, false, one_texel_sun},
        {"L9", "sky of black, of one texel at the pole, of NaN", "closed form, policy", Tier::A, false, odd_texels},
        {"L10", "sky of 1 x 1, 1 x 65535, 65535 x 1", "closed form", Tier::A, false, odd_shapes}};
}

}  // namespace lancer::stability
