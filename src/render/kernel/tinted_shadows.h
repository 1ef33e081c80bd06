// Tinted shadow rays: surfaces that transmit light attenuate a shadow ray instead of blocking it.
#pragma once

#include <concepts>

#include "geometry/accel.h"
#include "integrators/media.h"
#include "integrators/view.h"
#include "render/workspace.h"

namespace lancer {

// An integrator with tinted shadows, or what one names TintedShadows: through() is the transmittance of a surface;
// black ends the ray. is_spent() ends a ray whose light is almost used up; that light still arrives.
template <class Integrator>
concept TintsShadows = requires(const Integrator i, const View v, const Ray r, const Surface s, const Color light)
{
    {
        i.through(v, r, s)
        } -> std::same_as<Color>;
    {
        i.is_spent(light)
        } -> std::same_as<bool>;
};

// Traces the tinted shadow rays, all of them to the next surface in each round.
template <class Integrator, class Listener>
void trace_tinted_shadows(const View& view, const Accelerator& accel, const Integrator& integrator, Workspace& w,
                          Counters& counters, const Listener& listener)
{
    std::vector<Queue::TintedShadow>& shadows = w.queue.tinted_shadows;
    const bool has_media = !view.scene.media.empty();
    while (!shadows.empty()) {
        w.rays.clear();
        for (const Queue::TintedShadow& s : shadows) w.rays.push_back(s.ray);
        w.hits.resize(w.rays.size());
        accel.closest(w.rays, w.hits, Coherence::incoherent);
        counters.shadow_rays += w.rays.size();
        size_t kept = 0;
        for (size_t i = 0; i < shadows.size(); ++i) {
            Queue::TintedShadow s = shadows[i];
            if (w.hits[i]) {
                Surface surface = view.surface_at(s.ray, w.hits[i], {});
                const auto through = [&] {
                    return s.passes_sheets ? integrator.through(view, s.ray, surface) : Color{};
                };
                const Color part =
                    has_media ? shadow_in_media(view.scene, s.ray, s.media, surface, through) : through();
                s.radiance *= part;
                s.light *= part;
                if (is_black(s.radiance)) {
                    listener.shadow(s.ends, s.ray, s.radiance, true);
                    continue;
                }
                // The end point stays the same: the offset of the new origin is subtracted, or the ray could hit its
                // own light.
                const Vec3 org = ray_origin(surface, s.ray.dir);
                s.ray.t_max -= dot(org - s.ray.org, s.ray.dir);
                s.ray.org = org;
                if (!integrator.is_spent(s.light) && s.ray.t_max > s.ray.t_min) {
                    shadows[kept++] = s;
                    continue;
                }
            }
            if (has_media) s.radiance *= transmittance_along(view.scene, s.media, s.ray.org, s.ray.dir, s.ray.t_max);
            listener.shadow(s.ends, s.ray, s.radiance, false);
            w.queue.radiance[s.ends.slot] += s.radiance;
        }
        shadows.resize(kept);
    }
}

}  // namespace lancer
