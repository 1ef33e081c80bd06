// Metal: a conductor, given by its complex index of refraction or its colour at normal incidence, on both sides of the
// surface. Smooth, or rough: see rough_metal.h.
#pragma once

#include <memory>

#include "materials/material_type.h"
#include "materials/parameter.h"
#include "materials/phong.h"
#include "materials/rough_metal.h"
#include "materials/textures/texture.h"

namespace lancer {

class MetalBsdf {
public:
    // color: F0, or the tint of the conductor if there is one. alpha: 0 for a mirror. compensation: a table of
    // reflectors, or none.
    MetalBsdf(Color color, const Conductor* conductor, float alpha, const AlbedoTable* compensation)
    {
        rough_.fresnel = {color, conductor}, rough_.alpha = alpha;
        if (!compensation || alpha == 0) return;
        rough_.compensation = compensation->even_lobe(alpha);
        const Color f = conductor ? color * conductor->mean : mean_schlick(color);
        rough_.multiple = each(f, [this](float x) { return all_further_orders(x, rough_.compensation.mean()); });
        rough_.mean = max_component(f);
    }

    bool only_delta() const { return rough_.alpha == 0; }
    static constexpr bool transmits() { return false; }
    Color reflectance() const
    {
        const auto& [color, conductor] = rough_.fresnel;
        return conductor ? color * conductor->normal : color;
    }
    // Not of a mirror.
    const RoughMetal& rough() const { return rough_; }

    BsdfValue eval(Vec3 wo, Vec3 wi) const
    {
        if (only_delta() || wo.z <= 0 || wi.z <= 0) return {};
        return rough_.eval(unit_in_double(wo), wi, rough_.missing(wo.z));
    }
    static Color eval_diffuse(Vec3, Vec3) { return {}; }
    std::optional<BsdfSample> sample(Vec3 wo, float u, Vec2 v) const
    {
        if (wo.z <= 0) return {};
        if (only_delta())
            return BsdfSample{.wi = {-wo.x, -wo.y, wo.z},
                              .weight = rough_.fresnel(static_cast<double>(wo.z)),
                              .pdf = 1,
                              .delta = true};
        const Vec3d o = unit_in_double(wo);
        const float missing_o = rough_.missing(wo.z);
        std::optional<Vec3> wi;
        if (u < rough_.chance_of_multiple(missing_o))
            wi = direction_at(rough_.compensation.sample_cos(v.x), v.y);
        else
            wi = sample_facets({rough_.alpha}, o, v);
        if (!wi || !(wi->z > 0)) return {};
        const BsdfValue f = rough_.eval(o, *wi, missing_o);
        if (!(f.pdf > 0)) return {};
        return BsdfSample{.wi = *wi, .weight = f.f_cos / f.pdf, .pdf = f.pdf};
    }

private:
    RoughMetal rough_;
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
