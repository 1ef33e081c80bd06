#include "materials/principled_bsdf.h"

#include "materials/principled.h"

namespace lancer {
namespace {

constexpr float last_number = 1 - 0x1p-24f;
constexpr Color white{1, 1, 1};

Color complement(Color c) { return white - c; }

// What a tint takes from Schlick's reflectance, but for the cosine times the sixth power of its complement.
Color edge_of(Color f0, Color tint)
{
    constexpr float cos = 1.0f / 7, m = 1 - cos;
    return fresnel_schlick(f0, double{cos}) * complement(tint) / (cos * (m * m * m * m * m * m));
}

}  // namespace

void PrincipledBsdf::finish()
{
    body = (1 - metallic) * (1 - transmission), clear = (1 - metallic) * transmission;
    facet_alpha = alpha.along;
    specular = material->specular, specular_weight = material->specular_weight;
    finish_base();
    finish_coat();
    finish_extras();
    const bool reflects = metallic > 0 || (body > 0 && !is_black(specular));
    has_smooth = (fuzz > 0 && !is_black(fuzz_color)) || (coat > 0 && coat_alpha > 0) || (body > 0 && !is_black(base)) ||
                 (reflects && facet_alpha > 0);
    is_queued = !(clear > 0);
    if (is_queued) return;
    glass = material->tables->glass.with({.front = front, .eta = media_eta}, white, roughness);
    sends_through = glass.transmits(), has_smooth = has_smooth || !glass.only_delta();
    is_queued = glass.is_rough_boundary() && !(film > 0);
    if (film > 0 && sends_through) film_losses = losses_of_film();
}

// Losses of the facets of the base, and what follows from them.
void PrincipledBsdf::finish_base()
{
    const PrincipledTables& tables = *material->tables;
    const bool is_rough = facet_alpha > 0, is_wide = !alpha.is_even();
    dielectric_ior = tables.dielectric_ior, mean_through = 1;
    if (metallic < 1) {
        mean_through = tables.mean_through;
        if (is_rough && is_wide) {
            wide_dielectric = tables.wide_dielectric->at(roughness, anisotropy);
            mean_through = wide_dielectric.mean_missing();
        } else if (is_rough) {
            dielectric_row = tables.dielectric->row(facet_alpha);
            mean_through = tables.dielectric->mean_missing(facet_alpha);
        }
    }
    if (!(metallic > 0)) return;
    edge = edge_of(base, specular);
    if (!is_rough || !tables.metal) return;
    if (is_wide) {
        wide_metal = tables.wide_metal->at(roughness, anisotropy);
        mean_lost = wide_metal.mean_missing();
    } else {
        metal_row = tables.metal->row(facet_alpha);
        mean_lost = tables.metal->mean_missing(facet_alpha);
    }
    if (!(mean_lost > 0)) return;
    // The mean of the tinted reflectance, weighted by the cosine.
    const Color f = (mean_schlick(base) - edge * (1.0f / 126)) * specular_weight;
    further = each(f, [&](float x) { return all_further_orders(x, mean_lost); });
}

void PrincipledBsdf::finish_coat()
{
    const PrincipledTables& tables = *material->tables;
    coat_ior = material->coat_ior;
    if (coat_alpha > 0) coat_row = tables.coat->row(coat_alpha);
    coat_even = 1 - (tables.coat_mean_through) / (coat_ior * coat_ior), blur = mix(1.0f, roughness, metallic);
    coat_darkening = coat * material->coat_darkening;
}

void PrincipledBsdf::finish_extras()
{
    const PrincipledTables& tables = *material->tables;
    diffuse_roughness = material->diffuse_roughness;
    kinds = {.tint = coat > 0 && material->coat_color != white,
             .fuzz = fuzz > 0,
             .film = film > 0,
             .wide = !alpha.is_even(),
             .rough_body = diffuse_roughness > 0,
             .clear = clear > 0};
    kinds.any = kinds.tint || kinds.fuzz || kinds.film || kinds.wide || kinds.rough_body || kinds.clear;
    if (kinds.tint) coat_color = material->coat_color;
    if (kinds.wide) across = alpha.across;
    if (kinds.film) film_ior = material->film_ior, film_roughness = roughness, film_table = tables.film.get();
    if (kinds.fuzz) fuzz_row = tables.fuzz->row(fuzz_roughness), fuzz_scale = fuzz * fuzz_row.scale();
}

float PrincipledBsdf::index_beyond() const
{
    if (!(clear > 0)) return 1;
    return glass.thin ? 1 : static_cast<float>(glass.eta);
}

PrincipledBsdf::Seen PrincipledBsdf::seen_from(Vec3 wo) const
{
    Seen s{.wo = wo, .o = unit_in_double(wo)};
    see(*this, s);
    return s;
}

BsdfValue PrincipledBsdf::eval_lobes(const Seen& s, Vec3 wi) const
{
    BsdfValue f{};
    if (wi.z > 0) f = eval_above(*this, s, wi, unit_in_double(wi));
    if (sends_through) add_glass(s, wi, f);
    return f;
}

void PrincipledBsdf::add_glass(const Seen& s, Vec3 wi, BsdfValue& f) const
{
    const GlassBsdf& g = glass;
    const BsdfValue v = g.eval(s.wo, wi);
    if (!(v.pdf > 0)) return;
    const bool through = wi.z < 0;
    const Color factor = s.under_coat * (through ? transmittance : specular) * clear;
    if (!(film > 0)) {
        f.f_cos += v.f_cos * factor;
    } else {
        GlassBsdf once = g;
        once.multiple = {};
        const Vec3d o = s.o, i = unit_in_double(wi);
        const Color single = once.eval(s.wo, wi).f_cos;
        const Color further = film_losses ? further_with_film(s, wi) : v.f_cos - single;
        Color of_film;
        if (g.thin) {  // whose lobes are not those of facets at an angle
            of_film = sheet_with_film(o, i, through);
        } else {  // at the facet that turns wo to wi
            const Vec3d sum = through ? o + g.eta * i : o + i;
            of_film = film_on_glass(std::min(1.0, std::abs(dot(o, sum)) / length(sum)), through);
        }
        f.f_cos += factor * (further + single * of_film);
    }
    f.pdf += s.glass_chance * v.pdf;
}

BsdfValue PrincipledBsdf::eval(Vec3 wo, Vec3 wi) const { return wo.z > 0 ? eval(seen_from(wo), wi) : BsdfValue{}; }

std::optional<BsdfSample> PrincipledBsdf::sample(Vec3 wo, float u, Vec2 v) const
{
    return wo.z > 0 ? sample(seen_from(wo), u, v) : std::nullopt;
}

BsdfValue PrincipledBsdf::eval(const Seen& s, Vec3 wi) const
{
    if (!has_smooth || wi.z == 0 || (wi.z < 0 && !sends_through)) return {};
    return eval_lobes(s, wi);
}

Color PrincipledBsdf::eval_diffuse(Vec3 wo, Vec3 wi) const
{
    if (wo.z <= 0 || wi.z <= 0 || !(body > 0)) return {};
    const Seen s = seen_from(wo);
    return s.under_coat * diffuse(s, wi, unit_in_double(wi));
}

// Delta lobes of one direction are one: the mirror image first, what goes through last, so that the number that chooses
// finds them at both ends.
std::optional<BsdfSample> PrincipledBsdf::sample(const Seen& s, float u, Vec2 v) const
{
    const Vec3 wo = s.wo;
    auto [reflected, mirror] = mirrored_by(*this, s);
    Color sent{};
    const float smooth_coat = coat_alpha > 0 ? s.coat_chance : 0, smooth_facets = facet_alpha > 0 ? s.facet_chance : 0;
    float ahead = 0, smooth_glass = 0;
    Vec3 beyond{};
    float index = 1;
    const bool has_glass = clear > 0;
    const GlassBsdf& g = glass;
    if (has_glass && !g.only_delta()) {
        smooth_glass = s.glass_chance;
    } else if (has_glass && s.glass_chance > 0) {
        const Color factor = s.under_coat * clear;
        for (const float end : {0.0f, last_number}) {
            const auto lobe = g.sample(wo, end, v);
            if (!lobe || (end > 0 && lobe->wi.z > 0)) continue;
            const bool through = lobe->wi.z < 0;
            if (through && end == 0) continue;  // nothing is reflected; it comes again
            const Color value = factor * lobe->weight * lobe->pdf * film_on_glass(double{wo.z}, through);
            if (through)
                sent = value * transmittance, ahead = s.glass_chance * lobe->pdf, beyond = lobe->wi, index = lobe->eta;
            else
                reflected += value * specular, mirror += s.glass_chance * lobe->pdf;
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
        wi = g.sample_direction(wo, s.o, at, v);
    }
    if (!wi || wi->z == 0 || (wi->z < 0 && !(smooth_glass > 0))) return {};
    const BsdfValue f = eval_lobes(s, *wi);
    if (!(f.pdf > 0)) return {};
    return BsdfSample{.wi = *wi, .weight = f.f_cos / f.pdf, .pdf = f.pdf, .eta = g.index_towards(*wi)};
}

std::optional<Vec3> PrincipledBsdf::sample_base(const Seen& s, Vec2 v) const
{
    if (alpha.is_even()) return sample_facets(Ggx{double{alpha.along}}, s.o, v);
    const SinCos phi = sin_cos_2pi(v.x);
    const Vec3 wi = to_float(sample_wide(s.o, v.y, {phi.sin, phi.cos}));
    if (!(wi.z > 0)) return {};
    return wi;
}

Color PrincipledBsdf::reflectance() const
{
    const PrincipledTables& tables = *material->tables;
    const float through = tables.mean_through, of_coat = coat * (1 - tables.coat_mean_through);
    const Color opaque = specular * (1 - through) + base * through;
    Color below = opaque * body + transmittance * clear;
    if (metallic > 0) below += base * (metallic * specular_weight);
    if (coat > 0) below = below * mix(white, material->coat_color, coat) * (1 - of_coat) + white * of_coat;
    if (!(fuzz > 0)) return below;
    const float covered = fuzz * fuzz_row.albedo(0.5f);
    return mix(below, fuzz_color, covered);
}

}  // namespace lancer
