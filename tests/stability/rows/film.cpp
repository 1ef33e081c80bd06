// Rows A of the stability matrix: film and sampling.
#include <algorithm>
#include <cmath>
#include <set>

#include "materials/material.h"
#include "stability/counted_render.h"
#include "support/random.h"
#include "support/scenes/scenes.h"

namespace lancer::stability {
namespace {

double relative_error(double value, double expected) { return std::abs(value / expected - 1); }

// A sky of a tenth and nothing else: every sample is the same number.
SceneDescription constant_scene()
{
    SceneDescription d;
    d.lights.push_back(sky_of({0.1f, 0.1f, 0.1f}));
    d.camera = make_camera({0, 0, 5}, {0, 0, 0}, 40);
    return d;
}

Outcome constant_samples(const Setup& setup)
{
    Outcome out;
    const auto size = static_cast<uint32_t>(setup.scaled(1, 4, 4));
    for (const size_t spp : {size_t{1000000}, setup.scaled(2000000, 20000000, 20000000)}) {
        const RenderRequest r = square(size, static_cast<uint32_t>(spp));
        double worst = 0;
        for (const Pixel& p : counted_render(constant_scene(), r, out).pixels)
            worst = std::max(worst, relative_error(p.sum[0] / p.n, double{0.1f}));
        out.measures.push_back(at_most("relative error at " + std::to_string(spp) + " spp", worst, 1e-7));
    }
    // The film alone, where a render would take too long for this tier.
    Pixel whole, block;
    float naive = 0;
    constexpr uint32_t many = 20000000;
    for (uint32_t i = 1; i <= many; ++i) {
        block += Pixel{{double{0.1f}, double{0.1f}, double{0.1f}}, 0, 1};
        naive += 0.1f;
        if (i % samples_per_block == 0) whole += block, block = {};
    }
    out.measures.push_back(
        at_most("relative error of 2e7 sums", relative_error(whole.sum[0] / many, double{0.1f}), 1e-7));
    out.measures.push_back(told("the same in float", relative_error(double{naive} / many, double{0.1f})));
    return out;
}

// One pixel that sees a lamp of 1e6 in one half and one of 1e-6 in the other.
Outcome bright_and_faint(const Setup& setup)
{
    SceneDescription d;
    for (const int side : {0, 1})
        d.meshes.push_back(
            make_mesh(make_quad({side - 1.0, -1, 0}, {side + 0.0, -1, 0}, {side + 0.0, 1, 0}, {side - 1.0, 1, 0},
                                make_emitter("lamp", side ? Color{1e6f, 1e6f, 1e6f} : Color{1e-6f, 1e-6f, 1e-6f}))));
    d.camera = make_camera({0, 0, 1}, {0, 0, 0}, 60);
    const auto spp = static_cast<uint32_t>(setup.scaled(50000, 1000000, 10000000));
    Outcome out;
    RenderRequest r = square(1, spp);
    r.settings.kernel.filter = Filter(FilterKind::box);
    const Pixel pixel = counted_render(d, r, out).pixels[0];
    long double sum = 0, sum_sq = 0;
    uint32_t faint = 0, other = 0;
    with_threads(1, [&] {
        const Renderer renderer(build_scene(d), r.settings);
        const Camera camera = camera_of(d, renderer.scene(), 1, 1);
        const PathListener deaf{[](auto&&...) {}, [](auto&&...) {}, [](auto&&...) {}, [](auto&&...) {}};
        for (uint32_t i = 0; i < spp; ++i) {
            const Color c = renderer.replay(camera, 1, 1, {0, 0, i}, deaf);
            faint += c.r == 1e-6f, other += c.r != 1e-6f && c.r != 1e6f;
            sum += static_cast<long double>(c.r);
            const auto y = static_cast<long double>(luminance(c));
            sum_sq += y * y;
        }
    });
    const auto error = [](double value, long double expected) {
        return static_cast<double>(std::abs(static_cast<long double>(value) / expected - 1));
    };
    out.measures = {at_most("relative error of the mean", error(pixel.sum[0], sum), 1e-6),
                    at_most("relative error of the sum of squares", error(pixel.sum_sq, sum_sq), 1e-6),
                    exactly("samples of neither radiance", other, 0),
                    at_least("share of faint samples", double(faint) / spp, 0.1),
                    at_most("share of faint samples, at most", double(faint) / spp, 0.9)};
    return out;
}

// A picture of which every pixel is one known number, with the noise of a sphere light: a floor of albedo 1/2 seen so
// narrowly that the picture is one point of it.
struct KnownPoint {
    SceneDescription scene;
    double expected;
};
KnownPoint known_point()
{
    KnownPoint k;
    k.scene.materials = {make_lambert("floor", {0.5f, 0.5f, 0.5f})};
    k.scene.planes.push_back(plane_of({0, 0, 0}, {0, 1, 0}, "floor"));
    k.scene.camera = make_camera({-3, 0.4, 2}, {0, 0, 0}, 1e-4);
    const Vec3d to{0.4, 1, 0.2};
    constexpr double radius = 0.5;
    k.scene.lights.push_back(light_of(LightType::sphere, {3, 3, 3}, to, radius));
    // E = pi L (r / d)^2 cos as long as the whole sphere is above the horizon.
    k.expected = 0.5 * 3 * radius * radius * to.y / std::pow(dot(to, to), 1.5);
    return k;
}

// Of every pixel what its mean is off by.
std::vector<double> errors_of(const KnownPoint& k, uint32_t size, uint32_t spp, SamplerKind sampler, uint64_t seed,
                              Outcome& out)
{
    RenderRequest r = square(size, spp);
    r.settings.integrator = Path{.max_depth = 1, .direct = {true, false}};
    r.settings.kernel.sampler = sampler;
    r.settings.kernel.seed = seed;
    std::vector<double> errors;
    for (const Pixel& p : counted_render(k.scene, r, out).pixels) errors.push_back(p.sum[0] / p.n - k.expected);
    return errors;
}

// The slope of a straight line through the points, and the standard error that the scatter about it gives.
struct Fit {
    double slope, error;
};
Fit fit_line(const std::vector<double>& x, const std::vector<double>& y)
{
    const auto n = static_cast<double>(x.size());
    double mx = 0, my = 0, xx = 0, xy = 0, rest = 0;
    for (size_t i = 0; i < x.size(); ++i) mx += x[i] / n, my += y[i] / n;
    for (size_t i = 0; i < x.size(); ++i) xx += (x[i] - mx) * (x[i] - mx), xy += (x[i] - mx) * (y[i] - my);
    const double slope = xy / xx;
    for (size_t i = 0; i < x.size(); ++i) rest += std::pow(y[i] - my - slope * (x[i] - mx), 2);
    return {slope, std::sqrt(rest / (n - 2) / xx)};
}

Outcome convergence(const Setup& setup)
{
    const KnownPoint k = known_point();
    Outcome out;
    for (const SamplerKind sampler : {SamplerKind::independent, SamplerKind::sobol}) {
        std::vector<double> x, y;
        const auto last = static_cast<uint32_t>(setup.scaled(8, 14, 16));
        for (uint32_t i = 2; i <= last; ++i) {
            double sum = 0;
            const std::vector<double> errors = errors_of(k, 32, 1u << i, sampler, 100 + i, out);
            for (const double e : errors) sum += e * e;
            x.push_back(i);
            y.push_back(0.5 * std::log2(sum / static_cast<double>(errors.size())));
        }
        const Fit fit = fit_line(x, y);
        if (sampler == SamplerKind::independent)
            out.measures.push_back(at_most("independent: slope off -0.5", std::abs(fit.slope + 0.5), 0.03));
        else
            out.measures.push_back(at_most("Sobol': slope", fit.slope, -0.5));
        out.measures.push_back(told("its 95 % interval, to either side", 1.96 * fit.error));
    }
    return out;
}

std::vector<SceneDescription> varied_scenes(const Setup& setup)
{
    std::vector<SceneDescription> all;
    if (setup.tier == Tier::A) return {cornell_scene(), spheres_scene(), glossy_scene()};
    for (NamedScene& s : all_test_scenes()) all.push_back(std::move(s.description));
    return all;
}

Outcome threads_and_tiles(const Setup& setup)
{
    Outcome out;
    const std::vector<unsigned> threads =
        setup.tier == Tier::A ? std::vector<unsigned>{1, 2, 4} : std::vector<unsigned>{1, 2, 3, 4, 7, 8, 16, 64};
    double differ = 0, pictures = 0;
    for (const SceneDescription& scene : varied_scenes(setup))
        for (const AnyIntegrator& integrator : all_integrators()) {
            RenderRequest r = square(44, static_cast<uint32_t>(setup.scaled(1, 16, 128)));
            r.height = 33, r.threads = 1;
            r.settings.integrator = integrator;
            const Film one = counted_render(scene, r, out);
            for (const unsigned n : threads)
                for (const uint32_t tile : {8u, 16u, 32u}) {
                    r.threads = n, r.tile = tile;
                    differ += pixels_that_differ(one, counted_render(scene, r, out)), ++pictures;
                }
        }
    out.measures = {exactly("pixels that differ", differ, 0), told("pictures compared", pictures)};
    return out;
}

Outcome split_samples(const Setup& setup)
{
    Outcome out;
    double differ = 0;
    const auto n = static_cast<uint32_t>(setup.scaled(4, 24, 96));
    for (const SceneDescription& scene : varied_scenes(setup))
        for (const std::vector<uint32_t>& passes :
             {std::vector<uint32_t>(16, 64), std::vector<uint32_t>(64, 16), {16, 496, 512}}) {
            RenderRequest r = square(n, 1024);
            const Film once = counted_render(scene, r, out);
            r.spp = passes;
            differ += pixels_that_differ(once, counted_render(scene, r, out));
        }
    // Where passes end within a block of 16, too, if the film keeps it open.
    const SceneDescription scene = spheres_scene();
    const RenderRequest r = square(n, 1024);
    const Film once = counted_render(scene, r, out);
    Film often(n, n, {0, 0, n, n});
    often.keep_blocks_open();
    with_threads(2, [&] {
        const Renderer renderer(build_scene(scene), r.settings);
        const Camera camera = camera_of(scene, renderer.scene(), n, n);
        Random random(11);
        for (uint32_t begin = 0; begin < 1024;) {
            const uint32_t end = std::min(1024u, begin + 1 + random.below(60));
            renderer.pass(camera, often, make_tiles(often.crop, 16), {begin, end});
            begin = end;
        }
    });
    out.measures = {exactly("pixels that differ", differ, 0),
                    exactly("pixels that differ with passes of any length", pixels_that_differ(once, often), 0)};
    return out;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b)
{
    const auto n = static_cast<double>(a.size());
    double ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
    for (size_t i = 0; i < a.size(); ++i) ma += a[i] / n, mb += b[i] / n;
    for (size_t i = 0; i < a.size(); ++i)
        aa += (a[i] - ma) * (a[i] - ma), bb += (b[i] - mb) * (b[i] - mb), ab += (a[i] - ma) * (b[i] - mb);
    return ab / std::sqrt(aa * bb);
}

Outcome neighbours(const Setup& setup)
{
    const KnownPoint k = known_point();
    Outcome out;
    const auto size = static_cast<uint32_t>(setup.scaled(64, 256, 1024));
    // The correlation in units of 1 / sqrt(n), the most of all pairs.
    double seeds = 0, pixels = 0, least_spread = 1;
    for (const SamplerKind sampler : {SamplerKind::independent, SamplerKind::sobol})
        for (const uint64_t seed : {uint64_t{0}, uint64_t{0xffffffff}, ~uint64_t{0}}) {
            const std::vector<double> a = errors_of(k, size, 16, sampler, seed, out);
            const std::vector<double> b = errors_of(k, size, 16, sampler, seed + 1, out);
            seeds = std::max(seeds, std::abs(correlation(a, b)) * std::sqrt(static_cast<double>(a.size())));
            least_spread = std::min(least_spread, *std::max_element(a.begin(), a.end()));
            for (const uint32_t step : {1u, size, size + 1}) {
                const std::vector<double> from(a.begin(), a.end() - step), to(a.begin() + step, a.end());
                pixels =
                    std::max(pixels, std::abs(correlation(from, to)) * std::sqrt(static_cast<double>(from.size())));
            }
        }
    out.measures = {at_most("correlation of pictures of neighbouring seeds, in 1/√n", seeds, 4),
                    at_most("correlation of neighbouring pixels, in 1/√n", pixels, 4),
                    at_least("largest error of a pixel: there is noise", least_spread, 1e-6)};
    return out;
}

// The last samples that 32 bits can number, far dimensions, and a pass that ends at the last one.
Outcome last_samples(const Setup& setup)
{
    size_t repeated = 0, outside = 0;
    const auto n = static_cast<uint32_t>(setup.scaled(5000, 200000, 2000000));
    for (const SamplerKind kind : {SamplerKind::independent, SamplerKind::sobol})
        for (const Dim dim : {Dim::pixel, Dim::light, Dim::bsdf})
            for (const uint32_t bounce : {0u, 1000u, 0xffffffu}) {
                std::set<std::pair<float, float>> points;
                const auto add = [&](uint32_t sample) {
                    const Vec2 p = Sampler(kind, 0, 7, sample, 0).get2(bounce, dim);
                    outside += !(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
                    repeated += !points.emplace(p.x, p.y).second;
                };
                for (uint32_t i = 0; i < n; ++i) add(i), add(UINT32_MAX - i), add(0x7fffffffu + i);
            }
    // Dimensions of one sample: bounce after bounce, all groups.
    std::set<std::pair<float, float>> points;
    for (uint32_t bounce = 0; bounce < n; ++bounce)
        for (uint32_t dim = 0; dim < 8; ++dim) {
            const Vec2 p = Sampler(SamplerKind::sobol, 0, 7, 0, 0).get2(bounce, static_cast<Dim>(dim));
            repeated += !points.emplace(p.x, p.y).second;
        }
    const SceneDescription scene = spheres_scene();
    Film film(8, 8, {0, 0, 8, 8});
    Outcome out;
    with_threads(2, [&] {
        const Renderer renderer(build_scene(scene), {});
        const PassResult pass = renderer.pass(camera_of(scene, renderer.scene(), 8, 8), film, make_tiles(film.crop, 4),
                                              {UINT32_MAX - 31, UINT32_MAX});
        out.dropped += pass.counters.dropped;
    });
    size_t wrong = 0;
    for (const Pixel& p : film.pixels) wrong += p.n != 31 || !(p.sum[1] > 0), out.samples += p.n;
    out.measures = {exactly("points that repeat", static_cast<double>(repeated), 0),
                    exactly("numbers outside [0, 1)", static_cast<double>(outside), 0),
                    exactly("pixels without the last 31 samples", static_cast<double>(wrong), 0)};
    return out;
}

}  // namespace

std::vector<Row> film_rows()
{
    return {
        {"A1", "1e6 and 2e7 samples of 0.1", "closed form", Tier::A, false, constant_samples},
        {"A2", "radiances of 1e6 and 1e-6 in one pixel", "long double sum", Tier::A, false, bright_and_faint},
        {"A3", "convergence from 2^2 to 2^16 spp", "closed form", Tier::A, false, convergence},
        {"A4", "1 to 64 threads, tiles of 8, 16, 32", "itself on one thread", Tier::A, false, threads_and_tiles, true},
        {"A5", "1024 samples in passes of 64, of 16, of any length", "itself in one pass", Tier::A, false,
         split_samples},
        {"A6", "neighbouring seeds and pixels; seeds 0, 2^32 - 1, 2^64 - 1", "no correlation", Tier::A, false,
         neighbours},
        {"A7", "sample 2^32 - 2, bounce 1000 and more", "policy", Tier::A, false, last_samples},
    };
}

}  // namespace lancer::stability
