// Participating media, for all integrators: the kernel calls this before and after hit() and miss() in scenes that have
// media. Rays are attenuated by the Beer-Lambert law. Surfaces inside a medium of higher priority (nested dielectrics)
// are skipped.
#pragma once

#include <limits>

#include "integrators/path_actions.h"
#include "integrators/view.h"

namespace lancer {

// Continues a ray behind a skipped surface. It is no vertex, so the random numbers stay the same. Shadow rays end at
// skipped surfaces, so light sampling cannot have found what lies behind.
inline PathState passed(const PathState& s, const Surface& surface, const MediumStack& beyond)
{
    PathState n = s;
    n.ray.org = ray_origin(surface, s.ray.dir);
    n.ray.leaf_hint = surface.leaf_hint;
    n.cone.width += s.cone.spread * surface.t;
    n.specular = true;
    n.light_sampled = false;
    n.media = beyond;
    return n;
}

// Media at a surface. It is not a wrapper around the integrator's hit(): the kernel would then contain hit() twice, and
// scenes without media would be slower.
class MediaAtHit {
public:
    // Attenuates `s` and sets the relative index of `surface`. Returns false if the surface is skipped; the ray has
    // then been continued, and the integrator must not be called.
    bool enter(const View& view, PathState& s, Surface& surface, const Queue& queue, PathActions& actions)
    {
        const std::vector<Medium>& media = view.scene.media;
        at_ = cross(media, s.media, view.scene.traits[surface.material].medium, surface.front);
        s.throughput *= at_.here.transmittance(media, surface.t);
        if (at_.absent) {
            actions.next(passed(s, surface, at_.beyond));
            return false;
        }
        surface.eta = at_.eta;
        before_ = QueueSizes(queue);
        return true;
    }
    // Called after the integrator: sets the media of the rays that it emitted and attenuates its shadow rays.
    void leave(const View& view, const Surface& surface, Queue& queue) const
    {
        const std::vector<Medium>& media = view.scene.media;
        const auto medium_towards = [&](Vec3 w) { return dot(w, surface.side) < 0 ? at_.beyond : at_.here; };
        for (size_t i = before_.next; i < queue.next.size(); ++i)
            queue.next[i].media = medium_towards(queue.next[i].ray.dir);
        for (size_t i = before_.shadows; i < queue.shadows.size(); ++i) {
            const Ray& ray = queue.shadow_rays[i];
            queue.shadows[i].radiance *= medium_towards(ray.dir).transmittance(media, ray.t_max);
        }
        for (size_t i = before_.tinted_shadows; i < queue.tinted_shadows.size(); ++i)
            queue.tinted_shadows[i].media = medium_towards(queue.tinted_shadows[i].ray.dir);
    }

private:
    Boundary at_;
    QueueSizes before_;  // before the integrator ran
};

// Transmittance of a tinted shadow ray across a surface and the medium before it. `in` becomes the medium behind.
// through(): the integrator's transmittance of `surface`, whose eta is set before the call.
template <class F>
Color shadow_in_media(const View& view, MediumStack& in, Surface& surface, const F& through)
{
    const std::vector<Medium>& media = view.scene.media;
    const Boundary c = cross(media, in, view.scene.traits[surface.material].medium, surface.front);
    const Color part = c.here.transmittance(media, surface.t);
    in = c.beyond;
    if (c.absent) return part;
    surface.eta = c.eta;
    return part * through();
}

// Attenuates a ray that left the scene.
inline void miss_in_media(const View& view, PathState& s)
{
    s.throughput *= s.media.transmittance(view.scene.media, std::numeric_limits<float>::infinity());
}

}  // namespace lancer
