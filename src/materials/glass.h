// Dielectric boundary: reflection and refraction by the exact Fresnel equations, with total internal reflection.
// Smooth: Pharr, Jakob, Humphreys, 4th ed., section 9.5. Rough: see rough_glass.h; multiple scattering between facets
// is lost, or comes back. Thin: a sheet without an inside, see thin_sheet.h.
#pragma once

#include <memory>

#include "materials/material_type.h"
#include "materials/parameter.h"
#include "materials/phong.h"
#include "materials/rough_glass.h"
#include "materials/textures/texture.h"
#include "materials/thin_sheet.h"

namespace lancer {

struct GlassBsdf {
    Color tint;
    // Index beyond the surface over index on wo's side. In double: rounded to float it would not be the inverse of the
    // index from the other side, and near the critical angle light differs by the square root of that error.
    double eta;
    float alpha = 0;        // 0: smooth
    bool fresnel = true;    // false: a smooth boundary only refracts
    bool thin = false;      // a sheet: what goes through is not turned
    GlassLobes multiple{};  // of multiple scattering between facets, if any

    bool only_delta() const { return alpha == 0; }
    bool transmits() const { return alpha != 0; }
    bool is_rough_boundary() const { return alpha != 0 && !thin; }
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
        return eval_lobes(unit_in_double(wo), wi);
    }
    static Color eval_diffuse(Vec3, Vec3) { return {}; }
    std::optional<BsdfSample> sample(Vec3 wo, float u, Vec2 v) const
    {
        if (wo.z <= 0) return {};
        if (only_delta()) return thin ? sample_sheet(wo, u) : sample_smooth(wo, u);
        const Vec3d unit = unit_in_double(wo);
        const std::optional<Vec3> wi = sample_direction(wo, unit, u, v);
        if (!wi) return {};
        const BsdfValue f = eval_lobes(unit, *wi);
        if (!(f.pdf > 0)) return {};
        return BsdfSample{.wi = *wi, .weight = f.f_cos / f.pdf, .pdf = f.pdf, .eta = index_towards(*wi)};
    }
    // The direction alone, of a rough boundary or sheet. wo.z > 0; unit: wo in double.
    std::optional<Vec3> sample_direction(Vec3 wo, Vec3d unit, float u, Vec2 v) const
    {
        if (multiple) {
            const float p = chance_of_multiple(*this, multiple.here.loss(wo.z));
            if (u < p) return sample_multiple(multiple, u / p, v);
            u = left_of_choice(u, p);
        }
        if (thin) return sample_rough_sheet(unit, u, v);
        const SinCos phi = sin_cos_2pi(v.x);
        const auto [wi, found] = sample_facets_of_glass(*this, unit, u, double{v.y}, {phi.sin, phi.cos});
        return found ? std::optional(wi) : std::nullopt;
    }
    // BsdfSample::eta of a direction.
    float index_towards(Vec3 wi) const { return wi.z < 0 && !thin ? static_cast<float>(eta) : 1; }

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
    // Light of single scattering and of all further orders.
    BsdfValue eval_lobes(Vec3d wo, Vec3 wi) const
    {
        if (!thin) return eval_rough_glass(*this, wo, wi);
        BsdfValue f = eval_rough_sheet(wo, wi);
        if (multiple) add_multiple(*this, to_float(wo.z), wi.z, static_cast<float>(std::abs(unit_in_double(wi).z)), f);
        return f;
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
        return {least_of(of_o, of_i) * static_cast<float>(facets.f_cos), static_cast<float>(part_o * facets.pdf)};
    }
    std::optional<Vec3> sample_rough_sheet(Vec3d wo, float u, Vec2 v) const
    {
        const bool through = !(u < static_cast<float>(reflectance_of_sheet(face(wo))));
        std::optional<Vec3> wi = sample_facets(sheet_facets(through), wo, v);
        if (wi && through) wi->z = -wi->z;
        return wi;
    }
    Ggx sheet_facets(bool through) const { return {alpha_of_sheet(static_cast<double>(alpha), eta, through)}; }
};
static_assert(Bsdf<GlassBsdf>);

struct Glass {
    static constexpr MaterialType type = MaterialType::glass;
    ColorParam tint;
    float ior;                                    // inside (behind the geometric normal) over outside
    FloatParam roughness = 0;                     // perceptual
    bool fresnel = true;                          // false: it only refracts where it is smooth
    bool thin = false;                            // a sheet without an inside; the same from both sides
    std::shared_ptr<const GlassLosses> losses{};  // of ior and roughness: with multiple scattering
    // What absorbs, scatters and has a priority is the medium inside. Whether it is thin may be left to the shape.
    static constexpr auto parameters = std::tuple{parameter("base_color", &Glass::tint, Color{1, 1, 1}),
                                                  parameter("roughness", &Glass::roughness),
                                                  parameter("ior", &Glass::ior),
                                                  parameter("thin"),
                                                  parameter("absorption"),
                                                  parameter("priority"),
                                                  parameter("scattering"),
                                                  parameter("scattering_anisotropy"),
                                                  parameter("subsurface_color"),
                                                  parameter("subsurface_radius")};

    GlassBsdf at(const ShadingPoint& p) const { return with(p, p.base(tint), p.eval(roughness)); }
    // With another tint and roughness than its own; of the point the side and the index count.
    GlassBsdf with(const ShadingPoint& p, Color color, float rough) const
    {
        // Facets deflect transmitted light by about alpha times (index - 1). Where float cannot distinguish that from 0
        // the boundary is treated as smooth.
        const float alpha = alpha_of_roughness(rough);
        if (thin) {
            const bool spreads = double{alpha} * spread_of_sheet(double{ior}) >= double{least_alpha};
            return made(color, double{ior}, spreads ? alpha : 0, p.front);
        }
        const float n = p.inner_over_outer(ior);
        const bool bends = alpha * std::min(1.0f, std::abs(n - 1)) >= least_alpha;
        return made(color, p.front ? double{n} : 1 / double{n}, bends ? alpha : 0, p.front);
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
    GlassBsdf made(Color color, double eta, float alpha, bool front) const
    {
        GlassBsdf bsdf{color, eta, alpha, fresnel, thin};
        if (losses && alpha > 0) bsdf.multiple = losses->lobes(eta, front, alpha, color);
        return bsdf;
    }
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
