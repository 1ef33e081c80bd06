#include "reference/principled.h"

#include <array>
#include <complex>

#include "reference/fresnel.h"
#include "reference/scattering.h"

namespace reference {
namespace {

Rgb rgb_of(lancer::Color c) { return {double{c.r}, double{c.g}, double{c.b}}; }
Rgb blend(Rgb a, Rgb b, double t) { return a * (1 - t) + b * t; }
double alpha_of(double roughness) { return roughness * roughness < 1e-5 ? 0 : roughness * roughness; }

// Means over visible normals of reflectance(cosine at the facet) times what other facets leave of the light.
template <class F>
auto of_facets(double alpha, double cos, const F& reflectance_at)
{
    const Facets facets{alpha};
    const Vec wo{std::sqrt(std::max(0.0, (1 - cos) * (1 + cos))), 0, cos};
    constexpr int n = 40;
    decltype(reflectance_at(1.0)) sum{};
    for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b) {
            const Vec m = facets.seen_from(wo, (a + 0.5) / n, (b + 0.5) / n), wi = mirror_image(wo, m);
            if (wi.z > 0)
                sum = sum + reflectance_at(std::min(1.0, dot(wo, m))) *
                                (facets.both_seen(wo, wi) * (1 + facets.lambda(wo)) / (n * n));
        }
    return sum;
}

// Reflectance of a film at one wave number: Airy's sum of amplitudes, both polarisations.
double airy(double cos, double film, double base, double thickness, double wave_number, double sharp_s, double sharp_p)
{
    using C = std::complex<double>;
    const double inside = std::sqrt(1 - (1 - cos * cos) / (film * film));
    const double beyond = std::sqrt(std::max(0.0, 1 - (1 - cos * cos) / (base * base)));
    const C turn = std::exp(C(0, 4 * pi * film * thickness * inside * wave_number));
    const auto sum = [&](double first, double second) {
        return std::norm((first + second * turn) / (1.0 + first * second * turn));
    };
    const double s1 = (cos - film * inside) / (cos + film * inside), p1 = (film * cos - inside) / (film * cos + inside);
    const double s2 = sharp_s != 0 ? sharp_s : (film * inside - base * beyond) / (film * inside + base * beyond);
    const double p2 = sharp_p != 0 ? sharp_p : (base * inside - film * beyond) / (base * inside + film * beyond);
    return 0.5 * (sum(s1, s2) + sum(p1, p2));
}

}  // namespace

// The mean of Airy's sum over three Gaussian bands of wave numbers.
Rgb PrincipledModel::film_over(double cos, bool on_metal, Rgb metal) const
{
    const std::array middle{1.0 / 600, 1.0 / 545, 1.0 / 455}, width{8.3e-5, 1.0e-4, 1.03e-4},
        base{metal.r, metal.g, metal.b};
    std::array<double, 3> out{};
    for (size_t c = 0; c < 3; ++c) {
        double sum = 0, weights = 0;
        for (double x = -3; x <= 3.001; x += 0.25) {
            const double weight = std::exp(-0.5 * x * x), amplitude = on_metal ? std::sqrt(base[c]) : 0;
            sum += weight * airy(cos, double{what_.film_ior}, index_, double{what_.film_thickness},
                                 middle[c] + x * width[c], -amplitude, amplitude);
            weights += weight;
        }
        out[c] = sum / weights;
    }
    return {out[0], out[1], out[2]};
}

PrincipledModel::PrincipledModel(const lancer::MaterialDescription& what)
    : what_(what),
      alpha_(0),
      coat_alpha_(what.coat > 0 ? alpha_of(double{what.coat_roughness}) : 0),
      index_(double{what.ior}),
      metallic_(double{what.metallic.value_or(0.0f)})
{
    if (what.transmission > 0 || what.anisotropy > 0)
        throw std::invalid_argument("the reference knows no principled glass and no anisotropy");
    // The weight scales the reflectance from the front.
    const double amplitude = (index_ - 1) / (index_ + 1) * std::sqrt(double{what.specular_weight});
    index_ = (1 + amplitude) / (1 - amplitude);
    const double rough = double{what.roughness}, coat_rough = std::sqrt(coat_alpha_);
    const double under = std::pow(std::min(1.0, std::pow(rough, 4) + 2 * std::pow(coat_rough, 4)), 0.25);
    alpha_ = alpha_of(rough + (under - rough) * double{what.coat});
    reflected_ = ByCosine<Rgb>::of(64, [&](double cos) {
        const auto at_facet = [&](double c) { return dielectric(c); };
        return alpha_ > 0 ? of_facets(alpha_, cos, at_facet) : at_facet(cos);
    });
    mean_through_ = 1 - under_even_light([&](double cos) {
                        const auto bare = [&](double c) { return reflectance(c, index_); };
                        return alpha_ > 0 && what_.film == 0 ? reflected_.at(cos).r : bare(cos);
                    });
    const double n = double{what.coat_ior};
    coat_ = ByCosine<double>::of(64, [&](double cos) {
        const auto at_facet = [&](double c) { return reflectance(c, n); };
        return coat_alpha_ > 0 ? of_facets(coat_alpha_, cos, at_facet) : at_facet(cos);
    });
    coat_mean_through_ = 1 - under_even_light([&](double cos) { return reflectance(cos, n); });
    fuzz_ = ByCosine<double>::of(64, [&](double cos) {
        const Vec wo{std::sqrt(std::max(0.0, (1 - cos) * (1 + cos))), 0, cos};
        constexpr int steps = 64;
        double sum = 0;
        for (int a = 0; a < steps; ++a)
            for (int b = 0; b < steps; ++b) {
                const double s = (a + 0.5) / steps, z = s * s, r = std::sqrt(1 - z * z),
                             turn = 2 * pi * (b + 0.5) / steps;
                sum += fuzz_value(wo, {r * std::cos(turn), r * std::sin(turn), z}) * z * 2 * s;
            }
        return sum * 2 * pi / (steps * steps);
    });
    for (const double albedo : fuzz_.nodes) fuzz_scale_ = std::min(fuzz_scale_, 1 / albedo);
}

// Estevez and Kulla's distribution, with the visibility of Neubelt and Pettineo.
double PrincipledModel::fuzz_value(Vec wo, Vec wi) const
{
    const double alpha = std::max(0.26 * 0.26, std::pow(double{what_.fuzz_roughness}, 2));
    const Vec h = unit(wo + wi);
    const double sin = std::sqrt(h.x * h.x + h.y * h.y);
    return (2 + 1 / alpha) * std::pow(sin, 1 / alpha) / (2 * pi) / (4 * (wo.z + wi.z - wo.z * wi.z));
}
double PrincipledModel::under_fuzz(double cos) const
{
    return 1 - double{what_.fuzz} * std::min(1.0, fuzz_scale_ * fuzz_.at(cos));
}

// F82-tint.
Rgb PrincipledModel::metal(double cos, Rgb base) const
{
    const double seventh = 1.0 / 7;
    const Rgb b =
        schlick(base, seventh) * (grey(1) - rgb_of(what_.specular)) * (1 / (seventh * std::pow(1 - seventh, 6)));
    const Rgb bare = schlick(base, cos) - b * (cos * std::pow(1 - cos, 6));
    const Rgb covered = what_.film > 0 ? blend(bare, film_over(cos, true, bare), double{what_.film}) : bare;
    return covered * double{what_.specular_weight};
}
Rgb PrincipledModel::dielectric(double cos) const
{
    const Rgb bare = grey(reflectance(cos, index_));
    return what_.film > 0 ? blend(bare, film_over(cos, false, {}), double{what_.film}) : bare;
}

// What a coat leaves of the light of the base, by its albedo, its colour and what it sends back in.
Rgb PrincipledModel::under_coat(double cos, Rgb base) const
{
    const double part = double{what_.coat}, n = double{what_.coat_ior};
    if (part == 0) return grey(1);
    const double beyond = std::sqrt(1 - (1 - cos * cos) / (n * n)),
                 rough = 1 - metallic_ + metallic_ * std::sqrt(alpha_);
    const double even = 1 - coat_mean_through_ / (n * n);
    const double returned = reflectance(cos, n) * (1 - rough) + even * rough;
    const auto channel = [&](double color, double tint) {
        const double below = metallic_ * color + (1 - metallic_) * (color * mean_through_ + 1 - mean_through_);
        const double darker = (1 - returned) / (1 - below * returned);
        return (1 - part * coat_.at(cos)) * (1 + part * (std::pow(tint, 1 / beyond) - 1)) *
               (1 + part * double{what_.coat_darkening} * (darker - 1));
    };
    const Rgb tint = rgb_of(what_.coat_color);
    return {channel(base.r, tint.r), channel(base.g, tint.g), channel(base.b, tint.b)};
}

// The diffuse body under its dielectric: Fujii's model with what it lacks, by Portsmouth, Kutz and Hill.
Rgb PrincipledModel::body(Vec wo, Vec wi, Rgb base) const
{
    const double r = double{what_.diffuse_roughness}, a = 1 / (1 + (0.5 - 2 / (3 * pi)) * r);
    const auto albedo = [&](double cos) {
        const double theta = std::acos(std::min(1.0, cos)), sin = std::sin(theta), tan = std::tan(theta);
        const double g = sin * (theta - sin * cos) + 2.0 / 3 * (tan * (1 - sin * sin * sin) - sin);
        return a * (1 + r * g / pi);
    };
    const double s = wo.x * wi.x + wo.y * wi.y, t = s > 0 ? std::max(wo.z, wi.z) : 1;
    const double mean = a * (1 + (2.0 / 3 - 28 / (15 * pi)) * r);
    const double lost = r > 0 ? (1 - albedo(wo.z)) * (1 - albedo(wi.z)) / (1 - mean) : 0;
    const auto value = [&](double rho) {
        return (rho * a * (1 + r * s / t) + rho * rho * mean / (1 - rho * (1 - mean)) * lost) / pi;
    };
    const double both = (1 - r) * (1 - double{what_.film});
    const double back = 1 + both * ((1 - reflected_.at(wi.z).r) / mean_through_ - 1);
    const Rgb through = (grey(1) - reflected_.at(wo.z)) * (both > 0 ? back : 1);
    return Rgb{value(base.r), value(base.g), value(base.b)} * through * (wi.z * (1 - metallic_));
}

Rgb PrincipledModel::eval(Vec wo, Vec wi, Rgb base) const
{
    if (wo.z <= 0 || wi.z <= 0) return {};
    const Vec m = unit(wo + wi);
    const auto lobe = [&](double alpha) {
        const Facets facets{alpha};
        return facets.density(m) * facets.both_seen(wo, wi) / (4 * wo.z);
    };
    const double cos = dot(wo, m);
    Rgb f = rgb_of(what_.fuzz_color) * (double{what_.fuzz} * fuzz_scale_ * fuzz_value(wo, wi) * wi.z);
    if (what_.coat > 0 && coat_alpha_ > 0)
        f += grey(under_fuzz(wo.z) * double{what_.coat} * reflectance(cos, double{what_.coat_ior}) * lobe(coat_alpha_));
    Rgb below = body(wo, wi, base);
    if (alpha_ > 0) {
        below +=
            (metal(cos, base) * metallic_ + rgb_of(what_.specular) * dielectric(cos) * (1 - metallic_)) * lobe(alpha_);
        if (metallic_ > 0) {
            const Rgb b = schlick(base, 1.0 / 7) * (grey(1) - rgb_of(what_.specular)) * (7 * std::pow(7.0 / 6, 6));
            const Rgb mean = (base * (20.0 / 21) + grey(1.0 / 21) - b * (1.0 / 126)) * double{what_.specular_weight};
            below += even_lobes(FacetsOf::metal, 1, alpha_, mean).eval(wo, wi) * metallic_;
        }
    }
    return f + under_coat(wo.z, base) * below * under_fuzz(wo.z);
}

Rgb PrincipledModel::mirror(Vec wo, Rgb base) const
{
    Rgb sharp{};
    if (what_.coat > 0 && coat_alpha_ == 0)
        sharp += grey(double{what_.coat} * reflectance(wo.z, double{what_.coat_ior}));
    if (alpha_ == 0)
        sharp += under_coat(wo.z, base) *
                 (metal(wo.z, base) * metallic_ + rgb_of(what_.specular) * dielectric(wo.z) * (1 - metallic_));
    return sharp * under_fuzz(wo.z);
}

}  // namespace reference
