// Dielectric boundary: reflection and refraction by the exact Fresnel equations, with total internal reflection.
// Smooth: Pharr, Jakob, Humphreys, 4th ed., section 9.5. Rough: GGX microfacets, Walter et al., "Microfacet Models for
// Refraction through Rough Surfaces", EGSR 2007; multiple scattering between facets is lost.
#pragma once

#include "materials/fresnel.h"
#include "materials/material_type.h"
#include "materials/microfacet.h"
#include "materials/parameter.h"
#include "materials/phong.h"
#include "materials/textures/texture.h"

namespace lancer {

struct GlassBsdf {
    Color tint;
    // Index beyond the surface over index on wo's side. In double: rounded to float it would not be the inverse of the
    // index from the other side, and near the critical angle light differs by the square root of that error.
    double eta;
    float alpha = 0;      // 0: smooth
    bool fresnel = true;  // false: a smooth boundary only refracts

    bool only_delta() const { return alpha == 0; }
    bool transmits() const { return alpha != 0; }
    Color reflectance() const { return tint; }

    BsdfValue eval(Vec3 wo, Vec3 wi) const
    {
        if (only_delta() || wo.z <= 0 || wi.z == 0) return {};
        return eval_rough(unit_in_double(wo), wi);
    }
    std::optional<BsdfSample> sample(Vec3 wo, float u, Vec2 v) const
    {
        if (wo.z <= 0) return {};
        return only_delta() ? sample_smooth(wo, u) : sample_rough(wo, u, v);
    }

private:
    std::optional<BsdfSample> sample_smooth(Vec3 wo, float u) const
    {
        const Fresnel boundary = fresnel_dielectric(wo, eta);
        const auto [reflectance, cos_t] = fresnel ? boundary : only_refracting(boundary);
        if (u < reflectance)
            return BsdfSample{.wi = {-wo.x, -wo.y, wo.z}, .weight = tint, .pdf = reflectance, .delta = true};
        const auto scale = static_cast<float>(1 / eta);
        const Vec3 wi = normalize(Vec3{-wo.x * scale, -wo.y * scale, -cos_t});
        return BsdfSample{.wi = wi,
                          .weight = tint * (scale * scale),
                          .pdf = 1 - reflectance,
                          .delta = true,
                          .eta = static_cast<float>(eta)};
    }
    FresnelT<double> facet_fresnel(double cos) const
    {
        return fresnel_dielectric_double(cos, (1 - cos) * (1 + cos), eta);
    }
    BsdfValue value(double f_cos, double pdf) const
    {
        return {tint * static_cast<float>(f_cos), static_cast<float>(pdf)};
    }

    BsdfValue eval_rough(Vec3d wo, Vec3 w) const
    {
        const Ggx ggx{static_cast<double>(alpha)};
        const Vec3d wi = unit_in_double(w);
        if (w.z > 0) {
            const FacetReflection facets = eval_facets(ggx, wo, wi);
            const double reflected = facet_fresnel(facets.cos_h).reflectance;
            return value(reflected * facets.f_cos, reflected * facets.pdf);
        }
        // Normal of the facet that refracts wo to wi: along wo + eta wi, on wo's side of the surface.
        const double n = eta;
        const Vec3d sum = wo + n * wi;
        const double length2 = dot(sum, sum), scale = std::copysign(1 / std::sqrt(length2), sum.z);
        const double cos_o = scale * dot(wo, sum), cos_i = scale * dot(wi, sum);
        if (!(cos_o > 0 && cos_i < 0)) return {};
        // Jacobian: solid angle of normals over that of wi. length2 is the squared sum in Walter et al.
        const double jacobian = -cos_i * n * n / length2;
        const double through =
            (1 - facet_fresnel(std::min(1.0, cos_o)).reflectance) * ggx.density(sum) * cos_o * jacobian;
        return value(4 * through * ggx.visibility(wo, wi) * -wi.z / (n * n), 2 * through / (wo.z + ggx.spread(wo)));
    }
    std::optional<BsdfSample> sample_rough(Vec3 w, float u, Vec2 v) const
    {
        const Ggx ggx{static_cast<double>(alpha)};
        const Vec3d wo = unit_in_double(w), h = ggx.sample_visible(wo, v);
        const double cos_o = std::min(1.0, dot(wo, h)), n = eta;
        const auto [reflectance, cos_t] = facet_fresnel(cos_o);
        const bool through = !(u < static_cast<float>(reflectance));
        const Vec3d turned = through ? h * (cos_o / n - cos_t) - wo / n : mirrored(wo, h);
        const Vec3 wi = to_float(turned);
        if (wi.z == 0 || (wi.z < 0) != through) return {};
        const BsdfValue f = eval_rough(wo, wi);
        if (!(f.pdf > 0)) return {};
        return BsdfSample{
            .wi = wi, .weight = f.f_cos / f.pdf, .pdf = f.pdf, .eta = through ? static_cast<float>(eta) : 1};
    }
};
static_assert(Bsdf<GlassBsdf>);

struct Glass {
    static constexpr MaterialType type = MaterialType::glass;
    ColorParam tint;
    float ior;                 // inside (behind the geometric normal) over outside
    FloatParam roughness = 0;  // perceptual
    bool fresnel = true;       // false: it only refracts where it is smooth
    // What absorbs and has a priority is the medium inside.
    static constexpr auto parameters =
        std::tuple{parameter("base_color", &Glass::tint, Color{1, 1, 1}), parameter("roughness", &Glass::roughness),
                   parameter("ior", &Glass::ior), parameter("absorption"), parameter("priority")};

    GlassBsdf at(const ShadingPoint& p) const
    {
        // Facets deflect transmitted light by about alpha times (index - 1). Where float cannot distinguish that from 0
        // the boundary is treated as smooth.
        const float alpha = alpha_of_roughness(p.eval(roughness)), n = p.inner_over_outer(ior);
        const bool bends = alpha * std::min(1.0f, std::abs(n - 1)) >= least_alpha;
        return {p.base(tint), p.front ? double{n} : 1 / double{n}, bends ? alpha : 0, fresnel};
    }
    static constexpr bool mirrors() { return true; }
    // Of the medium inside, where there is one; over that around it, or with a priority by itself.
    std::optional<float> medium_ior(bool) const { return ior; }
    Phong phong(const ShadingPoint& p) const
    {
        const Color color = p.base(tint);
        const float n = p.inner_over_outer(ior), reflected = fresnel_dielectric(1.0f, n).reflectance;
        return {.diffuse = color,
                .specular = color,
                .shininess = shininess_of(p.eval(roughness)),
                .diffusion = 0,
                .reflexion = reflected,
                .refraction = 1 - reflected,
                .inside_ior = n};
    }
};

}  // namespace lancer
