// A diffuse base under a dielectric coat, smooth or of GGX facets; on both sides of the surface. With E(mu) the coat's
// directional albedo and E' its albedo under even light, the base adds
//   (1 - E(mu_o)) (1 - E(mu_i)) rho / (pi (1 - E')),
// so that of all light that crosses the coat the part rho comes out again: the colour of the base is given as it looks
// under the coat, which is what authors choose it by. (Mitsuba's plastic without its nonlinear shift of colours; for a
// white base it is exact for a smooth coat: Wolff, "Diffuse-reflectance model for smooth dielectric surfaces", JOSA A
// 11, 1994.) Of a rough coat the light that facets shadow goes to the base; so a white base reflects all, whatever the
// roughness.
#pragma once

#include <memory>

#include "materials/albedo_table.h"
#include "materials/fresnel.h"
#include "materials/microfacet.h"
#include "materials/phong.h"
#include "materials/texture.h"

namespace lancer {

class PlasticBsdf {
public:
    // coat: of eta; not used where alpha is 0. mean_through: 1 - E'.
    PlasticBsdf(Color base, Color specular, float eta, float alpha, const AlbedoTable* coat, float mean_through)
        : specular_(specular), eta_(eta), alpha_(alpha), mean_through_(mean_through), coat_(coat)
    {
        base_ = base / mean_through;
    }

    bool only_delta() const { return is_black(base_) && alpha_ == 0; }
    static constexpr bool transmits() { return false; }
    Color reflectance() const { return specular_ * (1 - mean_through_) + base_ * (mean_through_ * mean_through_); }

    BsdfValue eval(Vec3 wo, Vec3 wi) const
    {
        if (only_delta() || wo.z <= 0 || wi.z <= 0) return {};
        const float through_o = through(wo.z);
        return eval_lobes(wo, wi, through_o, probability_of_coat(through_o));
    }
    std::optional<BsdfSample> sample(Vec3 wo, float u, Vec2 v) const
    {
        if (wo.z <= 0) return {};
        const float through_o = through(wo.z), p = probability_of_coat(through_o);
        const bool coat = u < p;
        if (coat && alpha_ == 0)
            return BsdfSample{
                .wi = {-wo.x, -wo.y, wo.z}, .weight = specular_ * ((1 - through_o) / p), .pdf = p, .delta = true};
        std::optional<Vec3> wi = square_to_cosine_hemisphere(v);
        if (coat) wi = sample_facets({alpha_}, unit_in_double(wo), v);
        if (!wi || !(wi->z > 0)) return {};
        const BsdfValue f = eval_lobes(wo, *wi, through_o, p);
        if (!(f.pdf > 0)) return {};
        return BsdfSample{.wi = *wi, .weight = f.f_cos / f.pdf, .pdf = f.pdf};
    }

private:
    // 1 - E
    float through(float cos) const
    {
        const float smooth = fresnel_dielectric(std::min(1.0f, cos), eta_).reflectance;
        return 1 - smooth + (alpha_ == 0 ? 0 : smooth * coat_->loss(cos, alpha_));
    }
    // By the light that the lobes send back.
    float probability_of_coat(float through_o) const
    {
        const float coat = max_component(specular_) * (1 - through_o);
        const float base = max_component(base_) * through_o * mean_through_;
        return coat > 0 ? coat / (coat + base) : 0;
    }
    BsdfValue eval_lobes(Vec3 wo, Vec3 wi, float through_o, float p) const
    {
        const float pdf_base = pdf_cosine_hemisphere(wi.z);
        BsdfValue f{base_ * (through_o * through(wi.z) * pdf_base), (1 - p) * pdf_base};
        if (alpha_ == 0) return f;
        const FacetReflection facets = eval_facets({alpha_}, unit_in_double(wo), unit_in_double(wi));
        const float reflected = fresnel_dielectric(static_cast<float>(facets.cos_h), eta_).reflectance;
        f.f_cos += specular_ * (reflected * static_cast<float>(facets.f_cos));
        f.pdf += p * static_cast<float>(facets.pdf);
        return f;
    }

    Color base_, specular_;
    float eta_, alpha_, mean_through_;
    const AlbedoTable* coat_;
};
static_assert(Bsdf<PlasticBsdf>);

struct Plastic {
    static constexpr const char* name = "plastic";
    ColorParam base;
    FloatParam roughness;                       // of the coat, perceptual
    float ior;                                  // of the coat over that of the outside, on either side of the surface
    Color specular;                             // tint of what the coat reflects
    float mean_through;                         // mean_transmittance(ior)
    std::shared_ptr<const AlbedoTable> coat{};  // of ior; may be missing if the roughness is 0 everywhere

    PlasticBsdf at(const ShadingPoint& p) const
    {
        const float alpha = coat ? alpha_of_roughness(p.eval(roughness)) : 0;
        return {p.base(base), specular, ior, alpha, coat.get(), alpha == 0 ? mean_through : coat->mean_missing(alpha)};
    }
    Phong phong(const ShadingPoint& p) const
    {
        const float rough = highlight_of(p.eval(roughness));
        const float f0 = fresnel_dielectric(1.0f, ior).reflectance;
        // The model has one colour for both reflections of the coat, so that what is no mirror has a highlight always;
        // on a smooth coat, whose own would be a point, it is about as wide as the sun. White loses nothing.
        const float diffusion = 1 / (1 + f0 * (1 - rough));
        return {.diffuse = p.base(base) * (1 - f0),
                .specular = specular * f0,
                .shininess = shininess_of(std::max(0.1f, rough)),
                .diffusion = diffusion,
                .reflexion = diffusion * (1 - rough)};
    }
};

}  // namespace lancer
