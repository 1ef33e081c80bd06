// The vertex of the ray tracer that --legacy reproduces: Phong's formula with unnormalised coefficients, which may
// create energy; no Fresnel equations; lights without distance falloff, and shadow rays that do not end at them. The
// shading normal alone decides what is inside; instead of total reflection the ray continues along the surface.
#pragma once

#include "core/sampler.h"
#include "integrators/path_actions.h"

namespace lancer {

// A branch with a smaller part of the camera's radiance ends, as does a shadow ray with less light.
inline constexpr float least_part = 0.003f;

// Approximate weights of the ways in which light continues from a vertex.
struct ClassicParts {
    float diffusion, reflection, refraction;
    float sum() const { return diffusion + reflection + refraction; }
};

template <class V>
class LegacyVertex {
public:
    // last: no ray is continued, and the illumination replaces the others.
    LegacyVertex(const V& view, const PathState& s, const Surface& surface, const Sampler& sampler, bool last)
        : view_(view),
          s_(s),
          surface_(surface),
          sampler_(sampler),
          last_(last),
          phong_(view.phong(surface)),
          outwards_(surface.front ? surface.ns : -surface.ns),
          inside_(dot(s.ray.dir, outwards_) > 0)
    {
    }

    std::optional<PathState> reflection() const
    {
        if (last_ || phong_.reflexion == 0) return {};
        const Vec3 wi = mirrored();
        return sent(wi, phong_.specular * phong_.reflexion, ray_origin(surface_, wi));
    }
    std::optional<PathState> refraction() const
    {
        if (last_ || phong_.refraction == 0) return {};
        const Vec3 v = s_.ray.dir, n = inside_ ? -outwards_ : outwards_;
        const float r = inside_ ? phong_.inside_ior / phong_.outside_ior : phong_.outside_ior / phong_.inside_ior;
        const float c = -dot(n, v), root = std::sqrt(std::max(0.0f, 1 - r * r * (1 - c * c)));
        // A ray along the surface starts on the side from which it came.
        const Vec3 org = offset_origin(surface_.p, surface_.p_error, surface_.n, -surface_.n);
        return sent(normalize(v * r + n * (r * c - root)), phong_.diffuse * phong_.refraction, org);
    }

    ClassicParts parts() const
    {
        if (last_) return {1, 0, 0};
        return {phong_.diffusion, phong_.reflexion, phong_.refraction};
    }

    // Adds point and directional lights times factor. Highlights also appear for lights below the horizon if there is
    // no shadow.
    void illuminate(float factor, PathActions& actions) const
    {
        const Color throughput = s_.throughput * (factor * (last_ ? 1 : phong_.diffusion));
        if (is_black(throughput)) return;
        actions.add(throughput * phong_.ambient);
        const uint32_t key = view_.alpha_key(sampler_, s_.depth, Dim::shadow_alpha);
        uint32_t i = 0;
        for (const DeltaLight& any : view_.scene.delta_lights) {
            const UndimmedLight light =
                std::visit([&](const auto& l) { return l.undimmed(surface_.p, view_.scene.normalisation.scale); }, any);
            add_light(light.infinite ? light.way : normalize(light.way), light.color, throughput, key + i++, actions);
        }
    }

private:
    Vec3 mirrored() const { return s_.ray.dir - outwards_ * (2 * dot(s_.ray.dir, outwards_)); }
    std::optional<PathState> sent(Vec3 wi, Color weight, Vec3 org) const
    {
        PathState n = s_;
        n.ray = {.org = org, .dir = wi};
        view_.set_alpha_key(n.ray, sampler_, n.depth + 1, Dim::alpha);
        n.throughput *= weight;
        n.normal = surface_.ns;
        n.cone.width += n.cone.spread * surface_.t;
        ++n.depth;
        return n;
    }
    void add_light(Vec3 wi, Color light, Color throughput, uint32_t key, PathActions& actions) const
    {
        const float diffuse = std::max(0.0f, dot(wi, outwards_)), b = dot(mirrored(), wi);
        const float highlight = b < 0 ? 0 : std::pow(b, phong_.shininess);
        const Color seen = throughput * light * (phong_.diffuse * diffuse + phong_.specular * highlight);
        if (is_black(seen)) return;
        if (!(max_component(light) > least_part)) return actions.add(seen);
        actions.tinted_shadow({.org = ray_origin(surface_, wi), .dir = wi, .key = key}, seen, light);
    }

    const V& view_;
    const PathState& s_;
    const Surface& surface_;
    const Sampler& sampler_;
    bool last_;
    Phong phong_;
    Vec3 outwards_;
    bool inside_;
};

}  // namespace lancer
