#include "reference/scattering_media.h"

#include <algorithm>

namespace reference {
namespace {

constexpr double without_end = std::numeric_limits<double>::infinity();

// The albedo of a single scattering at which a half-space reflects `diffuse`, by bisection of van de Hulst's formula.
double single_albedo(double diffuse, double g)
{
    double low = 0, high = 1;  // of s, with which the reflection falls
    for (int i = 0; i < 60; ++i) {
        const double s = 0.5 * (low + high);
        ((1 - s) * (1 - 0.139 * s) / (1 + 1.17 * s) > diffuse ? low : high) = s;
    }
    const double s2 = 0.25 * (low + high) * (low + high);
    return (1 - s2) / (1 - g * s2);
}

// Of even light within a body the part that leaves it.
double leaving(double index)
{
    constexpr int steps = 4096;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double cos = (i + 0.5) / steps, sine2 = (1 - cos * cos) * index * index;
        if (sine2 >= 1) continue;
        const double t = std::sqrt(1 - sine2);
        const double p = (index * t - cos) / (index * t + cos), s = (t - index * cos) / (t + index * cos);
        sum += (1 - 0.5 * (p * p + s * s)) * 2 * cos / steps;
    }
    return sum;
}

Within coefficients(const lancer::MaterialDescription& m)
{
    Within w;
    w.g = double{m.scattering_anisotropy};
    w.scattering = rgb(m.scattering), w.absorption = rgb(m.absorption);
    if (!m.subsurface_color) return w;
    const double out = m.ior == 1 ? 1 : leaving(double{m.ior});
    const auto set = [&](double color, double radius, double& s, double& a) {
        const double albedo = single_albedo(color / (out + (1 - out) * color), w.g);
        s = albedo / radius, a = (1 - albedo) / radius;
    };
    const Rgb color = rgb(*m.subsurface_color), radius = rgb(m.subsurface_radius);
    set(color.r, radius.r, w.scattering.r, w.absorption.r);
    set(color.g, radius.g, w.scattering.g, w.absorption.g);
    set(color.b, radius.b, w.scattering.b, w.absorption.b);
    return w;
}

}  // namespace

Within along(const World& world, const Inside& in, const Ray& ray, double t)
{
    if (const Inside::There there = in.there(world); there.material) {
        Within w = coefficients(world.materials[*there.material].what);
        w.to = t;
        return w;
    }
    if (!world.fog) return {};
    Within w;
    w.scattering = rgb(world.fog->scattering), w.absorption = rgb(world.fog->absorption);
    w.g = double{world.fog->anisotropy}, w.to = t;
    const auto clip = [&](double org, double dir, double low, double high) {
        if (dir == 0) {
            if (org < low || org > high) w.to = 0;
            return;
        }
        const double a = (low - org) / dir, b = (high - org) / dir;
        w.from = std::max(w.from, std::min(a, b)), w.to = std::min(w.to, std::max(a, b));
    };
    const lancer::Vec3d none{without_end, without_end, without_end};
    const lancer::Vec3d low = world.fog->low.value_or(-none), high = world.fog->high.value_or(none);
    clip(ray.org.x, ray.dir.x, low.x, high.x);
    clip(ray.org.y, ray.dir.y, low.y, world.fog->height && !world.fog->z_up ? *world.fog->height : high.y);
    clip(ray.org.z, ray.dir.z, low.z, world.fog->height && world.fog->z_up ? *world.fog->height : high.z);
    return w.from < w.to ? w : Within{};
}

Rgb transmittance(const Within& w)
{
    const Rgb sigma = w.scattering + w.absorption;
    const auto part = [&](double s) { return s > 0 ? std::exp(-s * (w.to - w.from)) : 1; };
    return {part(sigma.r), part(sigma.g), part(sigma.b)};
}

std::optional<double> track(const Within& w, Rgb& throughput, Random& random)
{
    if (black(w.scattering)) {
        throughput = throughput * transmittance(w);
        return {};
    }
    const Rgb sigma = w.scattering + w.absorption;
    const double most = largest(sigma);
    double t = w.from;
    for (;;) {
        t -= std::log1p(-random.next()) / most;
        if (!(t < w.to)) return {};
        const Rgb null = grey(most) - sigma;
        const double scatter = largest(w.scattering * throughput), pass = largest(null * throughput);
        if (!(scatter + pass > 0)) return t;  // black
        const double p = scatter / (scatter + pass);
        if (random.next() < p) {
            throughput = throughput * w.scattering * (1 / (most * p));
            return t;
        }
        throughput = throughput * null * (1 / (most * (1 - p)));
    }
}

double henyey_greenstein(double g, double cosine)
{
    return (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

Vec deflected(double g, Vec direction, Random& random)
{
    const double u = random.next(), turn = 2 * pi * random.next();
    double cosine = 1 - 2 * u;
    if (g != 0) {
        const double s = (1 - g * g) / (1 + g - 2 * g * u);
        cosine = std::clamp((1 + g * g - s * s) / (2 * g), -1.0, 1.0);
    }
    const double sine = std::sqrt(1 - cosine * cosine);
    return unit(Basis(direction).to_world({sine * std::cos(turn), sine * std::sin(turn), cosine}));
}

}  // namespace reference
