// Isotropic GGX microfacets: normal distribution and Smith's height-correlated masking and shadowing (Walter et al.
// 2007; Heitz, "Understanding the Masking-Shadowing Function", JCGT 3(2), 2014), with sampling of visible normals
// (Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps", 2023). In double with directions normalised
// in double, as a lobe of alpha 1e-5 is a few float steps wide. For one point and for several with the same bits.
#pragma once

#include <optional>

#include "core/warp.h"
#include "materials/bsdf.h"

namespace lancer {

// Surfaces with a smaller alpha are treated as perfectly smooth: float directions cannot resolve a narrower lobe.
inline constexpr float least_alpha = 1e-5f;

// roughness: perceptual, clamped to [0, 1], NaN to 0. 0: perfectly smooth.
inline float alpha_of_roughness(float roughness)
{
    const float r = std::min(1.0f, std::max(0.0f, roughness)), alpha = r * r;
    return alpha < least_alpha ? 0 : alpha;
}

// For the classic integrators: the part of the reflection that is a highlight, and the exponent of a highlight of about
// the same width (Walter et al., section 5.2). Both 0 for a mirror.
inline float highlight_of(float roughness) { return alpha_of_roughness(roughness) > 0 ? std::min(1.0f, roughness) : 0; }
inline float shininess_of(float roughness)
{
    const float alpha = alpha_of_roughness(roughness);
    return alpha > 0 ? 2 / (alpha * alpha) - 2 : 0;
}

template <class T>
inline auto unit_in_double(const Vec3T<T>& w)
{
    return normalize(to_double(w));
}

// wi mirrored about h, both unit.
template <class D>
inline Vec3T<D> mirrored(const Vec3T<D>& w, const Vec3T<D>& h)
{
    return h * (2.0 * dot(w, h)) - w;
}

// w refracted by a boundary of normal h, both unit. cos: dot(w, h); cos_t: the cosine beyond; eta: index beyond over
// index on w's side.
template <class D, class Eta>
inline Vec3T<D> refracted(const Vec3T<D>& w, const Vec3T<D>& h, D cos, D cos_t, Eta eta)
{
    return h * (cos / eta - cos_t) - w / (D{} + eta);
}

// All directions in double, unit, z > 0 unless stated otherwise. D: double or a vector of them.
template <class D>
struct GgxT {
    D alpha;  // > 0

    // Normal distribution per area and solid angle. h: any length, any sign. From x and y, since 1 - z^2 cancels.
    D density(const Vec3T<D>& h) const
    {
        const D s2 = h.x * h.x + h.y * h.y, z2 = h.z * h.z, length2 = s2 + z2;
        const D r = length2 / (s2 / (alpha * alpha) + z2);
        return r * r / (pi_d * alpha * alpha);
    }
    // sqrt(cos^2 + alpha^2 sin^2), which is cos (1 + 2 Lambda). For any z.
    D spread(const Vec3T<D>& w) const { return sqrt(w.z * w.z + alpha * alpha * (w.x * w.x + w.y * w.y)); }
    // Smith's Lambda: ratio of masked to visible facet area from w.
    D lambda(const Vec3T<D>& w) const
    {
        const D a = alpha * alpha * (w.x * w.x + w.y * w.y), cos = abs(w.z);
        return 0.5 * a / (cos * (cos + sqrt(w.z * w.z + a)));
    }
    // Part of the light that other facets stop on its way to wi: 1 - G2 / G1 without cancellation; all that goes below
    // the surface. hidden_o: lambda(wo).
    D stopped(std::type_identity_t<D> hidden_o, const Vec3T<D>& wi) const
    {
        const D hidden_i = lambda(wi);
        return hidden_i / (1.0 + hidden_o + hidden_i);
    }
    // G2 / (4 |cos_o| |cos_i|), with the joint masking-shadowing function G2. For any z except both 0.
    D visibility(const Vec3T<D>& wo, const Vec3T<D>& wi) const
    {
        return 0.5 / (abs(wo.z) * spread(wi) + abs(wi.z) * spread(wo));
    }
    // Samples a visible normal of wo: unit, z > 0, dot(wo, h) > 0. v: in [0, 1); phi: sin_cos_2pi() of another such
    // number.
    Vec3T<D> sample_visible(const Vec3T<D>& wo, D v, const SinCosT<D>& phi) const
    {
        const Vec3T<D> w = normalize(Vec3T<D>{alpha * wo.x, alpha * wo.y, wo.z});
        // A point on the cap of the unit sphere above -w.z; z - 1 is exact where it is small.
        const D below = v * (1.0 + w.z);
        const D r = sqrt(larger(D{}, below * (2.0 - below)));
        const Vec3T<D> h{r * phi.cos + w.x, r * phi.sin + w.y, 1.0 - below + w.z};
        return normalize(Vec3T<D>{alpha * h.x, alpha * h.y, h.z});
    }
    Vec3T<D> sample_visible(const Vec3T<D>& wo, Vec2 v) const
    {
        const SinCos phi = sin_cos_2pi(v.x);
        return sample_visible(wo, v.y, {phi.sin, phi.cos});
    }
};
using Ggx = GgxT<double>;

// Reflection by facets of reflectance 1, and the cosine at the facet that reflects wo to wi.
template <class D>
struct FacetReflectionT {
    D f_cos, pdf, cos_h;
};
using FacetReflection = FacetReflectionT<double>;

// Unit, z > 0. Inlined, as a call would pass registers of four through memory.
template <class D>
[[gnu::always_inline]] inline FacetReflectionT<D> eval_facets(const GgxT<D>& ggx, const Vec3T<D>& wo,
                                                              const Vec3T<D>& wi)
{
    const Vec3T<D> sum = wo + wi;
    const D d = ggx.density(sum);
    return {.f_cos = d * ggx.visibility(wo, wi) * wi.z,
            .pdf = 0.5 * d / (wo.z + ggx.spread(wo)),
            .cos_h = smaller(D{} + 1.0, 0.5 * length(sum))};
}

// Samples a direction; nothing if it lies below the surface. wo: unit, z > 0.
inline std::optional<Vec3> sample_facets(const Ggx& ggx, Vec3d wo, Vec2 v)
{
    const Vec3 wi = to_float(mirrored(wo, ggx.sample_visible(wo, v)));
    if (!(wi.z > 0)) return {};
    return wi;
}

}  // namespace lancer
