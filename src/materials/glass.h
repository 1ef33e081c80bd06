// Dielectric boundary: reflection and refraction by the exact Fresnel equations, with total internal reflection.
// Smooth: Pharr, Jakob, Humphreys, 4th ed., section 9.5. Rough: GGX microfacets, Walter et al., "Microfacet Models for
// Refraction through Rough Surfaces", EGSR 2007; multiple scattering between facets is lost. Thin: a sheet without an
// inside, see thin_sheet.h.
#pragma once

#include "materials/fresnel.h"
#include "materials/material_type.h"
#include "materials/microfacet.h"
#include "materials/parameter.h"
#include "materials/phong.h"
#include "materials/textures/texture.h"
#include "materials/thin_sheet.h"

namespace lancer {

struct GlassBsdf {
    Color tint;
    // Index beyond the surface over index on wo's side. In double: rounded to float it would not be the inverse of the
    // index from the other side, and near the critical angle light differs by the square root of that error.
    double eta;
    float alpha = 0;      // 0: smooth
    bool fresnel = true;  // false: a smooth boundary only refracts
    bool thin = false;    // a sheet: what goes through is not turned

    bool only_delta() const { return alpha == 0; }
    bool transmits() const { return alpha != 0; }
    Color reflectance() const
    {
        if (!thin) return tint;
        const double r = face({0, 0, 1}), reflected = reflectance_of_sheet(r);
        const SheetColors colors = colors_of_sheet(r, tint);
        return colors.reflected * static_cast<float>(reflected) +
               colors.transmitted * static_cast<float>(1 - reflected);
    }

    BsdfValue eval(Vec3 wo, Vec3 wi) const
    {
        if (only_delta() || wo.z <= 0 || wi.z == 0) return {};
        return thin ? eval_rough_sheet(unit_in_double(wo), wi) : eval_rough(unit_in_double(wo), wi);
    }
    static Color eval_diffuse(Vec3, Vec3) { return {}; }
    std::optional<BsdfSample> sample(Vec3 wo, float u, Vec2 v) const
    {
        if (wo.z <= 0) return {};
        if (thin) return only_delta() ? sample_sheet(wo, u) : sample_rough_sheet(wo, u, v);
        return only_delta() ? sample_smooth(wo, u) : sample_rough(wo, u, v);
    }

    // Part of the light from -wo that a smooth sheet lets through; of a smooth boundary the part that goes on, as if
    // it were not turned. The angle counts as that outside, where light that came in by one face of a body meets the
    // other.
    Color straight_on(Vec3 wo) const
    {
        if (wo.z <= 0) return {};
        if (!thin) return fresnel ? tint * (1 - fresnel_dielectric(wo, std::max(eta, 1 / eta)).reflectance) : tint;
        const double r = face(to_double(wo));
        return colors_of_sheet(r, tint).transmitted * (1 - static_cast<float>(reflectance_of_sheet(r)));
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

    // Reflectance of one face of a sheet. w: unit, z > 0.
    double face(Vec3d w) const
    {
        const double r = fresnel_dielectric_double(std::min(1.0, w.z), w.x * w.x + w.y * w.y, eta).reflectance;
        return fresnel || r == 1 ? r : 0;
    }
    std::optional<BsdfSample> sample_sheet(Vec3 wo, float u) const
    {
        const double r = face(to_double(wo));
        const auto reflected = static_cast<float>(reflectance_of_sheet(r));
        const SheetColors colors = colors_of_sheet(r, tint);
        if (u < reflected)
            return BsdfSample{.wi = {-wo.x, -wo.y, wo.z}, .weight = colors.reflected, .pdf = reflected, .delta = true};
        return BsdfSample{.wi = -wo, .weight = colors.transmitted, .pdf = 1 - reflected, .delta = true};
    }

    // A rough sheet has a lobe around the mirror image and a narrower one around what goes straight on. The reflectance
    // is that of the sheet, not of its facets, for wo or wi, whichever gives less: reciprocal, and no energy is gained.
    BsdfValue eval_rough_sheet(Vec3d wo, Vec3 w) const
    {
        const Vec3d wi = unit_in_double(Vec3{w.x, w.y, std::abs(w.z)});
        const bool through = w.z < 0;
        const FacetReflection facets = eval_facets(sheet_facets(through), wo, wi);
        const double r_o = face(wo), r_i = face(wi);
        const double part_o = part_of_sheet(r_o, through), part_i = part_of_sheet(r_i, through);
        const SheetColors o = colors_of_sheet(r_o, tint), i = colors_of_sheet(r_i, tint);
        const Color of_o = (through ? o.transmitted : o.reflected) * static_cast<float>(part_o);
        const Color of_i = (through ? i.transmitted : i.reflected) * static_cast<float>(part_i);
        const Color least{std::min(of_o.r, of_i.r), std::min(of_o.g, of_i.g), std::min(of_o.b, of_i.b)};
        return {least * static_cast<float>(facets.f_cos), static_cast<float>(part_o * facets.pdf)};
    }
    std::optional<BsdfSample> sample_rough_sheet(Vec3 w, float u, Vec2 v) const
    {
        const Vec3d wo = unit_in_double(w);
        const bool through = !(u < static_cast<float>(reflectance_of_sheet(face(wo))));
        std::optional<Vec3> wi = sample_facets(sheet_facets(through), wo, v);
        if (!wi) return {};
        if (through) wi->z = -wi->z;
        const BsdfValue f = eval_rough_sheet(wo, *wi);
        if (!(f.pdf > 0)) return {};
        return BsdfSample{.wi = *wi, .weight = f.f_cos / f.pdf, .pdf = f.pdf};
    }
    Ggx sheet_facets(bool through) const { return {static_cast<double>(alpha) * (through ? spread_of_sheet(eta) : 1)}; }
    static double part_of_sheet(double r, bool through)
    {
        return through ? (1 - r) / (1 + r) : reflectance_of_sheet(r);
    }
};
static_assert(Bsdf<GlassBsdf>);

struct Glass {
    static constexpr MaterialType type = MaterialType::glass;
    ColorParam tint;
    float ior;                 // inside (behind the geometric normal) over outside
    FloatParam roughness = 0;  // perceptual
    bool fresnel = true;       // false: it only refracts where it is smooth
    bool thin = false;         // a sheet without an inside; the same from both sides
    // What absorbs and has a priority is the medium inside. Whether it is thin may be left to the shape.
    static constexpr auto parameters = std::tuple{parameter("base_color", &Glass::tint, Color{1, 1, 1}),
                                                  parameter("roughness", &Glass::roughness),
                                                  parameter("ior", &Glass::ior),
                                                  parameter("thin"),
                                                  parameter("absorption"),
                                                  parameter("priority")};

    GlassBsdf at(const ShadingPoint& p) const
    {
        // Facets deflect transmitted light by about alpha times (index - 1). Where float cannot distinguish that from 0
        // the boundary is treated as smooth.
        const float alpha = alpha_of_roughness(p.eval(roughness));
        if (thin) {
            const bool spreads = double{alpha} * spread_of_sheet(double{ior}) >= double{least_alpha};
            return {p.base(tint), double{ior}, spreads ? alpha : 0, fresnel, true};
        }
        const float n = p.inner_over_outer(ior);
        const bool bends = alpha * std::min(1.0f, std::abs(n - 1)) >= least_alpha;
        return {p.base(tint), p.front ? double{n} : 1 / double{n}, bends ? alpha : 0, fresnel};
    }
    static constexpr bool mirrors() { return true; }
    // Of the medium inside, where there is one; over that around it, or with a priority by itself.
    std::optional<float> medium_ior(bool) const { return thin ? std::nullopt : std::optional(ior); }
    Phong phong(const ShadingPoint& p) const
    {
        if (thin) return phong_of_sheet(p);
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

private:
    Phong phong_of_sheet(const ShadingPoint& p) const
    {
        const double r = fresnel_dielectric_double(1.0, 0, double{ior}).reflectance;
        const SheetColors colors = colors_of_sheet(r, p.base(tint));
        const auto reflected = static_cast<float>(reflectance_of_sheet(r));
        return {.diffuse = colors.transmitted,
                .specular = colors.reflected,
                .shininess = shininess_of(p.eval(roughness)),
                .diffusion = 0,
                .reflexion = reflected,
                .refraction = 1 - reflected,
                .sheet_ior = ior};
    }
};

}  // namespace lancer
