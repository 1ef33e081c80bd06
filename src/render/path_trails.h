// What a path has met since it left the camera, as far as layers of lobes and alpha ask. It is kept beside the states
// of the paths, so that who does not ask has smaller states.
#pragma once

#include <utility>
#include <vector>

#include "integrators/lobe_share.h"

namespace lancer {

struct PathTrail {
    LobeShare lobes;          // by which it left its first vertex
    bool is_straight = true;  // from the camera through smooth glass alone, if anything, without a reflection
};

class PathTrails {
public:
    // For camera rays, one per state.
    void begin(size_t paths) { now_.assign(paths, {}), next_.clear(), shadow_shares_.clear(); }
    // The states that have been queued become those that are traced.
    void end_rays() { std::swap(now_, next_), next_.clear(), shadow_shares_.clear(); }

    const PathTrail& of(size_t state) const { return now_[state]; }
    const LobeShare& of_shadow(const ShadowEnds& ends) const { return shadow_shares_[ends.share]; }

    // Follows what the integrator has queued at a vertex, or behind a surface that it was not called for. state: index
    // of s; before: the queue without that; has_lobes: whether lobes are asked for.
    template <class V, class Integrator>
    void follow(const V& view, const Integrator& integrator, const PathState& s, size_t state, const Surface& surface,
                const Sampler& sampler, const QueueSizes& before, bool has_lobes, Queue& queue)
    {
        const PathTrail trail = now_[state];
        if (!has_lobes || trail.lobes.rest != Lobe::none)
            return add(s, surface, before, queue, trail, [&](Vec3, bool) { return trail.lobes; });
        with_bsdf_of(integrator, view, s, surface, sampler, [&](const auto& bsdf) {
            const Frame frame(surface.ns);
            const Vec3 wo = frame.to_local(-s.ray.dir);
            add(s, surface, before, queue, trail, [&](Vec3 dir, bool is_delta) {
                return is_delta ? delta_share(is_behind(surface, dir)) : smooth_share(bsdf, wo, frame.to_local(dir));
            });
        });
    }

    // Follows what has been queued in a medium that scatters, which counts as transmission.
    void follow_medium(size_t state, const QueueSizes& before, Queue& queue)
    {
        PathTrail trail = now_[state];
        if (trail.lobes.rest == Lobe::none) trail.lobes = {.rest = Lobe::transmission};
        trail.is_straight = false;
        next_.resize(next_.size() + queue.next.size() - before.next, trail);
        add_shadows(before, queue, [&](Vec3) { return trail.lobes; });
    }

private:
    static bool is_behind(const Surface& surface, Vec3 dir) { return dot(dir, surface.side) < 0; }

    // share(direction, whether of a delta lobe)
    template <class Share>
    void add(const PathState& s, const Surface& surface, const QueueSizes& before, Queue& queue, const PathTrail& trail,
             const Share& share)
    {
        for (size_t i = before.next; i < queue.next.size(); ++i) {
            const PathState& n = queue.next[i];
            PathTrail& added = next_.emplace_back(trail);
            if (n.depth == s.depth) continue;  // behind a surface that is not there
            added.is_straight = trail.is_straight && n.specular && is_behind(surface, n.ray.dir);
            added.lobes = share(n.ray.dir, n.specular);
        }
        add_shadows(before, queue, [&](Vec3 dir) { return share(dir, false); });
    }
    template <class Share>
    void add_shadows(const QueueSizes& before, Queue& queue, const Share& share)
    {
        const auto add_shadow = [&](Vec3 dir, ShadowEnds& ends) {
            ends.share = static_cast<uint32_t>(shadow_shares_.size());
            shadow_shares_.push_back(share(dir));
        };
        for (size_t i = before.shadows; i < queue.shadows.size(); ++i)
            add_shadow(queue.shadow_rays[i].dir, queue.shadows[i].ends);
        for (size_t i = before.tinted_shadows; i < queue.tinted_shadows.size(); ++i)
            add_shadow(queue.tinted_shadows[i].ray.dir, queue.tinted_shadows[i].ends);
        for (size_t i = before.mirrored_shadows; i < queue.mirrored_shadows.size(); ++i)
            add_shadow(queue.mirrored_shadows[i].ray.dir, queue.mirrored_shadows[i].ends);
    }

    std::vector<PathTrail> now_, next_;
    std::vector<LobeShare> shadow_shares_;  // of the shadow rays of this depth
};

}  // namespace lancer
