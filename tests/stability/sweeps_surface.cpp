// Sweeps beside rows D of the stability matrix: roughness, index of refraction, depth.
#include <algorithm>

#include "materials/fresnel.h"
#include "stability/shots.h"
#include "stability/sweep.h"
#include "support/exact_fresnel.h"
#include "support/exact_ggx.h"

namespace lancer::stability {
namespace {

double median(std::vector<double> v)
{
    if (v.empty()) return 0;
    std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
    return v[v.size() / 2];
}

// As it is mostly written: from the cosine, which a narrow lobe hardly changes.
float density_by_cosine(Vec3 h, float alpha)
{
    const float a2 = alpha * alpha, d = h.z * h.z * (a2 - 1) + 1;
    return a2 / (pi * d * d);
}

Sweep over_roughness()
{
    SweepCurve ours{"lancer", {}}, naive{"float, from the cosine", {}};
    for (double x = 1; x > 0.9e-5; x /= std::sqrt(10.0)) {
        const auto alpha = static_cast<float>(x);
        std::vector<double> a, b;
        for (const auto& [wo, wi] : pairs_of(alpha)) {
            const Long o = unit(wo), w = unit(wi), sum{o.x + w.x, o.y + w.y, o.z + w.z};
            const long double l = std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
            const long double exact = exact_density({sum.x / l, sum.y / l, sum.z / l}, alpha);
            const double found = Ggx{alpha}.density(unit_in_double(wo) + unit_in_double(wi));
            const float plain = density_by_cosine(normalize(wo + wi), alpha);
            a.push_back(static_cast<double>(std::abs(static_cast<float>(found) / exact - 1)));
            b.push_back(std::isfinite(plain) ? static_cast<double>(std::abs(plain / exact - 1))
                                             : std::numeric_limits<double>::infinity());
        }
        ours.points.push_back({x, median(a)}), naive.points.push_back({x, median(b)});
    }
    return {"Density of GGX normals", "alpha", "relative error, median", {ours, naive}};
}

float textbook_fresnel(float cos_i, float eta)
{
    const float sin2_t = (1 - cos_i * cos_i) / (eta * eta);
    if (sin2_t >= 1) return 1;
    const float cos_t = std::sqrt(1 - sin2_t);
    const float s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t), p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    return 0.5f * (s * s + p * p);
}

Sweep over_index()
{
    SweepCurve ours{"lancer", {}}, naive{"float, as in the textbook", {}};
    for (double x = 1e-7; x < 20; x *= std::sqrt(10.0)) {
        const auto eta = static_cast<float>(1 + x);
        if (eta == 1) continue;
        std::vector<double> a, b;
        for (int i = 1; i <= 200; ++i) {
            const float c = static_cast<float>(i) / 200;
            const long double exact = exact_fresnel(c, eta).reflectance;
            a.push_back(static_cast<double>(std::abs(fresnel_dielectric(c, eta).reflectance / exact - 1)));
            b.push_back(static_cast<double>(std::abs(textbook_fresnel(c, eta) / exact - 1)));
        }
        ours.points.push_back({x, median(a)}), naive.points.push_back({x, median(b)});
    }
    return {
        "Reflectance of a dielectric", "index of refraction - 1", "relative error, median over angles", {ours, naive}};
}

// Walls that emit e and mirror 0.999, from inside: e (1 + a + ... + a^depth).
double error_at_depth(uint32_t depth, bool mirror)
{
    SceneDescription d;
    MaterialDescription m = make_lambert("wall", {0.999f, 0.999f, 0.999f});
    m.type = mirror ? MaterialType::mirror : MaterialType::lambert;
    m.emission = {1, 1, 1};
    m.emission_both_sides = true;
    d.meshes.push_back(make_mesh(make_cube(m)));
    d.camera = make_camera({0.3, 0.2, -0.1}, {-0.5, -0.4, -1}, 60);
    const double a = double{0.999f}, series = (1 - std::pow(a, depth + 1.0)) / (1 - a);
    Outcome out;
    const Film film = shoot(d,
                            {.integrator = without_roulette({.max_depth = depth, .direct = {false, false}}),
                             .width = 2,
                             .height = 2,
                             .spp = 1},
                            {}, out);
    const auto e = static_cast<float>(series);
    return worst_pixel(film, {e, e, e});
}

Sweep over_depth()
{
    SweepCurve mirrors{"lancer, box of mirrors", {}}, furnace{"lancer, diffuse furnace", {}},
        drift{"length of a direction that is never made unit again", {}};
    Vec3 w = normalize(Vec3{0.3f, 0.5f, 0.7f});
    uint32_t reflected = 0;
    for (const uint32_t depth : {1u, 3u, 10u, 30u, 100u, 300u, 1000u, 3000u, 10000u, 30000u, 100000u}) {
        for (; reflected < depth; ++reflected) {
            const Vec3 n = normalize(
                Vec3{std::sin(static_cast<float>(reflected)), std::cos(3.0f * static_cast<float>(reflected)), 0.5f});
            w = w - n * (2 * dot(w, n));
        }
        mirrors.points.push_back({double(depth), error_at_depth(depth, true)});
        furnace.points.push_back({double(depth), error_at_depth(depth, false)});
        drift.points.push_back({double(depth), std::abs(length(to_double(w)) - 1)});
    }
    return {"Light after many bounces, albedo 0.999", "bounces", "relative error", {mirrors, furnace, drift}};
}

}  // namespace

std::vector<Sweep> surface_sweeps() { return {over_roughness(), over_index(), over_depth()}; }

}  // namespace lancer::stability
