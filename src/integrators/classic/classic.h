// Common parts of the classic integrators (whitted.h, random_decision.h): their settings, and a vertex of the
// illumination model of Whitted, "An Improved Illumination Model for Shaded Display", CACM 23(6), 1980: direct light, a
// reflected and a refracted ray. This vertex has an energy-conserving BSDF; legacy/classic.h has the original formulas.
#pragma once

#include <array>

#include "integrators/bias.h"
#include "integrators/legacy/classic.h"
#include "integrators/path/transport.h"
#include "materials/interface.h"

namespace lancer {

// A vertex with the Phong parameters of the point as a BSDF, so that its direct light is that of direct.h.
template <class V>
class ClassicVertex {
public:
    ClassicVertex(const V& view, const PathState& s, const Surface& surface, const Sampler& sampler)
        : view_(view),
          s_(s),
          surface_(surface),
          sampler_(sampler),
          phong_(view.phong(surface)),
          bsdf_(phong_, surface.front),
          frame_(surface.ns),
          wo_(frame_.to_local(-s.ray.dir))
    {
    }

    const InterfaceBsdf& bsdf() const { return bsdf_; }

    // The reflected and the refracted ray, if any.
    std::optional<PathState> reflection() const { return sent(reflected()); }
    std::optional<PathState> refraction() const { return sent(refracted()); }

    ClassicParts parts() const
    {
        const auto part = [](const std::optional<BsdfSample>& b) {
            return b ? max_component(b->weight) * b->eta * b->eta : 0;
        };
        const bool is_lit = !bsdf_.only_delta() || !is_black(phong_.ambient);
        return {is_lit ? phong_.diffusion : 0, part(reflected()), part(refracted())};
    }

    // Adds direct light times factor: each point and directional light, and one randomly selected light of the others.
    void illuminate(float factor, PathActions& actions) const
    {
        const Color throughput = s_.throughput * factor;
        actions.add(throughput * phong_.ambient * phong_.diffusion);
        if (bsdf_.only_delta()) return;
        const uint32_t key = view_.alpha_key(sampler_, s_.depth, Dim::shadow_alpha);
        const uint32_t deltas = view_.delta_lights();
        for (uint32_t i = 0; i < deltas; ++i) add_light(view_.delta_light(surface_, i), throughput, key + i, actions);
        add_light(view_.sample_extended_light(surface_, sampler_, s_.depth), throughput, key + deltas, actions);
        add_environment_seen(throughput, key + deltas + 1, actions);
    }

private:
    std::optional<BsdfSample> reflected() const
    {
        return wo_.z > 0 ? bsdf_.reflection(wo_) : std::optional<BsdfSample>();
    }
    std::optional<BsdfSample> refracted() const
    {
        return wo_.z > 0 ? bsdf_.refraction(wo_) : std::optional<BsdfSample>();
    }
    std::optional<PathState> sent(const std::optional<BsdfSample>& b) const
    {
        PathState n = s_;
        return send_on(view_, s_, n, surface_, frame_, b, sampler_) ? std::optional(n) : std::nullopt;
    }
    void add_light(const std::optional<LightSample>& light, Color throughput, uint32_t key, PathActions& actions) const
    {
        if (!light) return;
        const Vec3 wi = frame_.to_local(light->wi);
        if (!sides_agree(surface_, light->wi, wi)) return;
        const BsdfValue f = bsdf_.eval(wo_, wi);
        if (is_black(f.f_cos)) return;
        Ray ray = shadow_ray(surface_, *light);
        ray.key = key;
        const float weight = light->infinite && !light->delta ? power_heuristic(light->pdf, f.pdf) : 1;
        actions.tinted_shadow(ray, throughput * f.f_cos * light->radiance * (weight / light->pdf), light->radiance,
                              light->light);
    }
    // Samples the environment by the BSDF: a narrow highlight is rarely found by light sampling. Other lights are small
    // and left to light sampling.
    void add_environment_seen(Color throughput, uint32_t key, PathActions& actions) const
    {
        const Scene& scene = view_.scene;
        if (!scene.environment_map && !scene.background && is_black(scene.environment)) return;
        const float u = sampler_.get1(s_.depth, Dim::roulette);
        const auto b = bsdf_.sample(wo_, u, sampler_.get2(s_.depth, Dim::bsdf));
        if (!b || b->delta) return;
        const Vec3 wi = normalize(frame_.to_world(b->wi));
        if (!sides_agree(surface_, wi, b->wi)) return;
        const Color radiance = view_.environment(wi);
        if (is_black(radiance)) return;
        const float pdf = view_.pdf_extended_environment(surface_.ns, wi);
        const Ray ray{.org = ray_origin(surface_, wi), .dir = wi, .key = key};
        const float weight = pdf > 0 ? power_heuristic(b->pdf, pdf) : 1;
        actions.tinted_shadow(ray, throughput * b->weight * radiance * weight, radiance);
    }

    const V& view_;
    const PathState& s_;
    const Surface& surface_;
    const Sampler& sampler_;
    Phong phong_;
    InterfaceBsdf bsdf_;
    Frame frame_;
    Vec3 wo_;
};

// Transmittance of a shadow ray that crosses a surface without being bent: that of the boundary at this angle, seen
// from its optically thinner side. From inside glass the straight ray would often be totally reflected, whereas the
// refracted ray that it represents would have entered.
inline Color straight_through(const Phong& p, Vec3 wo)
{
    const InterfaceBsdf bsdf(p, p.inside_ior >= p.outside_ior);
    const auto b = wo.z > 0 ? bsdf.refraction(wo) : std::optional<BsdfSample>();
    return b ? b->weight * (b->eta * b->eta) : Color{};
}

// Settings of both integrators, and the parts that do not depend on how they follow rays.
struct Classic {
    // Biases compared with a path tracer.
    static constexpr std::array biases{
        IntegratorBias{
            "no_diffuse_bounces",
            "light goes from surface to surface by mirrors and smooth glass only, and none through translucent "
            "sheets; `ambient` of a material stands for the rest. What shines without being in the list of lights "
            "(planes, the far inside of half-open lamps) lights no diffuse surface"},
        IntegratorBias{"straight_shadows",
                       "light of lamps goes straight through what refracts, tinted and without caustics"}};

    uint32_t max_depth = 7;  // surface vertices, >= 1
    bool legacy = false;     // with the formulas of legacy/classic.h

    void take(const RenderSettings& settings)
    {
        if (settings.max_depth) max_depth = settings.max_depth;
        legacy = settings.legacy;
    }

    // Calls f with the vertex of the present mode.
    template <class V, class F>
    void with_vertex(const V& view, const PathState& s, const Surface& surface, const Sampler& sampler, F&& f) const
    {
        if (legacy)
            f(LegacyVertex<V>(view, s, surface, sampler, s.depth + 1 >= max_depth));
        else
            f(ClassicVertex<V>(view, s, surface, sampler));
    }
    // Calls f with the BSDF of a vertex, which no mode but the legacy one goes without.
    template <class V, class F>
    void with_bsdf(const V& view, const PathState& s, const Surface& surface, const Sampler& sampler, F&& f) const
    {
        f(ClassicVertex<V>(view, s, surface, sampler).bsdf());
    }
    // In legacy mode nothing is traced from the last vertex; else emission is still seen from it.
    bool is_last(const PathState& next) const { return next.depth >= max_depth; }

    // Transmittance of a surface for shadow rays.
    template <class V>
    Color through(const V& view, const Ray& ray, const Surface& surface) const
    {
        const Phong p = view.phong(surface);
        if (!(p.refraction > 0)) return {};
        return legacy ? p.diffuse * p.refraction : straight_through(p, Frame(surface.ns).to_local(-ray.dir));
    }
    bool is_spent(Color light) const { return legacy && !(max_component(light) > least_part); }

    template <class V>
    void miss(const V& view, const PathState& s, PathActions& actions) const
    {
        add_environment(view, s, DirectLight{}, LightParts{}, actions);
    }
};

}  // namespace lancer
