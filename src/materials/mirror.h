// A perfect mirror with a constant tint, on both sides.
#pragma once

#include "materials/bsdf.h"
#include "materials/material_type.h"
#include "materials/parameter.h"
#include "materials/phong.h"
#include "materials/textures/texture.h"

namespace lancer {

struct MirrorBsdf {
    Color tint;

    static constexpr bool only_delta() { return true; }
    static constexpr bool transmits() { return false; }
    Color reflectance() const { return tint; }
    static BsdfValue eval(Vec3, Vec3) { return {}; }
    static Color eval_diffuse(Vec3, Vec3) { return {}; }
    std::optional<BsdfSample> sample(Vec3 wo, float, Vec2) const
    {
        if (wo.z <= 0) return {};
        return BsdfSample{.wi = {-wo.x, -wo.y, wo.z}, .weight = tint, .pdf = 1, .delta = true};
    }
};
static_assert(Bsdf<MirrorBsdf>);

struct Mirror {
    static constexpr MaterialType type = MaterialType::mirror;
    ColorParam tint;
    static constexpr auto parameters = std::tuple{parameter("base_color", &Mirror::tint, Color{1, 1, 1})};

    MirrorBsdf at(const ShadingPoint& p) const { return {p.base(tint)}; }
    static constexpr bool mirrors() { return true; }
    Phong phong(const ShadingPoint& p) const { return {.specular = p.base(tint), .diffusion = 0, .reflexion = 1}; }
};

}  // namespace lancer
