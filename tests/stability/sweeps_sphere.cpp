// Sweeps beside rows P of the stability matrix.
#include <cmath>

#include "stability/exact.h"
#include "stability/sphere_cases.h"
#include "stability/sweep.h"
#include "support/addressed.h"

namespace lancer::stability {
namespace {

// b^2 - 4ac in float, the first root beyond t_min.
std::optional<float> naive_t(const Sphere& s, const Ray& ray, float t_min)
{
    const Vec3 oc = ray.org - to_float(s.center);
    const auto r = static_cast<float>(s.radius);
    const float a = dot(ray.dir, ray.dir), b = 2 * dot(oc, ray.dir), c = dot(oc, oc) - r * r;
    const float discriminant = b * b - 4 * a * c;
    if (discriminant < 0) return {};
    const float root = std::sqrt(discriminant), t0 = (-b - root) / (2 * a), t1 = (-b + root) / (2 * a);
    if (t0 > t_min) return t0;
    if (t1 > t_min) return t1;
    return {};
}

// From a distance of 1 from the surface, at some point of what is seen of it.
Sweep radius_over_distance()
{
    SweepCurve product{"lancer", {}}, naive{"b^2 - 4ac in float", {}};
    for (int half = -12; half <= 12; ++half) {
        const double ratio = std::pow(10.0, half / 2.0);
        double worst = 0, naive_worst = 0;
        for (uint64_t i = 0; i < 2000; ++i) {
            AddressedRandom random(1, i);
            const Vec3d n = random.direction();
            const Sphere s{random.direction() * 0.5, ratio};
            const Vec3 org = to_float(s.center + n * (s.radius + 1));
            const Vec3d at = s.center + normalize(n * 2.0 + random.direction()) * s.radius;
            const Ray ray{.org = org, .dir = to_float(normalize(at - to_double(org)))};
            const Roots exact = roots(s, ray);
            if (exact.discriminant < 1e-3L) continue;
            const auto truth = static_cast<double>(exact.t0);
            const auto error = [&](std::optional<double> t) { return t ? std::abs(*t - truth) / truth : 1; };
            const auto t = intersect(s, ray);
            worst = std::max(worst, error(t ? std::optional<double>(static_cast<float>(*t)) : std::nullopt));
            naive_worst = std::max(naive_worst, error(naive_t(s, ray, 0)));
        }
        product.points.push_back({ratio, worst});
        naive.points.push_back({ratio, naive_worst});
    }
    return {
        "Distance to a sphere", "radius over distance", "largest relative error of t; 1: not hit", {product, naive}};
}

// Straight through two concentric spheres: rays that meet other than four surfaces.
double naive_shell(double thickness, uint64_t rays)
{
    const std::array<Sphere, 2> shell{Sphere{{}, 1}, Sphere{{}, 1 - thickness}};
    double wrong = 0;
    for (uint64_t i = 0; i < rays; ++i) {
        AddressedRandom random(3, i);
        const Vec3d axis = random.direction(), side = normalize(cross(axis, random.direction()));
        const double off = shell[1].radius * (1 - 1e-6) * std::sqrt(random.uniform());
        Ray ray{.org = to_float(side * off - axis * 3.0), .dir = to_float(axis)};
        int surfaces = 0;
        for (; surfaces < 8; ++surfaces) {
            std::optional<float> nearest;
            for (const Sphere& s : shell)
                if (const auto t = naive_t(s, ray, 1e-4f); t && (!nearest || *t < *nearest)) nearest = t;
            if (!nearest) break;
            ray.org = ray.org + ray.dir * *nearest;
        }
        wrong += surfaces != 4;
    }
    return wrong / static_cast<double>(rays);
}
Sweep shell_thickness()
{
    SweepCurve product{"lancer", {}}, naive{"float, rays start at t = 1e-4", {}};
    constexpr uint64_t rays = 4000;
    for (int half = -16; half <= -2; ++half) {
        const double thickness = std::pow(10.0, half / 2.0);
        const ShellCount count = cross_shell("embree", thickness, rays);
        product.points.push_back({thickness, count.wrong_straight / count.rays});
        naive.points.push_back({thickness, naive_shell(thickness, rays)});
    }
    return {"Surfaces of a thin shell",
            "thickness over radius",
            "part of the rays that do not meet all four",
            {product, naive}};
}
Sweep shell_light()
{
    SweepCurve product{"lancer", {}};
    for (int half = -14; half <= -3; ++half) {
        const double thickness = std::pow(10.0, half / 2.0);
        product.points.push_back({thickness, cross_shell("embree", thickness, 4000).worst_radiance_inside});
    }
    return {"Light through a thin shell",
            "thickness over radius",
            "largest relative error, to 0.9 radii from the middle",
            {product}};
}

}  // namespace

std::vector<Sweep> sphere_sweeps() { return {radius_over_distance(), shell_thickness(), shell_light()}; }

}  // namespace lancer::stability
