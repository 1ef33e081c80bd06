// Rough glass, for one point and for several with the same bits: reflection and refraction by GGX microfacets, Walter
// et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, and the even lobes of glass_losses.h.
// G: GlassBsdf, or RoughGlass4. Directions in double are unit.
#pragma once

#include "materials/fresnel.h"
#include "materials/glass_losses.h"
#include "materials/microfacet.h"

namespace lancer {

// What GlassBsdf has of a rough boundary, of four points.
struct RoughGlass4 {
    Vec3T<Float4> tint{};
    Double4 eta{};
    Float4 alpha{};
    GlassLobesT<Float4> multiple{};

    template <class G>
    void set(size_t i, const G& g)
    {
        set_lane(tint, i, g.tint);
        eta[i] = g.eta, alpha[i] = g.alpha;
        const GlassLobes& m = g.multiple;
        multiple.here.set(i, m.here), multiple.beyond.set(i, m.beyond);
        set_lane(multiple.color, i, m.color);
        multiple.reflected[i] = m.reflected, multiple.transmitted[i] = m.transmitted;
        multiple.part_through[i] = m.part_through;
    }
};

template <class G>
auto facet_fresnel(const G& g, decltype(G::eta) cos)
{
    return fresnel_dielectric_double(cos, (1.0 - cos) * (1.0 + cos), g.eta);
}

// Of single scattering.
template <class G, class T = decltype(G::alpha), class D = decltype(G::eta)>
BsdfValueT<SpectrumOf<T>, T> eval_facets_of_glass(const G& g, const Vec3T<D>& wo, const Vec3T<D>& wi)
{
    const GgxT<D> ggx{to_double(g.alpha)};
    const auto is_behind = wi.z < 0.0;
    D f_cos{}, pdf{};
    if (any_lane(wi.z > 0.0)) {
        const FacetReflectionT<D> facets = eval_facets(ggx, wo, wi);
        const D reflected = facet_fresnel(g, facets.cos_h).reflectance;
        f_cos = reflected * facets.f_cos, pdf = reflected * facets.pdf;
    }
    if (any_lane(is_behind)) {
        // Normal of the facet that refracts wo to wi: along wo + eta wi, on wo's side of the surface.
        const D n = g.eta;
        const Vec3T<D> sum = wo + n * wi;
        const D length2 = dot(sum, sum), scale = copysign(1.0 / sqrt(length2), sum.z);
        const D cos_o = scale * dot(wo, sum), cos_i = scale * dot(wi, sum);
        const auto is_turned = (cos_o > 0.0) & (cos_i < 0.0);
        // Jacobian: solid angle of normals over that of wi. length2 is the squared sum in Walter et al.
        const D jacobian = -cos_i * n * n / length2;
        const D through =
            (1.0 - facet_fresnel(g, smaller(D{} + 1.0, cos_o)).reflectance) * ggx.density(sum) * cos_o * jacobian;
        const D value = 4.0 * through * ggx.visibility(wo, wi) * -wi.z / (n * n);
        f_cos = select(is_behind, select(is_turned, value, D{}), f_cos);
        pdf = select(is_behind, select(is_turned, 2.0 * through / (wo.z + ggx.spread(wo)), D{}), pdf);
    }
    return {g.tint * to_float(f_cos), to_float(pdf)};
}

// The chance of the even lobes. lost: by single scattering.
template <class G, class T = decltype(G::alpha)>
T chance_of_multiple(const G& g, T lost)
{
    return chance_of_even_lobe(lost, largest(g.multiple.color), largest(g.tint));
}

// Adds the light of all further orders to that of single scattering. z: that of wi; cos_o, cos_i: in double, rounded.
template <class G, class T = decltype(G::alpha)>
void add_multiple(const G& g, T cos_o, T z, T cos_i, BsdfValueT<SpectrumOf<T>, T>& f)
{
    const GlassLobesT<T>& m = g.multiple;
    const T lost = m.here.loss(cos_o), p = chance_of_multiple(g, lost);
    const auto is_behind = z<0.0f, is_before = z> 0.0f;
    T lobe{}, pdf{};
    if (any_lane(is_behind)) {
        lobe = m.transmitted * (lost * m.beyond.loss(cos_i));
        pdf = m.part_through * m.beyond.pdf(cos_i);
    }
    if (any_lane(is_before)) {
        lobe = select(is_behind, lobe, m.reflected * (lost * m.here.loss(cos_i)));
        pdf = select(is_behind, pdf, (1.0f - m.part_through) * m.here.pdf(cos_i));
    }
    f.f_cos += m.color * (lobe * cos_i * (1 / pi));
    f.pdf += p * (pdf - f.pdf);
}

// Both, of a rough boundary.
template <class G, class T = decltype(G::alpha), class D = decltype(G::eta)>
BsdfValueT<SpectrumOf<T>, T> eval_rough_glass(const G& g, const Vec3T<D>& wo, const Vec3T<T>& w)
{
    const Vec3T<D> wi = unit_in_double(w);
    auto f = eval_facets_of_glass(g, wo, wi);
    if (g.multiple) add_multiple(g, to_float(wo.z), w.z, to_float(abs(wi.z)), f);
    return f;
}

// A direction, where it is found.
template <class T, class Mask>
struct SentByGlass {
    Vec3T<T> wi;
    Mask found;
};
// Samples a direction of single scattering. u selects reflection or refraction; v, phi: as of GgxT::sample_visible().
template <class G, class T = decltype(G::alpha), class D = decltype(G::eta)>
auto sample_facets_of_glass(const G& g, const Vec3T<D>& wo, T u, D v, const SinCosT<D>& phi)
{
    const Vec3T<D> h = GgxT<D>{to_double(g.alpha)}.sample_visible(wo, v, phi);
    const D cos_o = smaller(D{} + 1.0, dot(wo, h));
    const FresnelT<D> f = facet_fresnel(g, cos_o);
    const auto is_through = u >= to_float(f.reflectance);
    const Vec3T<T> wi =
        select(is_through, to_float(refracted(wo, h, cos_o, f.cos_t, g.eta)), to_float(mirrored(wo, h)));
    auto found = (wi.z != 0.0f) & ((wi.z < 0.0f) == is_through);
    return SentByGlass<T, decltype(found)>{wi, found};
}

// A direction of multiple scattering. u selects the side.
inline std::optional<Vec3> sample_multiple(const GlassLobes& m, float u, Vec2 v)
{
    const bool through = u < m.part_through;
    Vec3 wi = direction_at((through ? m.beyond : m.here).sample_cos(v.x), v.y);
    if (through) wi.z = -wi.z;
    if (wi.z == 0) return {};
    return wi;
}
// What is left of u where single scattering was chosen. p: the chance of multiple scattering.
template <class T>
T left_of_choice(T u, T p)
{
    return smaller((u - p) / (1.0f - p), T{} + (1 - 0x1p-24f));
}

// A direction of either, of lanes in the mask. cos_o: that of wo as stored; v_x, v_y: of GgxT::sample_visible().
inline SentByGlass<Float4, Mask4f> sample_rough_glass(const RoughGlass4& g, const Vec3T<Double4>& wo, Float4 cos_o,
                                                      Float4 u, Float4 v_x, Float4 v_y, const SinCosT<Double4>& phi,
                                                      Mask4f mask)
{
    Float4 p{}, single = u;
    if (g.multiple) {
        p = chance_of_multiple(g, g.multiple.here.loss(cos_o));
        single = select(g.multiple.here.mean() > 0.0f, left_of_choice(u, p), u);
    }
    auto sent = sample_facets_of_glass(g, wo, single, to_double(v_y), phi);
    for_each_lane(movemask(mask & (u < p)), [&](uint32_t i) {
        const auto wi = sample_multiple(g.multiple.of(i), u[i] / p[i], {v_x[i], v_y[i]});
        sent.found[i] = wi ? -1 : 0;
        if (wi) sent.wi.x[i] = wi->x, sent.wi.y[i] = wi->y, sent.wi.z[i] = wi->z;
    });
    return sent;
}

}  // namespace lancer
