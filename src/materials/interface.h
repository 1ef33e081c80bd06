// A surface after the classic illumination model, made to conserve energy: diffuse reflection, Phong's highlight in the
// normalised and reciprocal form of Lafortune and Willems ("Using the Modified Phong Reflectance Model for Physically
// Based Rendering", 1994), a mirror, and where it refracts a smooth boundary that splits light by the exact Fresnel
// equations. All four are scaled by one factor if together they would send back more than they get.
#pragma once

#include <optional>

#include "core/frame.h"
#include "core/warp.h"
#include "materials/bsdf.h"
#include "materials/fresnel.h"
#include "materials/phong.h"

namespace lancer {

class InterfaceBsdf {
public:
    // front: the path arrives from the side of the geometric normal; without fresnel what refracts reflects only what
    // is reflected totally.
    InterfaceBsdf(const Phong& p, bool front, bool fresnel = true)
        : diffuse_(p.diffuse * p.diffusion),
          gloss_(p.specular * p.diffusion),
          shininess_(p.shininess),
          fresnel_(fresnel)
    {
        refracts_ = p.refraction > 0;
        const float boundary = p.reflexion + p.refraction;
        mirror_ = p.specular * (refracts_ ? boundary : p.reflexion);
        if (refracts_) through_ = p.diffuse * boundary;
        eta_ = front ? p.inside_ior / p.outside_ior : p.outside_ior / p.inside_ior;
        const float most = max_component(
            diffuse_ + gloss_ +
            Color{std::max(mirror_.r, through_.r), std::max(mirror_.g, through_.g), std::max(mirror_.b, through_.b)});
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
    std::optional<BsdfSample> sample(Vec3 wo, float u, Vec2 v) const
    {
        if (wo.z <= 0) return {};
        const Fresnel f = boundary(wo);
        const Parts p = parts(f);
        if (!(p.sum() > 0)) return {};
        u *= p.sum();
        if (u >= p.diffuse + p.gloss) {
            const bool reflects = u < p.diffuse + p.gloss + p.mirror || !(p.through > 0);
            BsdfSample s = reflects ? reflected(wo, f) : refracted(wo, f);
            s.pdf = (reflects ? p.mirror : p.through) / p.sum();
            if (!(s.pdf > 0)) return {};
            s.weight /= s.pdf;
            return s;
        }
        const Vec3 wi = u < p.diffuse ? square_to_cosine_hemisphere(v) : sample_gloss(wo, v);
        if (wi.z <= 0) return {};
        const BsdfValue value = eval_smooth(wo, wi, p);
        if (!(value.pdf > 0)) return {};
        return BsdfSample{.wi = wi, .weight = value.f_cos / value.pdf, .pdf = value.pdf};
    }

    // Each of the two directions that light goes without spreading, as a sample that was chosen for certain; nothing
    // where there is none. wo: z > 0.
    std::optional<BsdfSample> reflection(Vec3 wo) const
    {
        const BsdfSample s = reflected(wo, boundary(wo));
        return is_black(s.weight) ? std::nullopt : std::optional(s);
    }
    std::optional<BsdfSample> refraction(Vec3 wo) const
    {
        if (!refracts_) return {};
        const BsdfSample s = refracted(wo, boundary(wo));
        return is_black(s.weight) ? std::nullopt : std::optional(s);
    }

private:
    // By how much light each lobe sends, about.
    struct Parts {
        float diffuse, gloss, mirror, through;
        float sum() const { return diffuse + gloss + mirror + through; }
    };
    Parts parts(const Fresnel& f) const
    {
        return {max_component(diffuse_), max_component(gloss_), max_component(mirror_) * f.reflectance,
                max_component(through_) * (1 - f.reflectance)};
    }
    // What refracts not reflects all that its mirror gets.
    Fresnel boundary(Vec3 wo) const
    {
        if (!refracts_) return {1, 0};
        const Fresnel f = fresnel_dielectric(wo, eta_);
        return fresnel_ ? f : only_refracting(f);
    }

    BsdfSample reflected(Vec3 wo, const Fresnel& f) const
    {
        return {.wi = {-wo.x, -wo.y, wo.z}, .weight = mirror_ * f.reflectance, .pdf = 1, .delta = true};
    }
    BsdfSample refracted(Vec3 wo, const Fresnel& f) const
    {
        const float scale = 1 / eta_;
        return {.wi = normalize(Vec3{-wo.x * scale, -wo.y * scale, -f.cos_t}),
                .weight = through_ * ((1 - f.reflectance) * scale * scale),
                .pdf = 1,
                .delta = true,
                .eta = eta_};
    }
    // Around the mirror direction, density (n + 1) / (2 pi) cos^n.
    Vec3 sample_gloss(Vec3 wo, Vec2 v) const
    {
        const float cos = std::pow(1 - v.x, 1 / (shininess_ + 1)), sin = std::sqrt(std::max(0.0f, 1 - cos * cos));
        const SinCos phi = sin_cos_2pi(v.y);
        return Frame({-wo.x, -wo.y, wo.z}).to_world({sin * phi.cos, sin * phi.sin, cos});
    }
    BsdfValue eval_smooth(Vec3 wo, Vec3 wi, const Parts& p) const
    {
        const float pdf_diffuse = pdf_cosine_hemisphere(wi.z);
        BsdfValue f{diffuse_ * pdf_diffuse, p.diffuse / p.sum() * pdf_diffuse};
        const float cos = wo.z * wi.z - wo.x * wi.x - wo.y * wi.y;
        if (!(cos > 0) || !(p.gloss > 0)) return f;
        const float lobe = std::pow(cos, shininess_) * (1 / (2 * pi));
        f.f_cos += gloss_ * ((shininess_ + 2) * lobe * wi.z);
        f.pdf += p.gloss / p.sum() * (shininess_ + 1) * lobe;
        return f;
    }

    Color diffuse_, gloss_, mirror_, through_{};
    float shininess_, eta_;
    bool refracts_, fresnel_;
};
static_assert(Bsdf<InterfaceBsdf>);

}  // namespace lancer
