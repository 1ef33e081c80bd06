// What the samples of a batch bring to alpha, beside whether their camera rays hit something: the background behind
// smooth glass, and the shadows on what catches them (MaterialTraits::catches_shadows).
#pragma once

#include <vector>

#include "geometry/accel.h"
#include "integrators/path/light_sampling.h"

namespace lancer {

struct AlphaSample {
    double through = 0;  // transmittance up to the hidden background, as a luminance
    double caught = 0;   // likewise up to what catches shadows
    // Direct light that such a surface would reflect if nothing were in the way, and the part of it that is blocked.
    double light = 0, blocked = 0;
};

class AlphaSamples {
public:
    void begin(size_t slots) { samples_.assign(slots, {}), rays_.clear(), caught_.clear(); }
    const AlphaSample& of(size_t slot) const { return samples_[slot]; }

    void add_background(const PathState& s) { samples_[s.slot].through += luminance_of(s.throughput); }

    // Requests shadow rays from a surface that catches shadows: to a sampled light, and where the BSDF's sample sees
    // the sky, of which light sampling leaves a part to it. The weights of both depend on directions alone, not on what
    // is in the way.
    template <class V>
    void catch_shadow(const V& view, const PathState& s, const Surface& surface, const Sampler& sampler)
    {
        samples_[s.slot].caught += luminance_of(s.throughput);
        const Frame frame(surface.ns);
        const Vec3 wo = frame.to_local(-s.ray.dir);
        view.with_bsdf(surface, sampler, s.depth, [&](const auto& bsdf) {
            if (bsdf.only_delta()) return;
            catch_light(view, s, surface, frame, wo, bsdf, sampler);
            catch_sky(view, s, surface, frame, wo, bsdf, sampler);
        });
    }
    // Traces what has been requested. Returns how many rays that were.
    size_t trace(const Accelerator& accel)
    {
        if (rays_.empty()) return 0;
        occluded_.resize(rays_.size());
        accel.any(rays_, occluded_);
        for (size_t i = 0; i < caught_.size(); ++i)
            if (occluded_[i]) samples_[caught_[i].slot].blocked += caught_[i].light;
        const size_t traced = rays_.size();
        rays_.clear(), caught_.clear();
        return traced;
    }

private:
    static double luminance_of(Color c) { return luminance(double{c.r}, double{c.g}, double{c.b}); }

    template <class V, class B>
    void catch_light(const V& view, const PathState& s, const Surface& surface, const Frame& frame, Vec3 wo,
                     const B& bsdf, const Sampler& sampler)
    {
        if (view.scene.lights.pick.empty()) return;
        const auto light = view.sample_light_by_power(
            surface, [&] { return sampler.get1(s.depth, Dim::light); }, sampler.get2(s.depth, Dim::light),
            bsdf.transmits());
        if (!light) return;
        const Vec3 wi = frame.to_local(light->wi);
        if (!sides_agree(surface, light->wi, wi)) return;
        const BsdfValue f = bsdf.eval(wo, wi);
        const float weight = light->infinite && !light->delta ? power_heuristic(light->pdf, f.pdf) : 1;
        Ray ray = shadow_ray(surface, *light);
        view.set_alpha_key(ray, sampler, s.depth, Dim::shadow_alpha);
        request(s, ray, sampled_light(s.throughput, f.f_cos, light->radiance, weight / light->pdf));
    }
    template <class V, class B>
    void catch_sky(const V& view, const PathState& s, const Surface& surface, const Frame& frame, Vec3 wo,
                   const B& bsdf, const Sampler& sampler)
    {
        const auto b = bsdf.sample(wo, sampler.get1(s.depth, Dim::bsdf), sampler.get2(s.depth, Dim::bsdf));
        if (!b || b->delta) return;
        const Vec3 wi = normalize(frame.to_world(b->wi));
        if (!sides_agree(surface, wi, b->wi)) return;
        const float pdf = pdf_environment(view.scene, surface.ns, wi);
        const float weight = pdf > 0 ? power_heuristic(b->pdf, pdf) : 1;
        Ray ray{.org = ray_origin(surface, wi), .dir = wi};
        view.set_alpha_key(ray, sampler, s.depth + 1, Dim::alpha);
        request(s, ray, s.throughput * b->weight * view.environment(wi) * weight);
    }
    void request(const PathState& s, const Ray& ray, Color if_unoccluded)
    {
        const double brought = luminance_of(if_unoccluded);
        if (!(brought > 0) || !is_traceable(ray)) return;
        samples_[s.slot].light += brought;
        rays_.push_back(ray);
        rays_.back().time = s.ray.time;
        caught_.push_back({s.slot, brought});
    }

    struct Caught {
        uint32_t slot = 0;
        double light = 0;
    };
    std::vector<AlphaSample> samples_;  // of each slot
    std::vector<Ray> rays_;
    std::vector<Caught> caught_;  // parallel to rays_
    std::vector<uint8_t> occluded_;
};

}  // namespace lancer
