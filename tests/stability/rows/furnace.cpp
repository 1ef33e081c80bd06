// Rows D9 and D10: places so uniform that what is seen is known exactly.
#include "stability/groups.h"
#include "stability/shots.h"
#include "support/facet_cells.h"

namespace lancer::stability {
namespace {

SceneDescription ball_under_sky(const MaterialDescription& m, bool multiscatter,
                                std::vector<MaterialDescription> parts = {})
{
    SceneDescription d;
    d.materials = std::move(parts);
    d.materials.push_back(m);
    d.spheres.push_back(sphere_of({0, 0, 0}, 1, m.name));
    d.lights.push_back(sky_of({1, 1, 1}));
    d.render.multiscatter = multiscatter;
    d.camera = make_camera({0.4, 0.5, 3}, {0, 0, 0}, 28);  // nothing but the ball, to its edge
    return d;
}

// What a metal reflects of even light, the most and the least of all angles.
struct Range {
    double least = std::numeric_limits<double>::infinity(), most = 0;
};
Range albedo_of_metal(float roughness, bool compensated, int n)
{
    Range range;
    const auto table = std::make_shared<AlbedoTable>(FacetKind::reflector);
    table->need(alpha_of_roughness(roughness));
    const Metal metal{{1, 1, 1}, roughness, {}, compensated ? table : nullptr};
    const auto bsdf = metal.at({});
    for (const double cos : {1.0, 0.9, 0.7, 0.5, 0.3, 0.1, 0.03, 0.01}) {
        const Vec3 wo = to_float(Vec3d{std::sqrt((1 - cos) * (1 + cos)), 0, cos});
        double sum = 0;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const auto u = static_cast<float>(std::fmod((i * n + j) * 0.618033988749895, 1.0));
                const Vec2 v{(static_cast<float>(i) + 0.5f) / static_cast<float>(n),
                             (static_cast<float>(j) + 0.5f) / static_cast<float>(n)};
                if (const auto s = bsdf.sample(wo, u, v)) sum += double{s->weight.g} / (n * n);
            }
        range.least = std::min(range.least, sum), range.most = std::max(range.most, sum);
    }
    return range;
}

Outcome white_furnace(const Setup& setup)
{
    Outcome out;
    const auto spp = static_cast<uint32_t>(setup.scaled(64, 1024, 8192));
    Shot shot{
        .integrator = without_roulette({}), .width = 16, .height = 16, .spp = spp, .sampler = SamplerKind::independent};
    const auto off = [&](const MaterialDescription& m, std::vector<MaterialDescription> parts = {}) {
        return worst_pixel(shoot(ball_under_sky(m, false, std::move(parts)), shot, setup, out), {1, 1, 1});
    };
    const MaterialDescription white = make_lambert("white", {1, 1, 1});
    MaterialDescription glass = white, mirror = white, mixed = white;
    glass.name = "glass", glass.type = MaterialType::glass;
    mirror.name = "mirror", mirror.type = MaterialType::mirror;
    mixed.name = "mixed", mixed.type = MaterialType::mix, mixed.first = "white", mixed.second = "mirror";
    out.measures.push_back(at_most("Lambert, a pixel from 1", off(white), 1e-4));
    out.measures.push_back(at_most("mirror", off(mirror), 1e-4));
    for (const float ior : {1.0f, 1.5f, 0.7f, 2.42f}) {
        glass.ior = ior;
        out.measures.push_back(at_most("glass of index " + significant(double{ior}), off(glass), 1e-4));
    }
    out.measures.push_back(at_most("mix of Lambert and mirror", off(mixed, {white, mirror}), 1e-4));
    mixed.second = "glass", glass.ior = 1.5f;
    out.measures.push_back(at_most("mix of Lambert and glass", off(mixed, {white, glass}), 1e-4));
    // A surface that sees itself: paths of several bounces, without roulette and with it.
    SceneDescription bumpy = ball_under_sky(white, false);
    bumpy.spheres.clear(), bumpy.materials.clear();
    bumpy.meshes.push_back(make_mesh(make_uv_sphere(12, 24, 0.15, white)));
    out.measures.push_back(at_most("bumpy Lambert", worst_pixel(shoot(bumpy, shot, setup, out), {1, 1, 1}), 1e-4));
    Shot by_chance = shot;
    by_chance.integrator = Path{};
    const stats::Tally t = tally(shoot(bumpy, by_chance, setup, out));
    out.measures.push_back(at_most("with roulette, in sigma", std::abs(t.mean - 1) / std::max(t.error(), 1e-6), 3));
    const auto n = static_cast<int>(setup.scaled(96, 512, 512));
    for (const float r : {0.05f, 0.3f, 0.5f, 0.7f, 1.0f}) {
        const std::string name = "GGX metal, roughness " + significant(double{r}, 2);
        out.measures.push_back(at_most(name, albedo_of_metal(r, false, n).most, 1.001));
        const Range whole = albedo_of_metal(r, true, n);
        out.measures.push_back(at_least(name + ", compensated, least", whole.least, 0.99));
        out.measures.push_back(at_most(name + ", compensated, most", whole.most, 1.01));
    }
    for (const float r : {0.3f, 1.0f}) {
        const double seen = tally(shoot(ball_under_sky(make_glossy("metal", MaterialType::metal, {1, 1, 1}, r), true),
                                        shot, setup, out))
                                .mean;
        out.measures.push_back(
            at_least("picture of a compensated metal, roughness " + significant(double{r}, 2), seen, 0.99));
        out.measures.push_back(at_most("the same", seen, 1.01));
    }
    return out;
}

Outcome closed_furnaces(const Setup& setup)
{
    Outcome out;
    const bool small = setup.tier == Tier::A;
    // Paths are some 1 / (1 - rho) long: 0.999 has its turn in tier B.
    for (const float rho :
         small ? std::vector<float>{0.5f, 0.9f, 0.99f} : std::vector<float>{0.5f, 0.9f, 0.99f, 0.999f})
        for (const bool by_pixel : {true, false}) {
            const double expected = 1 / (1 - double{rho});
            Path path;
            path.roulette_by_pixel = by_pixel, path.direct = {false, false};
            const uint32_t spp = small         ? (rho > 0.9f ? 16 : 64)
                                 : by_pixel    ? (rho > 0.99f ? 1280 : 64)
                                 : rho > 0.99f ? 128
                                               : 512;
            const Film film =
                shoot(closed_furnace(rho),
                      {.integrator = path, .width = 16, .height = 16, .spp = spp, .sampler = SamplerKind::independent},
                      setup, out);
            const stats::Tally t = tally(film);
            const std::string name =
                "rho " + significant(double{rho}) + (by_pixel ? ", roulette by pixel" : ", by throughput");
            out.measures.push_back(at_most(name + ": distance from E / (1 - rho), in sigma",
                                           std::abs(t.mean / expected - 1) / std::max(t.error() / expected, 3e-6), 3));
            // Of the roulette that is the product's choice; the other one is noisier.
            const double most = small ? 0.002 * std::sqrt(64.0 / spp) : 0.002;
            out.measures.push_back(by_pixel ? at_most(name + ": sigma", t.error() / expected, most)
                                            : told(name + ": sigma", t.error() / expected));
        }
    double worst = 0;
    for (const float rho : {0.5f, 0.9f, 0.99f, 0.999f})
        for (const uint32_t depth : {1u, 2u, 8u, 64u, 1000u}) {
            const double r = rho, series = (1 - std::pow(r, depth + 1.0)) / (1 - r);
            const Path path = without_roulette({.max_depth = depth, .direct = {false, false}});
            const Film film =
                shoot(closed_furnace(rho), {.integrator = path, .width = 4, .height = 4, .spp = 1}, setup, out);
            const auto e = static_cast<float>(series);
            worst = std::max(worst, worst_pixel(film, {e, e, e}));
        }
    out.measures.push_back(at_most("paths that end at depths from 1 to 1000", worst, 1e-5));
    return out;
}

}  // namespace

std::vector<Row> furnace_rows()
{
    return {{"D9", "white furnace: Lambert, GGX, glass, mixed", "closed form", Tier::A, false, white_furnace},
            {"D10", "closed furnace, albedo 0.5 to 0.999", "closed form", Tier::A, false, closed_furnaces}};
}

}  // namespace lancer::stability
