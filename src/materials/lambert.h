// Ideal diffuse reflection, on both sides of the surface. Pharr, Jakob, Humphreys, 4th ed., section 9.2.
#pragma once

#include "core/warp.h"
#include "materials/bsdf.h"
#include "materials/material_type.h"
#include "materials/parameter.h"
#include "materials/phong.h"
#include "materials/textures/texture.h"

namespace lancer {

// Value and density for a direction above the surface; cos_i: its cosine with the shading normal, > 0.
template <class Spectrum, class T>
BsdfValueT<Spectrum, T> lambert_value(const Spectrum& albedo, T cos_i)
{
    const T pdf = pdf_cosine_hemisphere(cos_i);
    return {albedo * pdf, pdf};
}

struct LambertBsdf {
    Color albedo;

    static constexpr bool only_delta() { return false; }
    static constexpr bool transmits() { return false; }
    static constexpr bool samples_cosine = true;  // sample() has the density of pdf_cosine_hemisphere()
    Color reflectance() const { return albedo; }
    BsdfValue eval(Vec3 wo, Vec3 wi) const
    {
        if (wo.z <= 0 || wi.z <= 0) return {};
        return lambert_value(albedo, wi.z);
    }
    Color eval_diffuse(Vec3 wo, Vec3 wi) const { return eval(wo, wi).f_cos; }
    std::optional<BsdfSample> sample(Vec3 wo, float, Vec2 v) const
    {
        if (wo.z <= 0) return {};
        const Vec3 wi = square_to_cosine_hemisphere(v);
        if (wi.z <= 0) return {};
        return BsdfSample{.wi = wi, .weight = albedo, .pdf = pdf_cosine_hemisphere(wi.z)};
    }
};
static_assert(Bsdf<LambertBsdf>);

struct Lambert {
    static constexpr MaterialType type = MaterialType::lambert;
    ColorParam albedo;
    static constexpr auto parameters = std::tuple{parameter("base_color", &Lambert::albedo)};

    LambertBsdf at(const ShadingPoint& p) const { return {p.base(albedo)}; }
    static constexpr bool mirrors() { return false; }
    Phong phong(const ShadingPoint& p) const { return {.diffuse = p.base(albedo)}; }
};

}  // namespace lancer
