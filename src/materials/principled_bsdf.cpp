#include "materials/principled_bsdf.h"

#include "materials/principled.h"
#include "materials/rough_diffuse.h"
#include "materials/thin_film.h"

namespace lancer {
namespace {

constexpr float last_number = 1 - 0x1p-24f;
constexpr Color white{1, 1, 1};

Color complement(Color c) { return white - c; }

float part_of_sheets(float r, bool through) { return static_cast<float>(part_of_sheet(double{r}, through)); }
Color part_of_sheets(Color r, bool through)
{
    return {part_of_sheets(r.r, through), part_of_sheets(r.g, through), part_of_sheets(r.b, through)};
}

// Schlick's reflectance with a tint where it is least: F82-tint of Kutz, Hasan and Edmondson, "Novel Aspects of the
// Adobe Standard Material", 2021. White is Schlick's own.
struct EdgeTint {
    Color f0, less;

    EdgeTint(Color normal, Color tint) : f0(normal)
    {
        constexpr float cos = 1.0f / 7, m = 1 - cos;
        less = fresnel_schlick(f0, double{cos}) * complement(tint) / (cos * (m * m * m * m * m * m));
    }
    Color at(float cos) const
    {
        const Color plain = fresnel_schlick(f0, double{cos});
        if (is_black(less)) return plain;
        const float c = in_range(cos), m = 1 - c, m2 = m * m;
        const Color tinted = plain - less * (c * m2 * m2 * m2);
        return {std::max(0.0f, tinted.r), std::max(0.0f, tinted.g), std::max(0.0f, tinted.b)};
    }
    // Weighted by the cosine.
    Color mean() const { return mean_schlick(f0) - less * (1.0f / 126); }

private:
    static float in_range(float x) { return std::min(1.0f, std::max(0.0f, x)); }
};

}  // namespace

void PrincipledBsdf::finish()
{
    const float body = part_of_body(), inside = part_of_glass();
    const bool reflects = metallic > 0 || (body > 0 && !is_black(material->specular));
    has_smooth = (fuzz > 0 && !is_black(fuzz_color)) || (coat > 0 && coat_alpha > 0) || (body > 0 && !is_black(base)) ||
                 (reflects && alpha.along > 0);
    if (!(inside > 0)) return;
    const GlassBsdf g = glass();
    sends_through = g.transmits(), has_smooth = has_smooth || !g.only_delta();
}

GlassBsdf PrincipledBsdf::glass() const
{
    return material->tables->glass.with({.front = front, .eta = media_eta}, white, roughness);
}

float PrincipledBsdf::index_beyond() const
{
    if (!(part_of_glass() > 0)) return 1;
    const GlassBsdf g = glass();
    return g.thin ? 1 : static_cast<float>(g.eta);
}

Color PrincipledBsdf::metal_reflectance(float cos) const
{
    const Color plain = EdgeTint(base, material->specular).at(cos);
    if (!(film > 0)) return plain * material->specular_weight;
    const Color covered = ThinFilm{material->film_ior, film_thickness}.on_metal(cos, plain);
    return mix(plain, covered, film) * material->specular_weight;
}

// Without the tint.
Color PrincipledBsdf::dielectric_reflectance(float cos) const
{
    const float n = material->tables->dielectric_ior, r = fresnel_dielectric(std::min(1.0f, cos), n).reflectance;
    const Color plain{r, r, r};
    if (!(film > 0)) return plain;
    return mix(plain, ThinFilm{material->film_ior, film_thickness}.on_dielectric(cos, n), film);
}

// The same, of all facets together, of which the bare ones lose a part.
Color PrincipledBsdf::dielectric_albedo(float cos, float lost) const
{
    if (!(film > 0) || alpha.along == 0) return dielectric_reflectance(cos) * (1 - lost);
    const float n = material->tables->dielectric_ior;
    const float bare = fresnel_dielectric(std::min(1.0f, cos), n).reflectance * (1 - lost);
    return mix(Color{bare, bare, bare}, material->tables->film->albedo(cos, roughness, film_thickness), film);
}

// What a film makes of the light that smooth glass, or a facet, reflects or lets through, as a factor. cos: at the
// facet, on the side of wo.
Color PrincipledBsdf::film_on_glass(const GlassBsdf& g, double cos, bool through) const
{
    const Fresnel f = fresnel_dielectric(std::min(1.0, cos), (1 - cos) * (1 + cos), g.eta);
    if (!(film > 0) || !(f.reflectance > 0 && f.reflectance < 1)) return white;
    const Color with = film_on_boundary(g, f, cos);
    if (g.thin) return part_of_sheets(with, through) / part_of_sheets(f.reflectance, through);
    return through ? complement(with) / (1 - f.reflectance) : with / f.reflectance;
}

// The reflectance of a boundary with the film.
Color PrincipledBsdf::film_on_boundary(const GlassBsdf& g, const Fresnel& bare, double cos) const
{
    const bool is_denser = g.eta >= 1;  // beyond
    const auto outside = static_cast<float>(is_denser ? cos : static_cast<double>(bare.cos_t));
    const auto n = static_cast<float>(is_denser ? g.eta : 1 / g.eta);
    const float r = bare.reflectance;
    return mix(Color{r, r, r}, ThinFilm{material->film_ior, film_thickness}.on_dielectric(outside, n), film);
}

// The coat: what it reflects, and what is left of the light that goes through it and comes back.
void PrincipledBsdf::add_coat(Lobes& s) const
{
    const PrincipledTables& tables = *material->tables;
    const float n = material->coat_ior;
    const Fresnel fresnel = fresnel_dielectric(std::min(1.0f, s.wo.z), n);
    if (coat_alpha > 0) s.coat_row = tables.coat->row(coat_alpha);
    const float albedo = fresnel.reflectance * (1 - s.coat_row.loss(s.wo.z));
    s.coat_chance = s.under_fuzz * coat * albedo;
    s.under_coat *= s.under_fuzz * (1 - coat * albedo);
    if (material->coat_color != white && fresnel.cos_t > 0) {
        const auto left = [&](float c) { return mix(1.0f, std::pow(c, 1 / fresnel.cos_t), coat); };
        const Color c = material->coat_color;
        s.under_coat *= Color{left(c.r), left(c.g), left(c.b)};
    }
    if (!(material->coat_darkening > 0)) return;
    // Light that the base sends is partly sent back by the coat, and meets the base again (OpenPBR, "coat darkening").
    const float even = 1 - (tables.coat_mean_through) / (n * n), rough = mix(1.0f, roughness, metallic);
    const float returned = mix(fresnel.reflectance, even, rough), amount = coat * material->coat_darkening;
    const auto darkened = [&](float color) {
        const float body = color * s.mean_through + (1 - s.mean_through);
        const float albedo_below = metallic * color + part_of_body() * body + part_of_glass();
        return mix(1.0f, (1 - returned) / (1 - std::min(1.0f, albedo_below) * returned), amount);
    };
    s.under_coat *= Color{darkened(base.r), darkened(base.g), darkened(base.b)};
}

// Losses of the facets of the base, and what follows from them.
void PrincipledBsdf::add_base(Lobes& s) const
{
    const PrincipledTables& tables = *material->tables;
    const bool is_rough = alpha.along > 0, is_wide = !alpha.is_even();
    const Vec3 o = to_float(s.along);
    if (metallic < 1) {
        float lost = 0;
        s.mean_through = tables.mean_through;
        if (is_rough && is_wide) {
            s.wide_dielectric = tables.wide_dielectric->at(roughness, anisotropy);
            lost = s.wide_dielectric.loss(o), s.mean_through = s.wide_dielectric.mean_missing();
        } else if (is_rough) {
            s.dielectric_row = tables.dielectric->row(alpha.along);
            lost = s.dielectric_row.loss(s.wo.z), s.mean_through = tables.dielectric->mean_missing(alpha.along);
        }
        s.through = complement(dielectric_albedo(s.wo.z, lost));
    }
    if (metallic > 0 && is_rough && tables.metal) {
        if (is_wide) {
            s.wide_metal = tables.wide_metal->at(roughness, anisotropy);
            s.lost = s.wide_metal.loss(o), s.mean_lost = s.wide_metal.mean_missing();
        } else {
            s.metal_row = tables.metal->row(alpha.along);
            s.lost = s.metal_row.loss(s.wo.z), s.mean_lost = tables.metal->mean_missing(alpha.along);
        }
        const Color f = EdgeTint(base, material->specular).mean() * material->specular_weight;
        const auto series = [&](float x) { return all_further_orders(x, s.mean_lost); };
        if (s.mean_lost > 0) s.further = {series(f.r), series(f.g), series(f.b)};
    }
}

void PrincipledBsdf::choose(Lobes& s) const
{
    const float below = max_component(s.under_coat), body = part_of_body();
    if (metallic > 0) {
        s.facet_chance += below * metallic * max_component(metal_reflectance(s.wo.z)) * (1 - s.lost);
        s.diffuse_chance += below * metallic * max_component(s.further) * s.lost;
    }
    if (body > 0) {
        s.facet_chance += below * body * max_component(material->specular * complement(s.through));
        s.diffuse_chance += below * body * max_component(base * s.through);
    }
    s.glass_chance =
        below * part_of_glass() * std::max(max_component(material->specular), max_component(transmittance));
    const float sum = s.diffuse_chance + s.coat_chance + s.facet_chance + s.glass_chance;
    if (!(sum > 0)) return;
    for (float* chance : {&s.diffuse_chance, &s.coat_chance, &s.facet_chance, &s.glass_chance}) *chance /= sum;
}

PrincipledBsdf::Lobes PrincipledBsdf::seen_from(Vec3 wo) const
{
    const Vec3d unit = unit_in_double(wo);
    Lobes s{.wo = wo, .o = unit, .along = to_tangent(unit)};
    if (fuzz > 0) {
        const FuzzTable& table = *material->tables->fuzz;
        const float albedo = fuzz * table.albedo(wo.z, {fuzz_roughness});
        s.fuzz_scale = fuzz * table.scale({fuzz_roughness});
        s.under_fuzz = 1 - albedo;
        s.diffuse_chance = albedo * max_component(fuzz_color);
    }
    add_base(s);
    if (coat > 0)
        add_coat(s);
    else
        s.under_coat *= s.under_fuzz;
    choose(s);
    return s;
}

// Without what is above. Plastic's formula, which lets light travel both ways; towards a film or a rough body, whose
// value is not even, what is let through counts as seen from wo alone, so that no light is lost.
Color PrincipledBsdf::diffuse(const Lobes& s, Vec3 wi) const
{
    const float rough = material->diffuse_roughness, both_ways = (1 - rough) * (1 - film);
    Color through = s.through;
    if (both_ways > 0) {
        float lost = s.dielectric_row.loss(wi.z);
        if (alpha.along > 0 && !alpha.is_even())
            lost = s.wide_dielectric.loss(to_float(to_tangent(unit_in_double(wi))));
        const float r = fresnel_dielectric(std::min(1.0f, wi.z), material->tables->dielectric_ior).reflectance;
        const float back = (1 - r * (1 - lost)) / s.mean_through;
        through *= both_ways < 1 ? mix(1.0f, back, both_ways) : back;
    }
    const float part = part_of_body();
    if (!(rough > 0)) return base * through * (part * pdf_cosine_hemisphere(wi.z));
    return RoughDiffuse(rough).eval(base, s.wo, wi) * through * (part * wi.z);
}

BsdfValue PrincipledBsdf::eval_lobes(const Lobes& s, Vec3 wi) const
{
    BsdfValue f{};
    if (wi.z > 0) {
        f.pdf = s.diffuse_chance * pdf_cosine_hemisphere(wi.z);
        if (fuzz > 0) f.f_cos += fuzz_color * (s.fuzz_scale * Fuzz{fuzz_roughness}.eval(s.wo, wi) * wi.z);
        const Vec3d i = unit_in_double(wi), o = s.o;
        if (coat > 0 && coat_alpha > 0) {
            const FacetReflection facets = eval_facets(Ggx{double{coat_alpha}}, o, i);
            const float r = fresnel_dielectric(static_cast<float>(facets.cos_h), material->coat_ior).reflectance;
            const float value = s.under_fuzz * coat * r * static_cast<float>(facets.f_cos);
            f.f_cos += Color{value, value, value};
            f.pdf += s.coat_chance * static_cast<float>(facets.pdf);
        }
        Color below{};
        const float body = part_of_body();
        if (alpha.along > 0 && (metallic > 0 || body > 0)) {
            const FacetReflection facets =
                alpha.is_even()
                    ? eval_facets(Ggx{double{alpha.along}}, o, i)
                    : eval_stretched(StretchedGgx{double{alpha.along}, double{alpha.across}}, s.along, to_tangent(i));
            const auto cos = static_cast<float>(facets.cos_h);
            Color r{};
            if (metallic > 0) r += metal_reflectance(cos) * metallic;
            if (body > 0) r += material->specular * dielectric_reflectance(cos) * body;
            below += r * static_cast<float>(facets.f_cos);
            f.pdf += s.facet_chance * static_cast<float>(facets.pdf);
            if (metallic > 0 && s.mean_lost > 0) {
                const float lost =
                    alpha.is_even() ? s.metal_row.loss(wi.z) : s.wide_metal.loss(to_float(to_tangent(i)));
                below += s.further * (metallic * s.lost * lost / s.mean_lost * pdf_cosine_hemisphere(wi.z));
            }
        }
        if (body > 0) below += diffuse(s, wi);
        f.f_cos += s.under_coat * below;
    }
    if (sends_through) add_glass(s, wi, f);
    return f;
}

void PrincipledBsdf::add_glass(const Lobes& s, Vec3 wi, BsdfValue& f) const
{
    const GlassBsdf g = glass();
    const BsdfValue v = g.eval(s.wo, wi);
    if (!(v.pdf > 0)) return;
    const bool through = wi.z < 0;
    const Color factor = s.under_coat * (through ? transmittance : material->specular) * part_of_glass();
    if (!(film > 0)) {
        f.f_cos += v.f_cos * factor;
    } else if (g.thin) {  // whose lobes are not those of facets at an angle
        f.f_cos += v.f_cos * factor * film_on_glass(g, double{s.wo.z}, through);
    } else {
        // Of single scattering, at the facet that turns wo to wi; the rest is as without a film.
        GlassBsdf once = g;
        once.multiple = {};
        const Vec3d o = s.o, i = unit_in_double(wi);
        const Vec3d sum = through ? o + g.eta * i : o + i;
        const double cos = std::min(1.0, std::abs(dot(o, sum)) / length(sum));
        const Color single = once.eval(s.wo, wi).f_cos;
        f.f_cos += factor * (v.f_cos - single + single * film_on_glass(g, cos, through));
    }
    f.pdf += s.glass_chance * v.pdf;
}

BsdfValue PrincipledBsdf::eval(Vec3 wo, Vec3 wi) const { return wo.z > 0 ? eval(seen_from(wo), wi) : BsdfValue{}; }

std::optional<BsdfSample> PrincipledBsdf::sample(Vec3 wo, float u, Vec2 v) const
{
    return wo.z > 0 ? sample(seen_from(wo), u, v) : std::nullopt;
}

BsdfValue PrincipledBsdf::eval(const Lobes& s, Vec3 wi) const
{
    if (!has_smooth || wi.z == 0 || (wi.z < 0 && !sends_through)) return {};
    return eval_lobes(s, wi);
}

Color PrincipledBsdf::eval_diffuse(Vec3 wo, Vec3 wi) const
{
    if (wo.z <= 0 || wi.z <= 0 || !(part_of_body() > 0)) return {};
    const Lobes s = seen_from(wo);
    return s.under_coat * diffuse(s, wi);
}

// Delta lobes of one direction are one: the mirror image first, what goes through last, so that the number that chooses
// finds them at both ends.
std::optional<BsdfSample> PrincipledBsdf::sample(const Lobes& s, float u, Vec2 v) const
{
    const Vec3 wo = s.wo;
    Color reflected{}, sent{};
    float mirror = 0, ahead = 0, smooth_coat = s.coat_chance, smooth_facets = s.facet_chance, smooth_glass = 0;
    Vec3 beyond{};
    float index = 1;
    if (coat > 0 && coat_alpha == 0) {
        const float r = fresnel_dielectric(std::min(1.0f, wo.z), material->coat_ior).reflectance;
        reflected += white * (s.under_fuzz * coat * r);
        mirror += s.coat_chance, smooth_coat = 0;
    }
    if (alpha.along == 0) {
        Color r = material->specular * complement(s.through) * part_of_body();
        if (metallic > 0) r += metal_reflectance(wo.z) * metallic;
        reflected += s.under_coat * r;
        mirror += s.facet_chance, smooth_facets = 0;
    }
    const bool has_glass = part_of_glass() > 0;
    const GlassBsdf g = has_glass ? glass() : GlassBsdf{};
    if (has_glass && !g.only_delta()) {
        smooth_glass = s.glass_chance;
    } else if (has_glass && s.glass_chance > 0) {
        const Color factor = s.under_coat * part_of_glass();
        for (const float end : {0.0f, last_number}) {
            const auto lobe = g.sample(wo, end, v);
            if (!lobe || (end > 0 && lobe->wi.z > 0)) continue;
            const bool through = lobe->wi.z < 0;
            if (through && end == 0) continue;  // nothing is reflected; it comes again
            const Color value = factor * lobe->weight * lobe->pdf * film_on_glass(g, double{wo.z}, through);
            if (through)
                sent = value * transmittance, ahead = s.glass_chance * lobe->pdf, beyond = lobe->wi, index = lobe->eta;
            else
                reflected += value * material->specular, mirror += s.glass_chance * lobe->pdf;
        }
    }
    const float smooth = s.diffuse_chance + smooth_coat + smooth_facets + smooth_glass;
    if (!(mirror + ahead + smooth > 0)) return {};
    if (ahead > 0 && (u >= 1 - ahead || (!(smooth > 0) && u >= mirror)))
        return BsdfSample{.wi = beyond, .weight = sent / ahead, .pdf = ahead, .delta = true, .eta = index};
    if (mirror > 0 && (u < mirror || !(smooth > 0)))
        return BsdfSample{.wi = {-wo.x, -wo.y, wo.z}, .weight = reflected / mirror, .pdf = mirror, .delta = true};
    // Which of the others, the last one of them up to the end.
    float at = u - mirror;
    std::optional<Vec3> wi;
    if (at < s.diffuse_chance || !(smooth_coat + smooth_facets + smooth_glass > 0)) {
        wi = square_to_cosine_hemisphere(v);
    } else if (at -= s.diffuse_chance; at < smooth_coat || !(smooth_facets + smooth_glass > 0)) {
        wi = sample_facets(Ggx{double{coat_alpha}}, s.o, v);
    } else if (at -= smooth_coat; at < smooth_facets || !(smooth_glass > 0)) {
        wi = sample_base(s, v);
    } else {
        at = std::clamp((at - smooth_facets) / smooth_glass, 0.0f, last_number);
        const auto lobe = g.sample(wo, at, v);
        if (!lobe) return {};
        wi = lobe->wi, index = lobe->eta;
    }
    if (!wi || wi->z == 0 || (wi->z < 0 && !(smooth_glass > 0))) return {};
    const BsdfValue f = eval_lobes(s, *wi);
    if (!(f.pdf > 0)) return {};
    return BsdfSample{.wi = *wi, .weight = f.f_cos / f.pdf, .pdf = f.pdf, .eta = wi->z < 0 ? index : 1};
}

std::optional<Vec3> PrincipledBsdf::sample_base(const Lobes& s, Vec2 v) const
{
    if (alpha.is_even()) return sample_facets(Ggx{double{alpha.along}}, s.o, v);
    const Vec3d h = StretchedGgx{double{alpha.along}, double{alpha.across}}.sample_visible(s.along, v);
    const Vec3d wi = mirrored(s.along, h);
    const double c = double{turn.x}, n = double{turn.y};
    const Vec3 back = to_float(Vec3d{c * wi.x - n * wi.y, n * wi.x + c * wi.y, wi.z});
    if (!(back.z > 0)) return {};
    return back;
}

Vec3d PrincipledBsdf::to_tangent(Vec3d w) const
{
    if (alpha.is_even()) return w;
    const double c = double{turn.x}, n = double{turn.y};
    return {c * w.x + n * w.y, c * w.y - n * w.x, w.z};
}

Color PrincipledBsdf::reflectance() const
{
    const PrincipledTables& tables = *material->tables;
    const float through = tables.mean_through, of_coat = coat * (1 - tables.coat_mean_through);
    const Color body = material->specular * (1 - through) + base * through;
    Color below = body * part_of_body() + transmittance * part_of_glass();
    if (metallic > 0) below += base * (metallic * material->specular_weight);
    if (coat > 0) below = below * mix(white, material->coat_color, coat) * (1 - of_coat) + white * of_coat;
    if (!(fuzz > 0)) return below;
    const float covered = fuzz * tables.fuzz->albedo(0.5f, {fuzz_roughness});
    return mix(below, fuzz_color, covered);
}

}  // namespace lancer
