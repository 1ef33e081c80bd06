// Shadow rays by way of mirrors: to the mirror, and from there to the light.
#pragma once

#include "geometry/accel.h"
#include "integrators/path/light_sampling.h"
#include "integrators/view.h"
#include "render/workspace.h"

namespace lancer {

// Turns a shadow ray at the mirror that it was sent to. Returns whether light comes by way of it.
template <class V>
bool turn_at_mirror(const V& view, const Hit& hit, Queue::MirroredShadow& s)
{
    if (view.scene.mirror_at(hit) != s.mirror) return false;
    const Surface at = view.surface_at(s.ray, hit, {});
    const auto b = view.with_bsdf(
        at, [] { return 0.5f; },
        [&](const auto& bsdf) {
            return bsdf.sample(Frame(at.ns).to_local(-s.ray.dir), 0.5f, {0.5f, 0.5f});
        });
    if (!b || is_black(b->weight)) return false;
    s.radiance *= b->weight;
    // Towards the light itself: of a direction that is reflected the rounding grows with the distance.
    if (!s.light.infinite) s.light.wi = normalize(s.light.point - at.origin);
    if (!(dot(s.light.wi, at.n) > 0)) return false;
    const Ray sent = s.ray;
    s.ray = shadow_ray(at, s.light);
    s.ray.key = sent.key, s.ray.time = sent.time;
    return is_traceable(s.ray);
}

template <class Listener>
void trace_mirrored_shadows(const View& view, const Accelerator& accel, Workspace& w, Counters& counters,
                            const Listener& listener)
{
    std::vector<Queue::MirroredShadow>& shadows = w.queue.mirrored_shadows;
    if (shadows.empty()) return;
    w.rays.clear();
    for (const Queue::MirroredShadow& s : shadows) w.rays.push_back(s.ray);
    w.hits.resize(w.rays.size());
    accel.closest(w.rays, w.hits, Coherence::incoherent);
    counters.shadow_rays += w.rays.size();
    w.rays.clear();
    size_t kept = 0;
    for (size_t i = 0; i < shadows.size(); ++i) {
        Queue::MirroredShadow s = shadows[i];
        const Ray sent = s.ray;
        if (!turn_at_mirror(view, w.hits[i], s)) {
            listener.mirrored_shadow(s.ends, sent, s.radiance, true);
            continue;
        }
        w.rays.push_back(s.ray);
        shadows[kept++] = s;
    }
    shadows.resize(kept);
    w.occluded.resize(kept);
    accel.any(w.rays, w.occluded);
    counters.shadow_rays += kept;
    for (size_t i = 0; i < kept; ++i) {
        const Queue::MirroredShadow& s = shadows[i];
        listener.mirrored_shadow(s.ends, s.ray, s.radiance, w.occluded[i]);
        if (!w.occluded[i]) w.queue.radiance[s.ends.slot] += s.radiance;
    }
}

}  // namespace lancer
