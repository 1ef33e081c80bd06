// What media do to paths, whichever integrator makes them: the kernel calls it before and after hit() and miss(), in
// scenes that have media. Rays lose light on the way by Beer and Lambert's law, and surfaces inside a medium of higher
// priority are passed as if they were not there.
#pragma once

#include <limits>

#include "integrators/path_actions.h"
#include "integrators/view.h"

namespace lancer {

// No vertex: the ray goes on, its random numbers are not touched. But shadow rays stop there, so no light sampling can
// have found what lies beyond.
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

// A ray at a surface. Not a function around the integrator's hit(): the kernel would hold that twice, and scenes
// without media pay for it.
class MediaAtHit {
public:
    // Changes `s` and `surface` to what the integrator is to see. False if the surface is not there for the ray: then
    // that has been sent on, and nothing else is to happen here.
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
        rays_ = queue.next.size(), shadows_ = queue.shadows.size(), tinted_ = queue.tinted_shadows.size();
        return true;
    }
    // After the integrator: tells the rays that it sent on which media they are in.
    void leave(const View& view, const Surface& surface, Queue& queue) const
    {
        const std::vector<Medium>& media = view.scene.media;
        const auto medium_towards = [&](Vec3 w) { return dot(w, surface.side) < 0 ? at_.beyond : at_.here; };
        for (size_t i = rays_; i < queue.next.size(); ++i) queue.next[i].media = medium_towards(queue.next[i].ray.dir);
        for (size_t i = shadows_; i < queue.shadows.size(); ++i) {
            const Ray& ray = queue.shadow_rays[i];
            queue.shadows[i].radiance *= medium_towards(ray.dir).transmittance(media, ray.t_max);
        }
        for (size_t i = tinted_; i < queue.tinted_shadows.size(); ++i)
            queue.tinted_shadows[i].media = medium_towards(queue.tinted_shadows[i].ray.dir);
    }

private:
    Boundary at_;
    size_t rays_ = 0, shadows_ = 0, tinted_ = 0;  // that there were before
};

// The part of a shadow ray's light that goes on beyond a surface. `in` becomes what the ray is in there; through():
// what the integrator says of `surface`, which is changed before.
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

// Of a ray that left the scene.
inline void miss_in_media(const View& view, PathState& s)
{
    s.throughput *= s.media.transmittance(view.scene.media, std::numeric_limits<float>::infinity());
}

}  // namespace lancer
