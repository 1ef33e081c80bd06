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

#include "materials/material_type.h"
#include "materials/parameter.h"
#include "materials/phong.h"
#include "materials/plastic_coat.h"
#include "materials/textures/texture.h"

namespace lancer {

class PlasticBsdf {
public:
    using Coat = PlasticCoat<float, AlbedoTable::Row>;

    // table: of eta; not used where alpha is 0. mean_through: 1 - E'.
    PlasticBsdf(Color base, Color specular, float eta, float alpha, const AlbedoTable* table, float mean_through)
        : specular_(specular), coat_{eta, alpha, mean_through, alpha == 0 ? AlbedoTable::Row() : table->row(alpha)}
    {
        base_ = base / mean_through;
    }

    bool only_delta() const { return is_black(base_) && coat_.alpha == 0; }
    static constexpr bool transmits() { return false; }
    Color reflectance() const
    {
        return specular_ * (1 - coat_.mean_through) + base_ * (coat_.mean_through * coat_.mean_through);
    }

    BsdfValue eval(Vec3 wo, Vec3 wi) const
    {
        if (only_delta() || wo.z <= 0 || wi.z <= 0) return {};
        return eval_lobes(seen(wo), wi);
    }
    Color eval_diffuse(Vec3 wo, Vec3 wi) const
    {
        if (wo.z <= 0 || wi.z <= 0) return {};
        return base_ * coat_.eval_base(seen(wo), wi);
    }
    std::optional<BsdfSample> sample(Vec3 wo, float u, Vec2 v) const
    {
        if (wo.z <= 0) return {};
        const Coat::Seen o = seen(wo);
        const bool coat = u < o.choice;
        if (coat && coat_.alpha == 0)
            return BsdfSample{.wi = {-wo.x, -wo.y, wo.z},
                              .weight = specular_ * ((1 - o.through) / o.choice),
                              .pdf = o.choice,
                              .delta = true};
        std::optional<Vec3> wi = square_to_cosine_hemisphere(v);
        if (coat) wi = sample_facets({coat_.alpha}, o.wo, v);
        if (!wi || !(wi->z > 0)) return {};
        const BsdfValue f = eval_lobes(o, *wi);
        if (!(f.pdf > 0)) return {};
        return BsdfSample{.wi = *wi, .weight = f.f_cos / f.pdf, .pdf = f.pdf};
    }

    // For who asks many at once. The base is as it is under the coat.
    Color base() const { return base_; }
    Color specular() const { return specular_; }
    const Coat& coat() const { return coat_; }

private:
    Coat::Seen seen(Vec3 wo) const { return coat_.seen(wo, max_component(specular_), max_component(base_)); }
    BsdfValue eval_lobes(const Coat::Seen& o, Vec3 wi) const
    {
        const Coat::Value f = coat_.eval(o, wi);
        return {base_ * f.base + specular_ * f.coat, f.pdf};
    }

    Color base_, specular_;
    Coat coat_;
};
static_assert(Bsdf<PlasticBsdf>);

struct Plastic {
    static constexpr MaterialType type = MaterialType::plastic;
    ColorParam base;
    FloatParam roughness;                       // of the coat, perceptual
    float ior;                                  // of the coat over that of the outside, on either side of the surface
    Color specular;                             // tint of what the coat reflects
    float mean_through;                         // mean_transmittance(ior)
    std::shared_ptr<const AlbedoTable> coat{};  // of ior; may be missing if the roughness is 0 everywhere
    // What is metallic is a metal, in a mix with this.
    static constexpr auto parameters =
        std::tuple{parameter("base_color", &Plastic::base), parameter("roughness", &Plastic::roughness),
                   parameter("ior", &Plastic::ior), parameter("specular", &Plastic::specular),
                   parameter("metallic", nullptr, 0.0f)};

    PlasticBsdf at(const ShadingPoint& p) const
    {
        const float alpha = coat ? alpha_of_roughness(p.eval(roughness)) : 0;
        return {p.base(base), specular, ior, alpha, coat.get(), alpha == 0 ? mean_through : coat->mean_missing(alpha)};
    }
    static constexpr bool mirrors() { return true; }
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
