// An energy-conserving form of the classic illumination model: diffuse reflection, Phong's highlight in the normalised
// and reciprocal form of Lafortune and Willems ("Using the Modified Phong Reflectance Model for Physically Based
// Rendering", 1994), a mirror, and a smooth refracting boundary with the exact Fresnel equations. All four are scaled
// by one factor if together they would reflect more than they receive.
#pragma once

#include <optional>

#include "core/frame.h"
#include "core/warp.h"
#include "materials/bsdf.h"
#include "materials/fresnel.h"
#include "materials/material_type.h"
#include "materials/microfacet.h"
#include "materials/parameter.h"
#include "materials/phong.h"
#include "materials/textures/texture.h"
#include "materials/thin_sheet.h"

namespace lancer {

class InterfaceBsdf {
public:
    // front: the path arrives on the side of the geometric normal. Without fresnel a refracting surface reflects only
    // by total reflection.
    InterfaceBsdf(const Phong& p, bool front, bool fresnel = true)
        : diffuse_(part_of(p.diffuse, p.diffusion)),
          gloss_(part_of(p.specular, p.diffusion)),
          mirror_(part_of(p.specular, p.reflexion + p.refraction)),
          shininess_(std::min(p.shininess, most_shininess)),
          eta_(front ? p.inside_ior / p.outside_ior : p.outside_ior / p.inside_ior),
          sheet_ior_(p.sheet_ior),
          refracts_(p.refraction > 0),
          fresnel_(fresnel)
    {
        if (refracts_) through_ = part_of(p.diffuse, p.reflexion + p.refraction);
        const Color boundary{std::max(mirror_.r, through_.r), std::max(mirror_.g, through_.g),
                             std::max(mirror_.b, through_.b)};
        const float most = max_component(diffuse_ + gloss_ + boundary);
        if (most <= 1) return;
        for (Color* c : {&diffuse_, &gloss_, &mirror_, &through_}) *c /= most;
    }

    bool only_delta() const { return is_black(diffuse_) && is_black(gloss_); }
    static constexpr bool transmits() { return false; }
    Color reflectance() const
    {
        const float f = boundary({0, 0, 1}).reflectance;
        return diffuse_ + gloss_ + mirror_ * f + through_ * (1 - f);
    }

    BsdfValue eval(Vec3 wo, Vec3 wi) const
    {
        if (only_delta() || wo.z <= 0 || wi.z <= 0) return {};
        return eval_smooth(wo, wi, parts(boundary(wo)));
    }
    Color eval_diffuse(Vec3 wo, Vec3 wi) const
    {
        return wo.z > 0 && wi.z > 0 ? diffuse_ * pdf_cosine_hemisphere(wi.z) : Color{};
    }
    std::optional<BsdfSample> sample(Vec3 wo, float u, Vec2 v) const
    {
        if (wo.z <= 0) return {};
        const Fresnel f = boundary(wo);
        const Parts p = parts(f);
        const float sum = p.sum();
        if (!(sum > 0)) return {};
        u *= sum;
        if (u < p.mirror) return chosen(reflected(wo, f), p.mirror / sum);
        if (u >= p.mirror + p.diffuse + p.gloss) return chosen(refracted(wo, f), p.through / sum);
        const Vec3 wi = u < p.mirror + p.diffuse ? square_to_cosine_hemisphere(v) : sample_gloss(wo, v);
        if (wi.z <= 0) return {};
        const BsdfValue value = eval_smooth(wo, wi, p);
        if (!(value.pdf > 0)) return {};
        // Without a highlight the cosine cancels: a purely diffuse interface has the bits of Lambert.
        const Color weight = p.gloss > 0 ? value.f_cos / value.pdf : diffuse_ * (sum / p.diffuse);
        return BsdfSample{.wi = wi, .weight = weight, .pdf = value.pdf};
    }

    // The two specular directions as samples with probability 1; nothing if the lobe is absent. wo: z > 0.
    std::optional<BsdfSample> reflection(Vec3 wo) const
    {
        const BsdfSample s = reflected(wo, boundary(wo));
        return is_black(s.weight) ? std::nullopt : std::optional(s);
    }
    std::optional<BsdfSample> refraction(Vec3 wo) const
    {
        if (is_black(through_)) return {};
        const Fresnel f = boundary(wo);
        return f.reflectance < 1 ? std::optional(refracted(wo, f)) : std::nullopt;
    }

private:
    // Narrower highlights exceed the precision of float directions.
    static constexpr float most_shininess = 2 / (least_alpha * least_alpha);

    // Textures may be negative.
    static Color part_of(Color c, float part)
    {
        return {std::max(0.0f, c.r * part), std::max(0.0f, c.g * part), std::max(0.0f, c.b * part)};
    }

    // Selection weights of the lobes: their approximate albedo.
    struct Parts {
        float mirror, diffuse, gloss, through;
        float sum() const { return mirror + diffuse + gloss + through; }
    };
    Parts parts(const Fresnel& f) const
    {
        return {max_component(mirror_) * f.reflectance, max_component(diffuse_), max_component(gloss_),
                max_component(through_) * (1 - f.reflectance)};
    }
    // Without refraction the mirror reflects its whole part.
    Fresnel boundary(Vec3 wo) const
    {
        if (!refracts_) return {1, 0};
        if (sheet_ior_ > 0) {
            const double r = fresnel_ ? double{fresnel_dielectric(wo, double{sheet_ior_}).reflectance} : 0;
            return {static_cast<float>(reflectance_of_sheet(r)), r < 1 ? wo.z : 0};
        }
        const Fresnel f = fresnel_dielectric(wo, eta_);
        return fresnel_ ? f : only_refracting(f);
    }

    BsdfSample reflected(Vec3 wo, const Fresnel& f) const
    {
        return {.wi = {-wo.x, -wo.y, wo.z}, .weight = mirror_ * f.reflectance, .pdf = 1, .delta = true};
    }
    // f: not for total reflection.
    BsdfSample refracted(Vec3 wo, const Fresnel& f) const
    {
        const float scale = 1 / eta_;
        return {.wi = normalize(Vec3{-wo.x * scale, -wo.y * scale, -f.cos_t}),
                .weight = through_ * ((1 - f.reflectance) * scale * scale),
                .pdf = 1,
                .delta = true,
                .eta = eta_};
    }
    static BsdfSample chosen(BsdfSample s, float probability)
    {
        s.pdf = probability;
        s.weight /= probability;
        return s;
    }

    // The highlight around the mirror direction of wo, with density (n + 1) / (2 pi) cos^n. In double with 1 - cos: for
    // a narrow lobe the float cosine has no precision left.
    Vec3 sample_gloss(Vec3 wo, Vec2 v) const
    {
        const double away = -std::expm1(std::log1p(-static_cast<double>(v.x)) / (static_cast<double>(shininess_) + 1));
        const auto sin = static_cast<float>(std::sqrt(away * (2 - away)));
        const SinCos phi = sin_cos_2pi(v.y);
        const Frame frame({-wo.x, -wo.y, wo.z});
        return normalize(frame.to_world({sin * phi.cos, sin * phi.sin, static_cast<float>(1 - away)}));
    }
    // cos^n / (2 pi), 0 where the cosine is not positive.
    double lobe(Vec3 wo, Vec3 wi) const
    {
        const Vec3d between = unit_in_double(wi) - unit_in_double(Vec3{-wo.x, -wo.y, wo.z});
        const double away = 0.5 * dot(between, between);
        return away < 1 ? std::exp(static_cast<double>(shininess_) * std::log1p(-away)) / (2 * pi_d) : 0;
    }
    BsdfValue eval_smooth(Vec3 wo, Vec3 wi, const Parts& p) const
    {
        const float pdf_diffuse = pdf_cosine_hemisphere(wi.z);
        BsdfValue f{diffuse_ * pdf_diffuse, p.diffuse / p.sum() * pdf_diffuse};
        if (!(p.gloss > 0)) return f;
        const double around = lobe(wo, wi), n = static_cast<double>(shininess_);
        f.f_cos += gloss_ * (static_cast<float>((n + 2) * around) * wi.z);
        f.pdf += p.gloss / p.sum() * static_cast<float>((n + 1) * around);
        return f;
    }

    Color diffuse_, gloss_, mirror_, through_{};
    float shininess_, eta_, sheet_ior_;
    bool refracts_, fresnel_;
};
static_assert(Bsdf<InterfaceBsdf>);

struct Interface {
    static constexpr MaterialType type = MaterialType::interface;
    ColorParam base;  // diffuse colour
    Phong rest{};     // all other parameters
    bool fresnel = true;
    // What absorbs and has a priority is the medium inside.
    static constexpr auto parameters =
        std::tuple{parameter("base_color", &Interface::base),
                   parameter("ambient", member_of(&Interface::rest, &Phong::ambient)),
                   parameter("specular", member_of(&Interface::rest, &Phong::specular)),
                   parameter("shininess", member_of(&Interface::rest, &Phong::shininess)),
                   parameter("diffusion", member_of(&Interface::rest, &Phong::diffusion)),
                   parameter("reflexion", member_of(&Interface::rest, &Phong::reflexion)),
                   parameter("refraction", member_of(&Interface::rest, &Phong::refraction)),
                   parameter("ior", member_of(&Interface::rest, &Phong::inside_ior)),
                   parameter("outside_ior", member_of(&Interface::rest, &Phong::outside_ior)),
                   parameter("absorption"),
                   parameter("priority")};

    InterfaceBsdf at(const ShadingPoint& p) const { return {phong(p), p.front, fresnel}; }
    bool mirrors() const { return rest.reflexion > 0 || rest.refraction > 0; }
    // As of Glass. What has a priority knows what it touches, and needs no second index.
    std::optional<float> medium_ior(bool has_priority) const
    {
        if (!(rest.refraction > 0)) return {};
        return rest.inside_ior / (has_priority ? 1 : rest.outside_ior);
    }
    Phong phong(const ShadingPoint& p) const
    {
        Phong all = rest;
        all.diffuse = p.base(base);
        if (p.eta > 0) all.inside_ior = p.inner_over_outer(1), all.outside_ior = 1;
        return all;
    }
};

}  // namespace lancer
