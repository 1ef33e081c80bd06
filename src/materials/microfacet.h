// Rough surfaces as microfacets, isotropic GGX: the distribution of their normals and Smith's height-correlated masking
// (Walter et al. 2007; Heitz, "Understanding the Masking-Shadowing Function", JCGT 3(2), 2014), normals sampled as they
// are seen (Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps", 2023).
// In double, and of directions made unit in double: a lobe of alpha 1e-5 is no wider than a few of float's steps.
#pragma once

#include <optional>

#include "core/warp.h"
#include "materials/bsdf.h"

namespace lancer {

// What is smoother is taken for perfectly smooth: float directions cannot tell a narrower lobe from a line.
inline constexpr float least_alpha = 1e-5f;

// roughness: perceptual; what textures bring outside [0, 1], or as no number, is moved inside. 0: perfectly smooth.
inline float alpha_of_roughness(float roughness)
{
    const float r = std::min(1.0f, std::max(0.0f, roughness)), alpha = r * r;
    return alpha < least_alpha ? 0 : alpha;
}

// In the eyes of the classic model, which knows mirrors and highlights: the part of what such a surface reflects that
// is a highlight, and the exponent of the highlight that is about as wide (Walter et al., section 5.2). Both 0 of a
// mirror.
inline float highlight_of(float roughness) { return alpha_of_roughness(roughness) > 0 ? std::min(1.0f, roughness) : 0; }
inline float shininess_of(float roughness)
{
    const float alpha = alpha_of_roughness(roughness);
    return alpha > 0 ? 2 / (alpha * alpha) - 2 : 0;
}

inline Vec3d unit_in_double(Vec3 w) { return normalize(to_double(w)); }

// wi mirrored about h, both unit.
inline Vec3d mirrored(Vec3d w, Vec3d h) { return h * (2 * dot(w, h)) - w; }

// All directions in double, unit, z > 0 unless said otherwise.
struct Ggx {
    double alpha;  // > 0

    // Density of the normals per area and solid angle. h: of any length, any sign. From x and y, since 1 - z^2 cancels.
    double density(Vec3d h) const
    {
        const double s2 = h.x * h.x + h.y * h.y, z2 = h.z * h.z, length2 = s2 + z2;
        const double r = length2 / (s2 / (alpha * alpha) + z2);
        return r * r / (pi_d * alpha * alpha);
    }
    // sqrt(cos^2 + alpha^2 sin^2), which is cos (1 + 2 Lambda). For any z.
    double spread(Vec3d w) const { return std::sqrt(w.z * w.z + alpha * alpha * (w.x * w.x + w.y * w.y)); }
    // Smith's Lambda: hidden over visible area of the facets seen from w.
    double lambda(Vec3d w) const
    {
        const double a = alpha * alpha * (w.x * w.x + w.y * w.y), cos = std::abs(w.z);
        return 0.5 * a / (cos * (cos + std::sqrt(w.z * w.z + a)));
    }
    // G2 / (4 |cos_o| |cos_i|), with G2 the part of the facets that both directions see. For any z but both 0.
    double visibility(Vec3d wo, Vec3d wi) const
    {
        return 0.5 / (std::abs(wo.z) * spread(wi) + std::abs(wi.z) * spread(wo));
    }
    // A normal as wo sees them: unit, z > 0, dot(wo, h) > 0.
    Vec3d sample_visible(Vec3d wo, Vec2 v) const
    {
        const Vec3d w = normalize(Vec3d{alpha * wo.x, alpha * wo.y, wo.z});
        // A point of the cap of the unit sphere above -w.z, and z - 1 exact where it is small.
        const double below = static_cast<double>(v.y) * (1 + w.z);
        const double r = std::sqrt(std::max(0.0, below * (2 - below)));
        const SinCos phi = sin_cos_2pi(v.x);
        const Vec3d h{r * static_cast<double>(phi.cos) + w.x, r * static_cast<double>(phi.sin) + w.y, 1 - below + w.z};
        return normalize(Vec3d{alpha * h.x, alpha * h.y, h.z});
    }
};

// What microfacets that reflect all light do, and the cosine at which the facet is met that reflects wo to wi.
struct FacetReflection {
    double f_cos, pdf, cos_h;
};

// Unit, z > 0.
inline FacetReflection eval_facets(const Ggx& ggx, Vec3d wo, Vec3d wi)
{
    const Vec3d sum = wo + wi;
    const double d = ggx.density(sum);
    return {.f_cos = d * ggx.visibility(wo, wi) * wi.z,
            .pdf = 0.5 * d / (wo.z + ggx.spread(wo)),
            .cos_h = std::min(1.0, 0.5 * length(sum))};
}

// A direction drawn with that pdf; nothing if it goes below the surface. wo: unit, z > 0.
inline std::optional<Vec3> sample_facets(const Ggx& ggx, Vec3d wo, Vec2 v)
{
    const Vec3 wi = to_float(mirrored(wo, ggx.sample_visible(wo, v)));
    if (!(wi.z > 0)) return {};
    return wi;
}

}  // namespace lancer
