// What few principled points have: a film, anisotropic facets, a rough body. Functions of their own, so that the others
// stay short.
#include "materials/principled_layers.h"

#include "materials/rough_diffuse.h"
#include "materials/thin_film.h"

namespace lancer {
namespace {

template <class T>
ThinFilmT<T> film_of(const PrincipledExtras<T>& p)
{
    return {p.film_ior, p.film_thickness};
}
template <class T>
auto wide_facets_of(const PrincipledLayers<T>& p)
{
    return StretchedGgxT<decltype(to_double(T{}))>{to_double(p.facet_alpha), to_double(p.across)};
}
// w turned about z.
template <class D>
Vec3T<D> turned(const Vec3T<D>& w, D cos, D sin)
{
    return {cos * w.x - sin * w.y, sin * w.x + cos * w.y, w.z};
}
// From local directions to a frame whose x is the tangent, and back.
template <class T, class D>
Vec3T<D> to_tangent(const PrincipledExtras<T>& p, const Vec3T<D>& w)
{
    return turned(w, to_double(p.turn_cos), -to_double(p.turn_sin));
}
template <class T, class D>
Vec3T<D> from_tangent(const PrincipledExtras<T>& p, const Vec3T<D>& w)
{
    return turned(w, to_double(p.turn_cos), to_double(p.turn_sin));
}

Color albedo_by_table(const PrincipledLayers<float>& p, float cos, bool)
{
    return p.film_table->albedo(cos, p.film_roughness, p.film_thickness);
}
// Of the lanes of a mask.
Vec3T<Float4> albedo_by_table(const PrincipledLayers<Float4>& p, Float4 cos, Mask4f mask)
{
    Vec3T<Float4> albedo{};
    for_each_lane(movemask(mask), [&](uint32_t i) {
        const Color c = p.film_table[i]->albedo(cos[i], p.film_roughness[i], p.film_thickness[i]);
        set_lane(albedo, i, c);
    });
    return albedo;
}

}  // namespace

template <class T>
SpectrumOf<T> PrincipledLayers<T>::metal_under_film(T cos, const Spectrum& bare) const
{
    return mix(bare, film_of<T>(*this).on_metal(cos, bare), E::film);
}

template <class T>
SpectrumOf<T> PrincipledLayers<T>::dielectric_under_film(T cos, const Spectrum& bare) const
{
    return mix(bare, film_of<T>(*this).on_dielectric(cos, N::dielectric_ior), E::film);
}

template <class T>
SpectrumOf<T> PrincipledLayers<T>::albedo_under_film(T cos, const Spectrum& bare) const
{
    const auto is_rough = N::facet_alpha > 0.0f;
    const auto by_table = is_rough & (E::film > 0.0f) & (N::metallic < 1.0f);
    Spectrum covered{};
    if (any_lane(by_table)) covered = albedo_by_table(*this, cos, by_table);
    if (any_lane(N::facet_alpha == 0.0f))
        covered = select(is_rough, covered, film_of<T>(*this).on_dielectric(cos, N::dielectric_ior));
    return mix(bare, covered, E::film);
}

template <class T>
T PrincipledLayers<T>::wide_loss(const RowsOf<T, AnisotropicTable::At>& rows, const Vec3T<Double>& unit) const
{
    return loss_of(rows, to_float(to_tangent<T>(*this, unit)));
}

template <class T>
auto PrincipledLayers<T>::eval_wide(const Vec3T<Double>& o, const Vec3T<Double>& i) const -> FacetReflectionT<Double>
{
    const FacetReflectionT<Double> f =
        eval_stretched(wide_facets_of<T>(*this), to_tangent<T>(*this, o), to_tangent<T>(*this, i));
    const auto is_even = to_double(E::across) == 0.0;
    if (!any_lane(is_even)) return f;
    const FacetReflectionT<Double> even = eval_facets(GgxT<Double>{to_double(N::facet_alpha)}, o, i);
    return {select(is_even, even.f_cos, f.f_cos), select(is_even, even.pdf, f.pdf),
            select(is_even, even.cos_h, f.cos_h)};
}

template <class T>
auto PrincipledLayers<T>::sample_wide(const Vec3T<Double>& o, Double v, const SinCosT<Double>& phi) const
    -> Vec3T<Double>
{
    const Vec3T<Double> from = to_tangent<T>(*this, o);
    return from_tangent<T>(*this, mirrored(from, wide_facets_of<T>(*this).sample_visible(from, v, phi)));
}

template <class T>
SpectrumOf<T> PrincipledLayers<T>::diffuse_not_even(const Seen& s, const Vec3T<T>& wi, T back) const
{
    const T both_ways = (1.0f - E::diffuse_roughness) * (1.0f - E::film);
    const Spectrum through = s.through * select(both_ways < 1.0f, mix(one(), back, both_ways), back);
    const Spectrum even = diffuse_below(through, wi);
    if (!kinds.rough_body) return even;
    const Spectrum f = RoughDiffuseT<T>(E::diffuse_roughness).eval(N::base, s.wo, wi);
    return select(E::diffuse_roughness > 0.0f, product(f, through) * (N::body * wi.z), even);
}

template struct PrincipledLayers<float>;
template struct PrincipledLayers<Float4>;

}  // namespace lancer
