// What media do to paths, whichever integrator makes them: the kernel calls it around hit() and miss(), in scenes that
// have media. Rays lose light on the way by Beer and Lambert's law, and surfaces inside a medium of higher priority are
// passed as if they were not there.
#pragma once

#include <limits>

#include "integrators/steps.h"
#include "integrators/view.h"

namespace lancer {

// No vertex: the ray goes on, its random numbers are not touched. But shadow rays stop there, so no light sampling can
// have found what lies beyond.
inline State passed(const State& s, const Surface& surface, const MediumStack& beyond)
{
    State n = s;
    n.ray.org = ray_origin(surface, s.ray.dir);
    n.cone.width += s.cone.spread * surface.t;
    n.specular = true;
    n.light_sampled = false;
    n.media = beyond;
    return n;
}

// hit(): calls the integrator's with `s` and `surface`, which are changed before.
template <class F>
void hit_in_media(const View& view, State& s, Surface& surface, Queue& queue, Steps& steps, const F& hit)
{
    const std::vector<Medium>& media = view.scene.media;
    const Boundary c = cross(media, s.media, view.scene.traits[surface.material].medium, surface.front);
    s.throughput *= c.here.transmittance(media, surface.t);
    if (c.absent) return steps.next(passed(s, surface, c.beyond));
    surface.eta = c.eta;
    const size_t rays = queue.next.size(), shadows = queue.shadows.size(), tinted = queue.tinted_shadows.size();
    hit();
    const auto medium_towards = [&](Vec3 w) { return dot(w, surface.side) < 0 ? c.beyond : c.here; };
    for (size_t i = rays; i < queue.next.size(); ++i) queue.next[i].media = medium_towards(queue.next[i].ray.dir);
    for (size_t i = shadows; i < queue.shadows.size(); ++i) {
        const Ray& ray = queue.shadow_rays[i];
        queue.shadows[i].radiance *= medium_towards(ray.dir).transmittance(media, ray.t_max);
    }
    for (size_t i = tinted; i < queue.tinted_shadows.size(); ++i)
        queue.tinted_shadows[i].media = medium_towards(queue.tinted_shadows[i].ray.dir);
}

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
inline void miss_in_media(const View& view, State& s)
{
    s.throughput *= s.media.transmittance(view.scene.media, std::numeric_limits<float>::infinity());
}

}  // namespace lancer
