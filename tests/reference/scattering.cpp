#include "reference/scattering.h"

#include "reference/fresnel.h"
#include "reference/principled.h"

namespace reference {
namespace {

// Malley's method: Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., section A.5.3, on a polar disk.
Vec cosine_direction(Random& random)
{
    const double r2 = random.next(), turn = 2 * pi * random.next(), r = std::sqrt(r2);
    return {r * std::cos(turn), r * std::sin(turn), std::sqrt(1 - r2)};
}

Vec half_way(Vec a, Vec b) { return unit(a + b); }

// What a pane sends back and lets through, order by order: light that is between its faces is met by one of them, which
// reflects a part; each meeting multiplies by the tint.
struct Pane {
    double back = 0, through = 0;
};
Pane pane(double r, double tint)
{
    Pane p{r * tint, 0};
    double between = (1 - r) * tint;
    for (int face = 1; between > 1e-18 && face < 100000; ++face) {
        (face % 2 == 1 ? p.through : p.back) += between * (1 - r) * tint;
        between *= r * tint;
    }
    return p;
}
Rgb of_pane(double cos, double index, Rgb tint, bool through)
{
    const double r = reflectance(cos, index);
    const auto part = [&](double c) { return through ? pane(r, c).through : pane(r, c).back; };
    return {part(tint.r), part(tint.g), part(tint.b)};
}

}  // namespace

double Facets::density(Vec m) const
{
    const double cos2 = m.z * m.z, tan2 = (m.x * m.x + m.y * m.y) / cos2, a2 = alpha * alpha;
    return a2 / (pi * cos2 * cos2 * (a2 + tan2) * (a2 + tan2));
}
double Facets::lambda(Vec w) const
{
    const double tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
    return (std::sqrt(1 + alpha * alpha * tan2) - 1) / 2;
}
Vec Facets::seen_from(Vec w, double u, double v) const
{
    const Vec stretched = unit(Vec{alpha * w.x, alpha * w.y, w.z});
    const double flat2 = stretched.x * stretched.x + stretched.y * stretched.y;
    const Vec t1 = flat2 > 0 ? Vec{-stretched.y, stretched.x, 0} * (1 / std::sqrt(flat2)) : Vec{1, 0, 0};
    const Vec t2 = cross(stretched, t1);
    const double r = std::sqrt(u), turn = 2 * pi * v, s = 0.5 * (1 + stretched.z);
    const double p1 = r * std::cos(turn);
    const double p2 = (1 - s) * std::sqrt(1 - p1 * p1) + s * r * std::sin(turn);
    const Vec n = t1 * p1 + t2 * p2 + stretched * std::sqrt(std::max(0.0, 1 - p1 * p1 - p2 * p2));
    return unit(Vec{alpha * n.x, alpha * n.y, std::max(1e-300, n.z)});
}

CoatAlbedo::CoatAlbedo(double index, double alpha) : index_(index), alpha_(alpha)
{
    const Facets facets{alpha};
    for (int i = 0; i <= steps && alpha > 0; ++i) {
        // Of grazing angles the limit: nearly the last node.
        const double cos = std::max(1e-6, std::pow(static_cast<double>(i) / steps, 2));
        const Vec wo{std::sqrt((1 - cos) * (1 + cos)), 0, cos};
        constexpr int n = 48;
        double sum = 0;
        for (int a = 0; a < n; ++a)
            for (int b = 0; b < n; ++b) {
                const Vec m = facets.seen_from(wo, (a + 0.5) / n, (b + 0.5) / n), wi = mirror_image(wo, m);
                if (wi.z > 0)
                    sum += reflectance(std::min(1.0, dot(wo, m)), index) * facets.both_seen(wo, wi) *
                           (1 + facets.lambda(wo));
            }
        albedo_[static_cast<size_t>(i)] = sum / (n * n);
    }
    constexpr int slices = 20000;
    for (int i = 0; i < slices; ++i) {
        const double s = (i + 0.5) / slices, cos = s * s;
        mean_ += at(cos) * 2 * cos * 2 * s / slices;
    }
}
double CoatAlbedo::at(double cos) const
{
    if (alpha_ == 0) return reflectance(cos, index_);
    const double place = std::sqrt(std::min(1.0, cos)) * steps;
    const auto i = std::min(static_cast<size_t>(place), static_cast<size_t>(steps - 1));
    return albedo_[i] + (albedo_[i + 1] - albedo_[i]) * (place - static_cast<double>(i));
}

bool Bsdf::only_delta() const
{
    switch (kind) {
        case Kind::lambert:
        case Kind::translucent:
        case Kind::principled:
            return false;
        case Kind::plastic:
            return alpha == 0 && black(color);
        case Kind::interface:
            return black(diffuse) && black(gloss);
        default:
            return alpha == 0;
    }
}

Rgb Bsdf::facet_reflectance(double cos) const
{
    if (kind == Kind::plastic) return coat * reflectance(cos, index);
    if (kind == Kind::mirror) return color;
    if (!conductor) return schlick(color, cos);
    const auto& [eta, k] = *conductor;
    return color * Rgb{reflectance(cos, std::complex(eta.r, k.r)), reflectance(cos, std::complex(eta.g, k.g)),
                       reflectance(cos, std::complex(eta.b, k.b))};
}

Rgb Bsdf::eval(Vec wo, Vec wi) const
{
    if (wo.z <= 0) return {};
    return eval_once(wo, wi) + even.eval(wo, wi);
}
Rgb Bsdf::eval_once(Vec wo, Vec wi) const
{
    if (kind == Kind::glass) return alpha > 0 ? eval_glass(wo, wi) : Rgb{};
    if (kind == Kind::sheet) return alpha > 0 ? eval_sheet(wo, wi) : Rgb{};
    if (kind == Kind::translucent) return (wi.z > 0 ? diffuse : through) * (std::abs(wi.z) / pi);
    if (wi.z <= 0) return {};
    if (kind == Kind::principled) return principled->eval(wo, wi, color);
    const double lambertian = wi.z / pi;
    if (kind == Kind::lambert) return color * lambertian;
    if (kind == Kind::interface) {
        const double along = dot(wi, Vec{-wo.x, -wo.y, wo.z});
        const double lobe = along > 0 ? (shininess + 2) / (2 * pi) * std::pow(along, shininess) : 0;
        return diffuse * lambertian + gloss * (lobe * wi.z);
    }
    Rgb f;
    if (alpha > 0) {
        const Facets facets{alpha};
        const Vec m = half_way(wo, wi);
        f = facet_reflectance(dot(wo, m)) * (facets.density(m) * facets.both_seen(wo, wi) / (4 * wo.z));
    }
    if (kind == Kind::plastic)
        f += color *
             ((1 - coat_albedo->at(wo.z)) * (1 - coat_albedo->at(wi.z)) / (1 - coat_albedo->mean()) * lambertian);
    return f;
}

// Equations 20 and 21 of Walter et al., for radiance that comes from wi; lights are as bright as they are in the medium
// where they stand, so what goes through is over the squared index.
Rgb Bsdf::eval_glass(Vec wo, Vec wi) const
{
    const Facets facets{alpha};
    if (wi.z > 0) {
        const Vec m = half_way(wo, wi);
        return color * (reflectance(dot(wo, m), index) * facets.density(m) * facets.both_seen(wo, wi) / (4 * wo.z));
    }
    if (wi.z == 0) return {};
    Vec m = unit(wo + index * wi);
    if (m.z < 0) m = -m;
    const double o = dot(wo, m), i = dot(wi, m);
    if (o <= 0 || i >= 0) return {};
    const double below = o + index * i;
    const double f = o * -i / (wo.z * -wi.z) * (1 - reflectance(o, index)) * facets.both_seen(wo, -wi) *
                     facets.density(m) / (below * below);
    return color * (f * -wi.z);
}

std::optional<Scattered> Bsdf::sample(Vec wo, Random& random) const
{
    if (wo.z <= 0) return {};
    if (!even.here) return sample_once(wo, random);
    const bool is_even = random.next() < 0.5;
    std::optional<Scattered> s = is_even ? sample_even(wo, random) : sample_once(wo, random);
    if (s) s->weight = s->weight * 2;
    return s;
}

std::optional<Scattered> Bsdf::sample_even(Vec wo, Random& random) const
{
    Vec wi = cosine_direction(random);
    const double cos = wi.z;
    if (!(cos > 0)) return {};
    const bool both = kind != Kind::metal, passes = both && random.next() < 0.5;
    if (passes) wi.z = -cos;
    return Scattered{wi, even.eval(wo, wi) * ((both ? 2 : 1) * pi / cos), false,
                     passes && kind == Kind::glass ? index : 1};
}

std::optional<Scattered> Bsdf::sample_once(Vec wo, Random& random) const
{
    switch (kind) {
        case Kind::lambert:
            return Scattered{cosine_direction(random), color};
        case Kind::translucent: {
            // One half of the samples each.
            const Vec wi = cosine_direction(random);
            const bool passes = random.next() < 0.5;
            return Scattered{{wi.x, wi.y, passes ? -wi.z : wi.z}, (passes ? through : diffuse) * 2};
        }
        case Kind::glass:
            return sample_glass(wo, random);
        case Kind::sheet:
            return sample_sheet(wo, random);
        case Kind::plastic:
            return sample_plastic(wo, random);
        case Kind::interface:
            return sample_interface(wo, random);
        case Kind::principled:
            return sample_principled(wo, random);
        default:
            return sample_facets(wo, random);
    }
}

std::optional<Scattered> Bsdf::sample_facets(Vec wo, Random& random) const
{
    if (alpha == 0) return Scattered{{-wo.x, -wo.y, wo.z}, facet_reflectance(wo.z), true};
    const Facets facets{alpha};
    const double u = random.next(), v = random.next();
    const Vec m = facets.seen_from(wo, u, v), wi = mirror_image(wo, m);
    if (wi.z <= 0) return {};
    const double seen = facets.both_seen(wo, wi) * (1 + facets.lambda(wo));
    return Scattered{wi, facet_reflectance(std::min(1.0, dot(wo, m))) * seen};
}

std::optional<Scattered> Bsdf::sample_glass(Vec wo, Random& random) const
{
    const Facets facets{alpha};
    const double u = random.next(), v = random.next(), choice = random.next();
    const Vec m = alpha > 0 ? facets.seen_from(wo, u, v) : Vec{0, 0, 1};
    const double cos = std::min(1.0, dot(wo, m));
    const bool reflects = choice < reflectance(cos, index);
    const Vec wi = reflects ? mirror_image(wo, m) : refracted(wo, m, index);
    if ((wi.z > 0) != reflects || wi.z == 0) return {};
    Scattered s{wi, color, alpha == 0, reflects ? 1 : index};
    if (!reflects) s.weight = s.weight * (1 / (index * index));
    if (alpha > 0) s.weight = s.weight * (facets.both_seen(wo, reflects ? wi : -wi) * (1 + facets.lambda(wo)));
    return s;
}

// A lobe about the mirror image, and one mirrored to the other side, narrower by 0.83 |index - 1|; what they carry
// is the pane's at the angle of wo or of wi, the lesser.
Rgb Bsdf::eval_sheet(Vec wo, Vec wi) const
{
    if (wi.z == 0) return {};
    const bool passes = wi.z < 0;
    const Vec above{wi.x, wi.y, std::abs(wi.z)}, m = half_way(wo, above);
    const Facets facets{alpha * (passes ? std::min(1.0, 0.83 * std::abs(index - 1)) : 1)};
    const Rgb a = of_pane(wo.z, index, color, passes), b = of_pane(above.z, index, color, passes);
    return Rgb{std::min(a.r, b.r), std::min(a.g, b.g), std::min(a.b, b.b)} *
           (facets.density(m) * facets.both_seen(wo, above) / (4 * wo.z));
}
// One half of the samples each.
std::optional<Scattered> Bsdf::sample_sheet(Vec wo, Random& random) const
{
    const bool passes = random.next() < 0.5;
    if (alpha == 0) {
        const double z = passes ? -wo.z : wo.z;
        return Scattered{{-wo.x, -wo.y, z}, of_pane(wo.z, index, color, passes) * 2, true};
    }
    const Facets facets{alpha * (passes ? std::min(1.0, 0.83 * std::abs(index - 1)) : 1)};
    const double u = random.next(), v = random.next();
    const Vec m = facets.seen_from(wo, u, v), above = mirror_image(wo, m);
    if (above.z <= 0) return {};
    const Rgb a = of_pane(wo.z, index, color, passes), b = of_pane(above.z, index, color, passes);
    const double seen = facets.both_seen(wo, above) * (1 + facets.lambda(wo));
    return Scattered{{above.x, above.y, passes ? -above.z : above.z},
                     Rgb{std::min(a.r, b.r), std::min(a.g, b.g), std::min(a.b, b.b)} * (2 * seen)};
}

// What is sharp, and the rest by the cosine: one half of the samples each where there is both.
std::optional<Scattered> Bsdf::sample_principled(Vec wo, Random& random) const
{
    const Rgb sharp = principled->mirror(wo, color);
    const double chance = black(sharp) ? 0 : 0.5;
    if (random.next() < chance) return Scattered{{-wo.x, -wo.y, wo.z}, sharp * 2, true};
    const Vec wi = cosine_direction(random);
    if (!(wi.z > 0)) return {};
    return Scattered{wi, principled->eval(wo, wi, color) * (pi / wi.z / (1 - chance))};
}

// Each lobe by itself: the mean over the choice is their sum.
std::optional<Scattered> Bsdf::sample_plastic(Vec wo, Random& random) const
{
    const double reflected = coat_albedo->at(wo.z), passed = 1 - reflected;
    const double of_coat = largest(coat) * reflected, of_base = largest(color) * passed;
    if (!(of_coat + of_base > 0)) return {};
    const double p = of_coat / (of_coat + of_base);
    if (random.next() < p) {
        std::optional<Scattered> s = sample_facets(wo, random);
        if (s) s->weight = s->weight * (1 / p);
        return s;
    }
    const Vec wi = cosine_direction(random);
    return Scattered{wi, color * (passed * (1 - coat_albedo->at(wi.z)) / (1 - coat_albedo->mean()) / (1 - p))};
}

// Lafortune and Willems, "Using the Modified Phong Reflectance Model for Physically Based Rendering", 1994, section 4.
std::optional<Scattered> Bsdf::sample_interface(Vec wo, Random& random) const
{
    const double f = refracts ? reflectance(wo.z, index) : 1;
    const double parts[] = {largest(diffuse), largest(gloss), largest(mirror) * f, largest(through) * (1 - f)};
    const double sum = parts[0] + parts[1] + parts[2] + parts[3];
    if (!(sum > 0)) return {};
    double u = random.next() * sum;
    const Vec away{-wo.x, -wo.y, wo.z};
    if ((u -= parts[0]) < 0) return Scattered{cosine_direction(random), diffuse * (sum / parts[0])};
    if ((u -= parts[1]) < 0) {
        const double cos = std::pow(1 - random.next(), 1 / (shininess + 1)), turn = 2 * pi * random.next();
        const double sin = std::sqrt((1 - cos) * (1 + cos));
        const Vec wi = Basis(away).to_world({sin * std::cos(turn), sin * std::sin(turn), cos});
        if (wi.z <= 0) return {};
        return Scattered{wi, gloss * ((shininess + 2) / (shininess + 1) * wi.z * sum / parts[1])};
    }
    if ((u -= parts[2]) < 0) return Scattered{away, mirror * (f * sum / parts[2]), true};
    if (!(parts[3] > 0)) return {};
    return Scattered{refracted(wo, {0, 0, 1}, index), through * ((1 - f) / (index * index) * sum / parts[3]), true,
                     index};
}

}  // namespace reference
