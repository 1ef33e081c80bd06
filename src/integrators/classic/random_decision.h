// Recursive ray tracing with one ray for each hit: the light of the lamps, the reflected or the refracted ray, one of
// them by chance and divided by its probability, so that the mean is Whitted's picture at a cost that grows with the
// depth and not with its power. Arvo and Kirk, "Particle Transport and Image Synthesis", SIGGRAPH 1990.
#pragma once

#include "integrators/classic/classic.h"

namespace lancer {

struct RandomDecision : Classic {
    static constexpr const char* name = "random-decision";

    template <class V>
    void hit(const V& view, const PathState& s, const Surface& surface, const Sampler& sampler,
             PathActions& actions) const
    {
        add_emission(view, s, surface, DirectLight{}, LightParts{}, actions);
        if (s.last) return;
        with_vertex(view, s, surface, sampler, [&](const auto& vertex) {
            // Parts that leave something to 1 let the path end there with that probability.
            const ClassicParts p = vertex.parts();
            const float whole = std::max(1.0f, p.sum()), u = sampler.get1(s.depth, Dim::bsdf) * whole;
            if (u < p.diffusion) return vertex.illuminate(whole / p.diffusion, actions);
            if (u < p.diffusion + p.reflection) return follow(s, vertex.reflection(), p.reflection / whole, actions);
            if (u < p.sum()) follow(s, vertex.refraction(), p.refraction / whole, actions);
        });
    }

private:
    void follow(const PathState& s, std::optional<PathState> n, float probability, PathActions& actions) const
    {
        if (!n) return;
        n->pdf = probability * (s.depth ? s.pdf : 1);  // of all decisions so far
        n->throughput /= probability;
        // Where Whitted gives up a branch, so must its mean.
        if (legacy && max_component(n->throughput) * n->pdf < least_part) return;
        n->last = is_last(*n);
        actions.next(*n);
    }
};

}  // namespace lancer
