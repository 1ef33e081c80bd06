// A sheet that spreads light on both of its sides: a leaf, paper, a curtain, a lamp shade. One part is reflected
// diffusely, another is let through and spread as evenly on the far side. The same from both sides, and without an
// inside. As the material diffusetransmission of pbrt-v4.
#pragma once

#include "core/warp.h"
#include "materials/bsdf.h"
#include "materials/lambert.h"
#include "materials/material_type.h"
#include "materials/parameter.h"
#include "materials/phong.h"
#include "materials/textures/texture.h"

namespace lancer {

class TranslucentBsdf {
public:
    // The albedos of the two lobes, on wo's side and beyond. What is negative counts as 0. If their sum exceeds 1 in
    // some channel, both are divided by the largest sum, so that no light is made.
    TranslucentBsdf(Color reflected, Color transmitted)
        : reflected_(not_negative(reflected)), transmitted_(not_negative(transmitted))
    {
        if (const float most = max_component(reflected_ + transmitted_); most > 1)
            reflected_ /= most, transmitted_ /= most;
        const float r = max_component(reflected_), t = max_component(transmitted_);
        if (t > 0) reflects_ = r / (r + t);
    }

    static constexpr bool only_delta() { return false; }
    bool transmits() const { return !is_black(transmitted_); }
    // Of both sides together.
    Color reflectance() const { return reflected_ + transmitted_; }
    // The albedo of the lobe on wo's side.
    Color reflected() const { return reflected_; }

    BsdfValue eval(Vec3 wo, Vec3 wi) const
    {
        if (wo.z <= 0 || wi.z == 0) return {};
        const Lobe lobe = lobe_on(wi.z > 0);
        BsdfValue f = lambert_value(lobe.albedo, std::abs(wi.z));
        f.pdf *= lobe.probability;
        return f;
    }
    Color eval_diffuse(Vec3 wo, Vec3 wi) const { return wi.z > 0 ? eval(wo, wi).f_cos : Color{}; }
    std::optional<BsdfSample> sample(Vec3 wo, float u, Vec2 v) const
    {
        if (wo.z <= 0) return {};
        const Vec3 above = square_to_cosine_hemisphere(v);
        if (above.z <= 0) return {};
        const bool reflects = u < reflects_;
        const Lobe lobe = lobe_on(reflects);
        return BsdfSample{.wi = {above.x, above.y, reflects ? above.z : -above.z},
                          .weight = lobe.albedo / lobe.probability,
                          .pdf = pdf_cosine_hemisphere(above.z) * lobe.probability};
    }

private:
    static Color not_negative(Color c) { return {std::max(0.0f, c.r), std::max(0.0f, c.g), std::max(0.0f, c.b)}; }

    struct Lobe {
        Color albedo;
        float probability;  // with which it is chosen: in proportion to its largest albedo
    };
    Lobe lobe_on(bool this_side) const
    {
        return this_side ? Lobe{reflected_, reflects_} : Lobe{transmitted_, 1 - reflects_};
    }

    Color reflected_, transmitted_;
    float reflects_ = 1;
};
static_assert(Bsdf<TranslucentBsdf>);

struct Translucent {
    static constexpr MaterialType type = MaterialType::translucent;
    ColorParam reflectance, transmittance;
    static constexpr auto parameters =
        std::tuple{parameter("base_color", &Translucent::reflectance, Color{0.4f, 0.4f, 0.4f}),
                   parameter("transmittance", &Translucent::transmittance)};

    TranslucentBsdf at(const ShadingPoint& p) const { return {p.base(reflectance), p.part(transmittance)}; }
    static constexpr bool mirrors() { return false; }
    // The model has no diffuse transmission: light from behind is missing.
    Phong phong(const ShadingPoint& p) const { return {.diffuse = at(p).reflected()}; }
};

}  // namespace lancer
