// By which lobes of a surface light comes to a path that leaves it in a given direction: what layers of lobes ask.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/frame.h"
#include "core/layers.h"
#include "integrators/path_actions.h"
#include "materials/bsdf.h"
#include "scene/surface.h"

namespace lancer {

// Calls f with the BSDF that the integrator scattered by at a vertex.
template <class V, class Integrator, class F>
void with_bsdf_of(const Integrator& integrator, const V& view, const PathState& s, const Surface& surface,
                  const Sampler& sampler, F&& f)
{
    if constexpr (requires { integrator.with_bsdf(view, s, surface, sampler, f); })
        integrator.with_bsdf(view, s, surface, sampler, std::forward<F>(f));
    else
        view.with_bsdf(surface, sampler, s.depth, std::forward<F>(f));
}

// The lobes of the light from a direction that is not of a delta lobe. wo, wi: local. Lobes on one side of a surface
// share a direction by their values, whichever of them it was sampled by: the density is that of all of them.
template <Bsdf B>
LobeShare smooth_share(const B& bsdf, Vec3 wo, Vec3 wi)
{
    if (wi.z < 0 && bsdf.transmits()) return {.rest = Lobe::transmission};
    wi.z = std::abs(wi.z);  // a direction along the surface may have been rounded to below it
    const Color some = bsdf.eval_diffuse(wo, wi), all = bsdf.eval(wo, wi).f_cos;
    const auto part = [](float x, float of) { return x > 0 ? std::min(1.0f, x / of) : 0; };
    return {{part(some.r, all.r), part(some.g, all.g), part(some.b, all.b)}, Lobe::glossy};
}
// Likewise of a delta lobe.
inline LobeShare delta_share(bool is_behind) { return {.rest = is_behind ? Lobe::transmission : Lobe::glossy}; }

}  // namespace lancer
