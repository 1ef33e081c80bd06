// The smooth boundary of a dielectric: reflects and refracts by the exact Fresnel equations, with total internal
// reflection. Pharr, Jakob, Humphreys, 4th ed., section 9.5.
#pragma once

#include "materials/bsdf.h"
#include "materials/fresnel.h"
#include "materials/texture.h"

namespace lancer {

struct GlassBsdf {
    Color tint;
    float eta;  // index beyond the surface over index on wo's side

    static constexpr bool only_delta() { return true; }
    static BsdfValue eval(Vec3, Vec3) { return {}; }
    std::optional<BsdfSample> sample(Vec3 wo, float u, Vec2) const
    {
        if (wo.z <= 0) return {};
        const auto [reflectance, cos_t] = fresnel_dielectric(wo, eta);
        if (u < reflectance)
            return BsdfSample{.wi = {-wo.x, -wo.y, wo.z}, .weight = tint, .pdf = reflectance, .delta = true};
        const float scale = 1 / eta;
        const Vec3 wi = normalize(Vec3{-wo.x * scale, -wo.y * scale, -cos_t});
        return BsdfSample{
            .wi = wi, .weight = tint * (scale * scale), .pdf = 1 - reflectance, .delta = true, .eta = eta};
    }
};
static_assert(Bsdf<GlassBsdf>);

struct Glass {
    static constexpr const char* name = "glass";
    ColorParam tint;
    float ior;  // inside (behind the geometric normal) over outside

    GlassBsdf at(const ShadingPoint& p) const { return {p.eval(tint), p.front ? ior : 1 / ior}; }
};

}  // namespace lancer
