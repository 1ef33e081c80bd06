// What the layers of a principled material (materials/principled.h) do to light above its surface, for one point and
// for several with the same bits: fuzz, a coat, the facets of metal and of a dielectric, a diffuse body. A film,
// anisotropic facets, a rough body and what goes through the surface are left to PrincipledBsdf, whose members hide
// those of PrincipledLayers.
#pragma once

#include <type_traits>

#include "materials/albedo_table.h"
#include "materials/bsdf.h"
#include "materials/microfacet.h"

namespace lancer {

template <class T>
using SpectrumOf = std::conditional_t<std::is_same_v<T, float>, Color, Vec3T<T>>;

inline Color product(Color a, Color b) { return a * b; }
inline Vec3T<Float4> product(const Vec3T<Float4>& a, const Vec3T<Float4>& b)
{
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline float largest(Color c) { return max_component(c); }
inline Float4 largest(const Vec3T<Float4>& c) { return larger(c.x, larger(c.y, c.z)); }
inline Float4 mix(Float4 a, Float4 b, Float4 t) { return a + (b - a) * t; }
template <class Spectrum, class F>
Spectrum each(const Spectrum& color, const F& f)
{
    const auto& [r, g, b] = color;
    return {f(r), f(g), f(b)};
}
template <class Mask>
bool any_lane(Mask m)
{
    return movemask(m) != 0;
}

// What is the same for all directions. T: float or a vector of them.
template <class T>
struct PrincipledNumbers {
    SpectrumOf<T> base{}, fuzz_color{};
    T metallic{}, coat{}, coat_alpha{}, fuzz{};
    // The following by PrincipledBsdf::finish().
    SpectrumOf<T> specular{}, edge{};  // edge: what the tint takes from Schlick's reflectance, at its most
    SpectrumOf<T> further{};           // of the metal: the light of multiple scattering over that lost
    T body{};                          // part with a diffuse body
    T facet_alpha{}, specular_weight{}, dielectric_ior{};
    T mean_through{}, mean_lost{};      // of the dielectric's reflection: 1 - its mean; of the metal's facets
    T coat_ior{}, coat_even{}, blur{};  // for the coat's darkening: see there
    T coat_darkening{}, fuzz_scale{};   // with the part that is covered; fuzz_scale: of Fuzz::eval()
};

template <class T>
struct PrincipledLayers : PrincipledNumbers<T> {
    using Number = T;
    using Double = decltype(to_double(T{}));
    using Spectrum = SpectrumOf<T>;
    using Row = std::conditional_t<std::is_same_v<T, float>, AlbedoTable::Row, std::array<AlbedoTable::Row, 4>>;
    using N = PrincipledNumbers<T>;

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
    Spectrum metal_reflectance(T cos) const { return bare_metal(cos) * N::specular_weight; }
    // Without the tint.
    Spectrum dielectric_reflectance(T cos) const { return grey(fresnel(cos, N::dielectric_ior).reflectance); }
    // The same, of all facets together, which lose a part.
    Spectrum dielectric_albedo(T cos, T lost) const { return grey(facet_albedo(cos, lost)); }
    T facet_albedo(T cos, T lost) const
    {
        const T smooth = fresnel(cos, N::dielectric_ior).reflectance;
        return whole_of_coat(smooth, N::dielectric_ior, N::facet_alpha) * (1.0f - lost);
    }
    // unit: w in double.
    T dielectric_loss(const Vec3T<T>& w, const Vec3T<Double>&) const { return loss_of(dielectric_row, w.z); }
    T metal_loss(const Vec3T<T>& w, const Vec3T<Double>&) const { return loss_of(metal_row, w.z); }
    FacetReflectionT<Double> facets(const Vec3T<Double>& o, const Vec3T<Double>& i) const
    {
        return eval_facets(GgxT<Double>{to_double(N::facet_alpha)}, o, i);
    }
    // Without what is above. Plastic's formula, which lets light travel both ways.
    Spectrum diffuse(const Seen& s, const Vec3T<T>& wi, const Vec3T<Double>& i) const
    {
        return diffuse_below(s.through * through_back(wi.z, dielectric_loss(wi, i)), wi);
    }
    T through_back(T cos, T lost) const { return (1.0f - facet_albedo(cos, lost)) / N::mean_through; }
    Spectrum diffuse_below(const Spectrum& through, const Vec3T<T>& wi) const
    {
        return product(N::base, through) * (N::body * pdf_cosine_hemisphere(wi.z));
    }
    // What goes through the surface, and what its chance is in proportion to. below: factor of it.
    T part_of_glass() const { return T{}; }
    T glass_chance(T) const { return T{}; }

    Row coat_row{}, dielectric_row{}, metal_row{};
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
        const T albedo_below = b.metallic * color + b.body * body + b.part_of_glass();
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
