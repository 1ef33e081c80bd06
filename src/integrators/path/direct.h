// Direct illumination only: emission, and direct light at the first surface that is not specular, or where a medium
// scatters before it. Specular surfaces are followed.
#pragma once

#include "integrators/path/scattering.h"

namespace lancer {

struct Direct {
    static constexpr IntegratorKind kind = IntegratorKind::direct;
    using TintedShadows = GlassShadows;

    uint32_t max_depth = 0;       // surface vertices, specular ones included; 0: no limit
    uint32_t roulette_depth = 5;  // vertices before Russian roulette
    DirectLight direct{};
    LightParts parts{};

    void take(const RenderSettings& settings)
    {
        max_depth = settings.max_depth;
        direct = DirectLight::of(settings);
        parts = LightParts(settings);
    }

private:
    // Before its uses: its type is deduced.
    auto last() const
    {
        return [depth = max_depth](const PathState& n) { return !n.specular || n.depth == depth; };
    }

public:
    template <class V>
    void hit(const V& view, const PathState& s, const Surface& surface, const Sampler& sampler,
             PathActions& actions) const
    {
        trace_vertex(view, s, surface, sampler, direct, parts, roulette_depth, last(), actions);
    }
    // See trace_flight(): light that a medium scatters once.
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
