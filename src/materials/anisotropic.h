// GGX microfacets that are wider along one tangent than along the other: those of microfacet.h with directions
// stretched by two alphas. Heitz, "Understanding the Masking-Shadowing Function", JCGT 3(2), 2014, section 5.4. For an
// equal pair the formulas are those of the isotropic facets.
#pragma once

#include <algorithm>

#include "materials/microfacet.h"

namespace lancer {

// Alphas along the tangent and across it. aspect: the second over the first.
struct AlphaPair {
    float along = 0, across = 0;

    bool is_even() const { return along == across; }
    // That of the slopes towards w: what masks and shadows there. w: z is not asked.
    float towards(float x, float y) const
    {
        const float x2 = x * x, y2 = y * y, sum = x2 + y2;
        if (is_even() || !(sum > 0)) return is_even() ? along : mean();
        return std::sqrt((along * along * x2 + across * across * y2) / sum);
    }
    float mean() const { return std::sqrt(along * across); }
};

// As OpenPBR Surface 1.1 defines them: the mean of their squares is the squared alpha of the roughness. anisotropy: in
// [0, 1]; the narrower alpha is 1 - anisotropy times the wider one. 0 where the surface is smooth.
inline AlphaPair alphas_of(float roughness, float anisotropy)
{
    const float alpha = alpha_of_roughness(roughness);
    if (anisotropy == 0 || alpha == 0) return {alpha, alpha};
    const float aspect = 1 - std::min(1.0f, std::max(0.0f, anisotropy));
    const float along = std::min(1.0f, alpha * std::sqrt(2 / (1 + aspect * aspect)));
    return {along, std::max(least_alpha, along * aspect)};
}

// All directions in double, unit, z > 0 unless stated otherwise; x is along the tangent. D: double or a vector of them.
template <class D>
struct StretchedGgxT {
    D along, across;

    // Of normals; h need not be unit.
    D density(const Vec3T<D>& h) const
    {
        const D z2 = h.z * h.z, length2 = h.x * h.x + h.y * h.y + z2;
        const D x = h.x / along, y = h.y / across, r = length2 / (x * x + y * y + z2);
        return r * r / (pi_d * along * across);
    }
    // cos (1 + 2 Lambda), with Smith's Lambda. For any z.
    D spread(const Vec3T<D>& w) const
    {
        const D x = along * w.x, y = across * w.y;
        return sqrt(w.z * w.z + x * x + y * y);
    }
    D visibility(const Vec3T<D>& wo, const Vec3T<D>& wi) const
    {
        return 0.5 / (abs(wo.z) * spread(wi) + abs(wi.z) * spread(wo));
    }
    // As GgxT::sample_visible(): the sphere of stretched space does not know the alphas.
    Vec3T<D> sample_visible(const Vec3T<D>& wo, D v, const SinCosT<D>& phi) const
    {
        const Vec3T<D> w = normalize(Vec3T<D>{along * wo.x, across * wo.y, wo.z});
        const Vec3T<D> h = GgxT<D>{D{} + 1.0}.sample_visible(w, v, phi);
        return normalize(Vec3T<D>{along * h.x, across * h.y, h.z});
    }
    Vec3T<D> sample_visible(const Vec3T<D>& wo, Vec2 v) const
    {
        const SinCos phi = sin_cos_2pi(v.x);
        return sample_visible(wo, v.y, {phi.sin, phi.cos});
    }
};
using StretchedGgx = StretchedGgxT<double>;

// As eval_facets(). Its name is another, so that a pair of braces with one alpha means isotropic facets.
template <class D>
inline FacetReflectionT<D> eval_stretched(const StretchedGgxT<D>& ggx, const Vec3T<D>& wo, const Vec3T<D>& wi)
{
    const Vec3T<D> sum = wo + wi;
    const D d = ggx.density(sum);
    return {.f_cos = d * ggx.visibility(wo, wi) * wi.z,
            .pdf = 0.5 * d / (wo.z + ggx.spread(wo)),
            .cos_h = smaller(D{} + 1.0, 0.5 * length(sum))};
}

}  // namespace lancer
