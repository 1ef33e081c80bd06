// Metal: GGX microfacets of a conductor, given by its complex index of refraction or its colour at normal incidence, on
// both sides of the surface. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007.
// Multiple scattering is lost, or compensated by the lobe of Kulla and Conty, "Revisiting Physically Based Shading at
// Imageworks", SIGGRAPH 2017 courses.
#pragma once

#include <memory>

#include "materials/albedo_table.h"
#include "materials/fresnel.h"
#include "materials/material_type.h"
#include "materials/microfacet.h"
#include "materials/parameter.h"
#include "materials/phong.h"
#include "materials/textures/texture.h"

namespace lancer {

// A complex index of refraction per channel.
struct Conductor {
    Color eta, k;
    Color normal, mean;  // its reflectance at normal incidence, and its cosine-weighted mean

    Color reflectance(double cos) const
    {
        const auto at = [=](float n, float absorption) {
            return static_cast<float>(fresnel_conductor(cos, static_cast<double>(n), static_cast<double>(absorption)));
        };
        return {at(eta.r, k.r), at(eta.g, k.g), at(eta.b, k.b)};
    }
};
// eta, k: finite, >= 0.
inline Conductor make_conductor(Color eta, Color k)
{
    Conductor c{.eta = eta, .k = k, .normal = {}, .mean = {}};
    c.normal = c.reflectance(1);
    const auto mean = [](float n, float absorption) {
        return static_cast<float>(cosine_mean([=](double cos) {
            return fresnel_conductor(cos, static_cast<double>(n), static_cast<double>(absorption));
        }));
    };
    c.mean = {mean(eta.r, k.r), mean(eta.g, k.g), mean(eta.b, k.b)};
    return c;
}

class MetalBsdf {
public:
    // color: F0, or the tint of the conductor if there is one. alpha: 0 for a mirror. compensation: a table of
    // reflectors, or none.
    MetalBsdf(Color color, const Conductor* conductor, float alpha, const AlbedoTable* compensation)
        : color_(color), alpha_(alpha), conductor_(conductor)
    {
        if (!compensation || alpha == 0) return;
        compensation_ = compensation->even_lobe(alpha);
        // The light of multiple scattering relative to that lost by single scattering.
        const Color f = conductor ? color * conductor->mean : mean_schlick(color);
        const auto series = [this](float x) { return all_further_orders(x, compensation_.mean()); };
        multiple_ = {series(f.r), series(f.g), series(f.b)};
        mean_ = max_component(f);
    }

    bool only_delta() const { return alpha_ == 0; }
    static constexpr bool transmits() { return false; }
    Color reflectance() const { return conductor_ ? color_ * conductor_->normal : color_; }

    BsdfValue eval(Vec3 wo, Vec3 wi) const
    {
        if (only_delta() || wo.z <= 0 || wi.z <= 0) return {};
        return eval_lobes(unit_in_double(wo), wi, missing(wo.z));
    }
    static Color eval_diffuse(Vec3, Vec3) { return {}; }
    std::optional<BsdfSample> sample(Vec3 wo, float u, Vec2 v) const
    {
        if (wo.z <= 0) return {};
        if (only_delta())
            return BsdfSample{
                .wi = {-wo.x, -wo.y, wo.z}, .weight = fresnel(static_cast<double>(wo.z)), .pdf = 1, .delta = true};
        const Vec3d o = unit_in_double(wo);
        const float missing_o = missing(wo.z);
        std::optional<Vec3> wi;
        if (u < probability_of_multiple(missing_o))
            wi = direction_at(compensation_.sample_cos(v.x), v.y);
        else
            wi = sample_facets({alpha_}, o, v);
        if (!wi || !(wi->z > 0)) return {};
        const BsdfValue f = eval_lobes(o, *wi, missing_o);
        if (!(f.pdf > 0)) return {};
        return BsdfSample{.wi = *wi, .weight = f.f_cos / f.pdf, .pdf = f.pdf};
    }

private:
    Color fresnel(double cos) const
    {
        return conductor_ ? color_ * conductor_->reflectance(cos) : fresnel_schlick(color_, cos);
    }
    float missing(float cos) const { return compensation_.loss(cos); }
    float probability_of_multiple(float missing_o) const
    {
        return chance_of_even_lobe(missing_o, max_component(multiple_), mean_);
    }
    BsdfValue eval_lobes(Vec3d o, Vec3 wi, float missing_o) const
    {
        const FacetReflection facets = eval_facets({alpha_}, o, unit_in_double(wi));
        BsdfValue f{fresnel(facets.cos_h) * static_cast<float>(facets.f_cos), static_cast<float>(facets.pdf)};
        if (!compensation_) return f;
        const float p = probability_of_multiple(missing_o);
        f.f_cos += multiple_ * (missing_o * missing(wi.z) / compensation_.mean() * wi.z * (1 / pi));
        f.pdf += p * (compensation_.pdf(wi.z) - f.pdf);
        return f;
    }

    Color color_;
    float alpha_;
    const Conductor* conductor_;
    AlbedoTable::EvenLobe compensation_;  // if any
    float mean_ = 0;
    Color multiple_{};
};
static_assert(Bsdf<MetalBsdf>);

struct Metal {
    static constexpr MaterialType type = MaterialType::metal;
    ColorParam color;      // F0, by Schlick's approximation; with a conductor its tint
    FloatParam roughness;  // perceptual
    std::optional<Conductor> conductor{};
    std::shared_ptr<const AlbedoTable> compensation{};  // of reflectors: with multiple scattering
    // eta and k make the conductor; what is not metallic is a plastic, in a mix with this.
    static constexpr auto parameters =
        std::tuple{parameter("base_color", &Metal::color), parameter("roughness", &Metal::roughness), parameter("eta"),
                   parameter("k"), parameter("metallic", nullptr, 1.0f)};

    MetalBsdf at(const ShadingPoint& p) const
    {
        return {p.base(color), conductor ? &*conductor : nullptr, alpha_of_roughness(p.eval(roughness)),
                compensation.get()};
    }
    static constexpr bool mirrors() { return true; }
    // Rough metal has a highlight instead of a mirror.
    Phong phong(const ShadingPoint& p) const
    {
        const float rough = highlight_of(p.eval(roughness));
        return {.specular = at(p).reflectance(),
                .shininess = shininess_of(rough),
                .diffusion = rough,
                .reflexion = 1 - rough};
    }
};

}  // namespace lancer
