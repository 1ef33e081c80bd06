// Path tracing with next-event estimation and multiple importance sampling.
// Kajiya 1986; Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., chapter 13.
#pragma once

#include "integrators/path/scattering.h"

namespace lancer {

struct Path {
    static constexpr IntegratorKind kind = IntegratorKind::path;
    using TintedShadows = GlassShadows;

    uint32_t max_depth = 0;       // scattering vertices, at surfaces and in media; 1: direct light only; 0: no limit
    uint32_t roulette_depth = 5;  // vertices before Russian roulette by the throughput
    DirectLight direct{};
    LightParts parts{};
    bool split = true, roulette_by_pixel = true;  // allow splitting and adjoint-driven roulette
    bool learned_nee = true;                      // allow SamplingPlan::light_choice

    void take(const RenderSettings& settings)
    {
        max_depth = settings.max_depth;
        direct = DirectLight::of(settings);
        parts = LightParts(settings);
        split = settings.split;
        roulette_by_pixel = settings.roulette;
        learned_nee = settings.learned_nee;
    }

private:
    // Before its uses: its type is deduced.
    auto last() const
    {
        return [depth = max_depth](const PathState& n) { return n.depth == depth; };
    }

public:
    template <class V>
    void hit(const V& view, const PathState& s, const Surface& surface, const Sampler& sampler,
             PathActions& actions) const
    {
        trace_vertex(view, s, surface, sampler, direct, parts, roulette_depth, last(), actions);
    }
    // See trace_flight().
    template <class V>
    void fly(const V& view, PathState& s, const Flight& flight, float t, const Sampler& sampler,
             PathActions& actions) const
    {
        trace_flight(view, s, flight, t, sampler, direct, parts, roulette_depth, last(), actions);
    }
    template <class V>
    void miss(const V& view, const PathState& s, PathActions& actions) const
    {
        add_environment(view, s, direct, parts, actions);
    }
};

}  // namespace lancer
