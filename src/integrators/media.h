// Participating media, for all integrators: the kernel calls this before and after hit() and miss() in scenes that have
// media. Rays are attenuated by the Beer-Lambert law. Surfaces inside a medium of higher priority (nested dielectrics),
// and those of bodies that bend no light (Medium::is_bare), are skipped. What media scatter: path/scattering.h.
#pragma once

#include <limits>

#include "integrators/path_actions.h"
#include "scene/scene.h"
#include "scene/surface.h"

namespace lancer {

// The part of a ray that lies in a medium, from `near` to `far` along it.
struct Flight {
    const Medium* medium = nullptr;  // null: there is none
    float near = 0, far = 0;

    bool scatters() const { return medium && medium->scatters(); }
};

// Of a ray of length t that starts in `media`. dir: unit.
inline Flight flight_along(const Scene& scene, const MediumStack& media, Vec3 org, Vec3 dir, float t)
{
    const uint16_t id = media.current(scene.media).id;
    if (id != no_medium) return {&scene.media[id], 0, t};
    if (scene.fog.medium == no_medium) return {};
    const Stretch s = scene.fog.along(org, dir, t);
    return s.near < s.far ? Flight{&scene.media[scene.fog.medium], s.near, s.far} : Flight{};
}

// The part of the light along such a ray that is neither absorbed nor scattered.
inline Color transmittance_along(const Scene& scene, const MediumStack& media, Vec3 org, Vec3 dir, float t)
{
    const Flight f = flight_along(scene, media, org, dir, t);
    return f.medium ? transmittance(*f.medium, f.far - f.near) : Color{1, 1, 1};
}

// Continues a ray behind a skipped surface. It is no vertex. Where shadow rays pass such surfaces as well, what lies
// behind may have been found by light sampling; else shadow rays end there.
inline PathState passed(const Scene& scene, const PathState& s, const Surface& surface, const MediumStack& beyond)
{
    PathState n = s;
    n.ray.org = ray_origin(surface, s.ray.dir);
    n.ray.leaf_hint = surface.leaf_hint;
    n.cone.width += s.cone.spread * surface.t;
    n.mirror_distance = -(s.passed_distance() + surface.t);
    n.media = beyond;
    if (!scene.passes_bare) n.specular = true, n.light_sampled = false;
    // The rest of the flight has random numbers of its own; where nothing scatters the numbers stay the same.
    if (scene.scatters) ++n.branch;
    return n;
}

// Media at a surface. It is not a wrapper around the integrator's hit(): the kernel would then contain hit() twice, and
// scenes without media would be slower.
class MediaAtHit {
public:
    // Attenuates `s` and sets the relative index of `surface`. Returns false if the surface is skipped; the ray has
    // then been continued, and the integrator must not be called. attenuated: `s` has been.
    bool enter(const Scene& scene, PathState& s, Surface& surface, bool attenuated, const Queue& queue,
               PathActions& actions)
    {
        at_ = cross(scene.media, s.media, scene.traits[surface.material].medium, surface.front);
        if (!attenuated) s.throughput *= transmittance_along(scene, at_.here, s.ray.org, s.ray.dir, surface.t);
        if (at_.absent) {
            actions.next(passed(scene, s, surface, at_.beyond));
            return false;
        }
        surface.eta = at_.eta;
        before_ = QueueSizes(queue);
        return true;
    }
    // Called after the integrator: sets the media of the rays that it emitted and attenuates its shadow rays.
    void leave(const Scene& scene, const Surface& surface, Queue& queue) const
    {
        const auto medium_towards = [&](Vec3 w) -> const MediumStack& {
            return dot(w, surface.side) < 0 ? at_.beyond : at_.here;
        };
        for (size_t i = before_.next; i < queue.next.size(); ++i)
            queue.next[i].media = medium_towards(queue.next[i].ray.dir);
        for (size_t i = before_.shadows; i < queue.shadows.size(); ++i) {
            const Ray& ray = queue.shadow_rays[i];
            queue.shadows[i].radiance *=
                transmittance_along(scene, medium_towards(ray.dir), ray.org, ray.dir, ray.t_max);
        }
        for (size_t i = before_.tinted_shadows; i < queue.tinted_shadows.size(); ++i)
            queue.tinted_shadows[i].media = medium_towards(queue.tinted_shadows[i].ray.dir);
    }

private:
    Boundary at_;
    QueueSizes before_;  // before the integrator ran
};

// Whether a surface that a ray meets is skipped.
inline bool is_skipped(const Scene& scene, const MediumStack& media, const Surface& surface)
{
    return cross(scene.media, media, scene.traits[surface.material].medium, surface.front).absent;
}

// Transmittance of a tinted shadow ray across a surface and the medium before it. `in` becomes the medium behind.
// through(): the integrator's transmittance of `surface`, whose eta is set before the call.
template <class F>
Color shadow_in_media(const Scene& scene, const Ray& ray, MediumStack& in, Surface& surface, const F& through)
{
    const Boundary c = cross(scene.media, in, scene.traits[surface.material].medium, surface.front);
    const Color part = transmittance_along(scene, c.here, ray.org, ray.dir, surface.t);
    in = c.beyond;
    if (c.absent) return part;
    surface.eta = c.eta;
    return part * through();
}

// Attenuates a ray that left the scene.
inline void miss_in_media(const Scene& scene, PathState& s)
{
    s.throughput *= transmittance_along(scene, s.media, s.ray.org, s.ray.dir, std::numeric_limits<float>::infinity());
}

}  // namespace lancer
