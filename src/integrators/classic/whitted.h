// Recursive ray tracing: at each vertex the direct light of every light, the reflected and the refracted ray. Whitted,
// "An Improved Illumination Model for Shaded Display", CACM 23(6), 1980.
#pragma once

#include "integrators/classic/classic.h"

namespace lancer {

struct Whitted : Classic {
    static constexpr IntegratorKind kind = IntegratorKind::whitted;
    static constexpr bool branches = true;

    template <class V>
    void hit(const V& view, const PathState& s, const Surface& surface, const Sampler& sampler,
             PathActions& actions) const
    {
        add_emission(view, s, surface, DirectLight{}, LightParts{}, actions);
        if (s.last) return;
        const Vec2 u = sampler.get2(s.depth, Dim::roulette);
        with_vertex(view, s, surface, sampler, [&](const auto& vertex) {
            vertex.illuminate(1, actions);
            follow(vertex.reflection(), 0, u.x, actions);
            follow(vertex.refraction(), 1, u.y, actions);
        });
    }

private:
    // child: 0 or 1. The branch number identifies the path of reflections and refractions.
    void follow(std::optional<PathState> n, uint32_t child, float u, PathActions& actions) const
    {
        if (!n || !stays(*n, u)) return;
        n->branch = 2 * n->branch + child;
        n->ray.key ^= child;
        n->last = is_last(*n);
        actions.next(*n);
    }
    // Whether a branch is followed, by Russian roulette.
    bool stays(PathState& n, float u) const
    {
        const float part = max_component(n.throughput) * n.eta_scale;
        if (!(part < least_part)) return true;
        if (legacy || !(u * least_part < part)) return false;
        n.throughput *= least_part / part;
        return true;
    }
};

}  // namespace lancer
