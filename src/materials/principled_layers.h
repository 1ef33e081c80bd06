// What the layers of a principled material (materials/principled.h) do to light above its surface, for one point and
// for several with the same bits: fuzz, a coat, the facets of metal and of a dielectric under a film, a diffuse body.
// What goes through the surface is left to PrincipledBsdf and PrincipledQueue.
#pragma once

#include "materials/anisotropic.h"
#include "materials/bsdf.h"
#include "materials/microfacet.h"
#include "materials/principled_numbers.h"

namespace lancer {

template <class T>
struct PrincipledLayers : PrincipledNumbers<T>, PrincipledExtras<T>, PrincipledRows<T> {
    using Number = T;
    using Double = decltype(to_double(T{}));
    using Spectrum = SpectrumOf<T>;
    using N = PrincipledNumbers<T>;
    using E = PrincipledExtras<T>;
    using R = PrincipledRows<T>;

    // Data that depends on wo only.
    struct Seen {
        Vec3T<T> wo;
        Vec3T<Double> o;        // unit
        T over{};               // factor of what the coat reflects
        Spectrum under_coat{};  // of all below, with that of the fuzz
        Spectrum through{};     // of the dielectric's reflection: 1 - E
        T lost{};               // of the metal's facets
        T diffuse_chance{}, coat_chance{}, facet_chance{}, glass_chance{};
    };

    static T one() { return T{} + 1.0f; }
    static Spectrum grey(T x) { return {x, x, x}; }
    static Spectrum complement(const Spectrum& c) { return grey(one()) - c; }
    static FresnelT<T> fresnel(T cos, T eta)
    {
        const Double c = to_double(smaller(one(), cos));
        const FresnelT<Double> f = fresnel_dielectric_double(c, (1.0 - c) * (1.0 + c), to_double(eta));
        return {to_float(f.reflectance), to_float(f.cos_t)};
    }
    // Schlick's reflectance with a tint where it is least: F82-tint of Kutz, Hasan and Edmondson, "Novel Aspects of the
    // Adobe Standard Material", 2021. White is Schlick's own.
    Spectrum bare_metal(T cos) const
    {
        const T c = smaller(one(), larger(T{}, cos)), m = 1.0f - c, w = schlick_weight(m), m2 = m * m;
        const Spectrum tinted = N::base * (1.0f - w) + grey(w) - N::edge * (c * m2 * m2 * m2);
        return each(tinted, [](T x) { return larger(T{}, x); });
    }
    [[gnu::always_inline]] Spectrum metal_reflectance(T cos) const
    {
        const Spectrum bare = bare_metal(cos);
        return (kinds.film ? metal_under_film(cos, bare) : bare) * N::specular_weight;
    }
    // Without the tint.
    Spectrum dielectric_reflectance(T cos) const
    {
        const Spectrum bare = grey(fresnel(cos, N::dielectric_ior).reflectance);
        return kinds.film ? dielectric_under_film(cos, bare) : bare;
    }
    // The same, of all facets together, which lose a part.
    Spectrum dielectric_albedo(T cos, T lost) const
    {
        const Spectrum bare = grey(facet_albedo(cos, lost));
        return kinds.film ? albedo_under_film(cos, bare) : bare;
    }
    T facet_albedo(T cos, T lost) const
    {
        const T smooth = fresnel(cos, N::dielectric_ior).reflectance;
        return whole_of_coat(smooth, N::dielectric_ior, N::facet_alpha) * (1.0f - lost);
    }
    T fuzz_albedo(T cos) const { return albedo_of(R::fuzz_row, cos); }
    T fuzz_value(const Vec3T<T>& wo, const Vec3T<T>& wi) const { return FuzzT<T>{E::fuzz_roughness}.eval(wo, wi); }
    // What the coat's colour leaves of the light that crosses it twice. cos: below the boundary.
    Spectrum tint_of_coat(T cos) const
    {
        if (!kinds.tint) return grey(one());
        const T length = 1.0f / cos;
        return each(E::coat_color,
                    [&](T c) { return select(cos > 0.0f, mix(one(), power(c, length), N::coat), one()); });
    }
    // unit: w in double. A point has a row of one of both tables.
    T dielectric_loss(const Vec3T<T>& w, const Vec3T<Double>& unit) const
    {
        const T even = loss_of(dielectric_row, w.z);
        return kinds.wide ? even + wide_loss(R::wide_dielectric, unit) : even;
    }
    T metal_loss(const Vec3T<T>& w, const Vec3T<Double>& unit) const
    {
        const T even = loss_of(metal_row, w.z);
        return kinds.wide ? even + wide_loss(R::wide_metal, unit) : even;
    }
    FacetReflectionT<Double> facets(const Vec3T<Double>& o, const Vec3T<Double>& i) const
    {
        if (kinds.wide) return eval_wide(o, i);
        return eval_facets(GgxT<Double>{to_double(N::facet_alpha)}, o, i);
    }
    // Without what is above. Plastic's formula, which lets light travel both ways.
    Spectrum diffuse(const Seen& s, const Vec3T<T>& wi, const Vec3T<Double>& i) const
    {
        const T back = through_back(wi.z, dielectric_loss(wi, i));
        if (kinds.film || kinds.rough_body) return diffuse_not_even(s, wi, back);
        return diffuse_below(s.through * back, wi);
    }
    T through_back(T cos, T lost) const { return (1.0f - facet_albedo(cos, lost)) / N::mean_through; }
    Spectrum diffuse_below(const Spectrum& through, const Vec3T<T>& wi) const
    {
        return product(N::base, through) * (N::body * pdf_cosine_hemisphere(wi.z));
    }
    // The same where some point has a film, anisotropic facets or a rough body. bare: without the film.
    Spectrum metal_under_film(T cos, const Spectrum& bare) const;
    Spectrum dielectric_under_film(T cos, const Spectrum& bare) const;
    Spectrum albedo_under_film(T cos, const Spectrum& bare) const;
    T wide_loss(const RowsOf<T, AnisotropicTable::At>& rows, const Vec3T<Double>& unit) const;
    FacetReflectionT<Double> eval_wide(const Vec3T<Double>& o, const Vec3T<Double>& i) const;
    // Towards a film or a rough body, whose value is not even, what is let through counts as seen from wo alone, so
    // that no light is lost. back: what counts elsewhere.
    Spectrum diffuse_not_even(const Seen& s, const Vec3T<T>& wi, T back) const;
    // A direction to which anisotropic facets reflect; it may lie below the surface. v, phi: as of
    // StretchedGgxT::sample_visible().
    Vec3T<Double> sample_wide(const Vec3T<Double>& o, Double v, const SinCosT<Double>& phi) const;
    // What the chance of what is clear is in proportion to. below: factor of it.
    T glass_chance(T below) const
    {
        if (!kinds.clear) return T{};
        return below * E::clear * larger(largest(N::specular), largest(E::transmittance));
    }

    RowsOf<T, AlbedoTable::Row> coat_row{}, dielectric_row{}, metal_row{};
    PrincipledKinds kinds{};
};

// B: PrincipledBsdf, or PrincipledLayers of several points.

// The fuzz and the coat: what they reflect, and what is left of the light that goes through them and comes back.
template <class B, class T = typename B::Number>
void see_layers(const B& b, typename B::Seen& s)
{
    T under_fuzz = B::one();
    if (any_lane(b.fuzz > 0.0f)) {
        const T albedo = b.fuzz * b.fuzz_albedo(s.wo.z);
        under_fuzz = 1.0f - albedo;
        s.diffuse_chance = albedo * largest(b.fuzz_color);
    }
    s.under_coat = B::grey(under_fuzz);
    if (!any_lane(b.coat > 0.0f)) return;
    const FresnelT<T> fresnel = B::fresnel(s.wo.z, b.coat_ior);
    const T whole = whole_of_coat(fresnel.reflectance, b.coat_ior, b.coat_alpha);
    const T albedo = whole * (1.0f - loss_of(b.coat_row, s.wo.z));
    s.over = under_fuzz * b.coat;
    s.coat_chance = s.over * albedo;
    s.under_coat = product(B::grey(under_fuzz * (1.0f - b.coat * albedo)), b.tint_of_coat(fresnel.cos_t));
    const auto darkens = b.coat_darkening > 0.0f;
    if (!any_lane(darkens)) return;
    // Light that the base sends is partly sent back by the coat, and meets the base again (OpenPBR, "coat darkening").
    const T returned = mix(fresnel.reflectance, b.coat_even, b.blur);
    const auto darkened = [&](T color) {
        const T body = color * b.mean_through + (1.0f - b.mean_through);
        const T albedo_below = b.metallic * color + b.body * body + b.clear;
        const T once = (1.0f - returned) / (1.0f - smaller(B::one(), albedo_below) * returned);
        return select(darkens, mix(B::one(), once, b.coat_darkening), B::one());
    };
    s.under_coat = product(s.under_coat, each(b.base, darkened));
}

// s.wo and s.o are set; wo.z > 0.
template <class B, class T = typename B::Number>
void see(const B& b, typename B::Seen& s)
{
    const T cos = s.wo.z;
    const bool has_metal = any_lane(b.metallic > 0.0f), has_other = any_lane(b.metallic < 1.0f);
    see_layers(b, s);
    s.through = B::grey(B::one());
    if (has_other) s.through = B::complement(b.dielectric_albedo(cos, b.dielectric_loss(s.wo, s.o)));
    const T below = largest(s.under_coat);
    if (has_metal) {
        s.lost = b.metal_loss(s.wo, s.o);
        s.facet_chance += below * b.metallic * largest(b.metal_reflectance(cos)) * (1.0f - s.lost);
        s.diffuse_chance += below * b.metallic * largest(b.further) * s.lost;
    }
    if (has_other) {
        s.facet_chance += below * b.body * largest(product(b.specular, B::complement(s.through)));
        s.diffuse_chance += below * b.body * largest(product(b.base, s.through));
    }
    s.glass_chance = b.glass_chance(below);
    const T sum = s.diffuse_chance + s.coat_chance + s.facet_chance + s.glass_chance;
    const T scale = select(sum > 0.0f, sum, B::one());
    for (T* chance : {&s.diffuse_chance, &s.coat_chance, &s.facet_chance, &s.glass_chance}) *chance = *chance / scale;
}

// Above the surface, without delta lobes. wi.z > 0; i: wi in double, unit.
template <class B, class T = typename B::Number>
BsdfValueT<typename B::Spectrum, T> eval_above(const B& b, const typename B::Seen& s, const Vec3T<T>& wi,
                                               const Vec3T<typename B::Double>& i)
{
    BsdfValueT<typename B::Spectrum, T> f{{}, s.diffuse_chance * pdf_cosine_hemisphere(wi.z)};
    if (any_lane(b.fuzz > 0.0f)) f.f_cos += b.fuzz_color * (b.fuzz_scale * b.fuzz_value(s.wo, wi) * wi.z);
    if (const auto is_coated = b.coat_alpha > 0.0f; any_lane(is_coated)) {
        const auto facets = eval_facets(GgxT<typename B::Double>{to_double(b.coat_alpha)}, s.o, i);
        const T value = s.over * B::fresnel(to_float(facets.cos_h), b.coat_ior).reflectance * to_float(facets.f_cos);
        f.f_cos += B::grey(select(is_coated, value, T{}));
        f.pdf += select(is_coated, s.coat_chance * to_float(facets.pdf), T{});
    }
    typename B::Spectrum below{};
    const bool has_metal = any_lane(b.metallic > 0.0f), has_body = any_lane(b.body > 0.0f);
    if (const auto is_rough = b.facet_alpha > 0.0f; any_lane(is_rough) && (has_metal || has_body)) {
        const auto facets = b.facets(s.o, i);
        const T cos = to_float(facets.cos_h);
        typename B::Spectrum r{};
        if (has_metal) r += b.metal_reflectance(cos) * b.metallic;
        if (has_body) r += product(b.specular, b.dielectric_reflectance(cos)) * b.body;
        below += r * select(is_rough, to_float(facets.f_cos), T{});
        f.pdf += select(is_rough, s.facet_chance * to_float(facets.pdf), T{});
        if (const auto loses = b.mean_lost > 0.0f; any_lane(loses)) {
            const T even = b.metallic * s.lost * b.metal_loss(wi, i) / b.mean_lost * pdf_cosine_hemisphere(wi.z);
            below += b.further * select(loses, even, T{});
        }
    }
    if (has_body) below += b.diffuse(s, wi, i);
    f.f_cos += product(s.under_coat, below);
    return f;
}

// What is reflected as by a mirror, and its chance.
template <class B, class T = typename B::Number>
BsdfValueT<typename B::Spectrum, T> mirrored_by(const B& b, const typename B::Seen& s)
{
    BsdfValueT<typename B::Spectrum, T> f{};
    if (const auto is_smooth = (b.coat > 0.0f) & (b.coat_alpha == 0.0f); any_lane(is_smooth)) {
        f.f_cos += B::grey(select(is_smooth, s.over * B::fresnel(s.wo.z, b.coat_ior).reflectance, T{}));
        f.pdf += select(is_smooth, s.coat_chance, T{});
    }
    if (const auto is_smooth = b.facet_alpha == 0.0f; any_lane(is_smooth)) {
        auto r = product(b.specular, B::complement(s.through)) * b.body;
        if (any_lane(b.metallic > 0.0f)) r += b.metal_reflectance(s.wo.z) * b.metallic;
        f.f_cos += product(s.under_coat, r) * select(is_smooth, B::one(), T{});
        f.pdf += select(is_smooth, s.facet_chance, T{});
    }
    return f;
}

}  // namespace lancer
