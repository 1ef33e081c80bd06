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

// All directions in double, unit, z > 0 unless stated otherwise; x is along the tangent.
struct StretchedGgx {
    double along, across;

    // Of normals; h need not be unit.
    double density(Vec3d h) const
    {
        const double z2 = h.z * h.z, length2 = h.x * h.x + h.y * h.y + z2;
        const double x = h.x / along, y = h.y / across, r = length2 / (x * x + y * y + z2);
        return r * r / (pi_d * along * across);
    }
    // cos (1 + 2 Lambda), with Smith's Lambda. For any z.
    double spread(Vec3d w) const
    {
        const double x = along * w.x, y = across * w.y;
        return std::sqrt(w.z * w.z + x * x + y * y);
    }
    double visibility(Vec3d wo, Vec3d wi) const
    {
        return 0.5 / (std::abs(wo.z) * spread(wi) + std::abs(wi.z) * spread(wo));
    }
    // As Ggx::sample_visible(): the sphere of stretched space does not know the alphas.
    Vec3d sample_visible(Vec3d wo, Vec2 v) const
    {
        const Vec3d w = normalize(Vec3d{along * wo.x, across * wo.y, wo.z});
        const Vec3d h = Ggx{1}.sample_visible(w, v);
        return normalize(Vec3d{along * h.x, across * h.y, h.z});
    }
};

// As eval_facets(). Its name is another, so that a pair of braces with one alpha means isotropic facets.
inline FacetReflection eval_stretched(const StretchedGgx& ggx, Vec3d wo, Vec3d wi)
{
    const Vec3d sum = wo + wi;
    const double d = ggx.density(sum);
    return {.f_cos = d * ggx.visibility(wo, wi) * wi.z,
            .pdf = 0.5 * d / (wo.z + ggx.spread(wo)),
            .cos_h = std::min(1.0, 0.5 * length(sum))};
}

}  // namespace lancer
