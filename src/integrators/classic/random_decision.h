// Whitted's model with one ray per hit: direct light, then either the reflected or the refracted ray, selected randomly
// and divided by its probability. Its mean is Whitted's picture, at a cost linear in the depth. Arvo and Kirk,
// "Particle Transport and Image Synthesis", SIGGRAPH 1990.
#pragma once

#include "integrators/classic/classic.h"

namespace lancer {

struct RandomDecision : Classic {
    static constexpr IntegratorKind kind = IntegratorKind::random_decision;

    template <class V>
    void hit(const V& view, const PathState& s, const Surface& surface, const Sampler& sampler,
             PathActions& actions) const
    {
        add_emission(view, s, surface, DirectLight{}, LightParts{}, actions);
        if (s.last) return;
        with_vertex(view, s, surface, sampler, [&](const auto& vertex) {
            // If the parts add up to less than 1, the path ends with the remaining probability.
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
        n->pdf = probability * (s.depth ? s.pdf : 1);  // probability of all decisions so far
        n->throughput /= probability;
        // Ends where Whitted ends a branch, so that the means agree.
        if (legacy && max_component(n->throughput) * n->pdf < least_part) return;
        n->last = is_last(*n);
        actions.next(*n);
    }
};

}  // namespace lancer
