// Ambient occlusion: the unoccluded part of the hemisphere within the scene's radius. It depends on geometry alone and
// takes one shadow ray per sample. Pharr, Jakob, Humphreys, 4th ed., section 13.2.
#pragma once

#include "core/frame.h"
#include "core/sampler.h"
#include "core/warp.h"
#include "integrators/path_actions.h"
#include "scene/description/render_settings.h"

namespace lancer {

struct AmbientOcclusion {
    static constexpr IntegratorKind kind = IntegratorKind::ao;

    template <class V>
    void hit(const V& view, const PathState& s, const Surface& surface, const Sampler& sampler,
             PathActions& actions) const
    {
        const Vec3 wi =
            normalize(Frame(surface.ns).to_world(square_to_cosine_hemisphere(sampler.get2(s.depth, Dim::bsdf))));
        if (dot(wi, surface.side) <= 0) return;
        Ray ray{.org = ray_origin(surface, wi), .dir = wi};
        ray.t_max = std::max(1.0f, static_cast<float>(view.scene.bounds.radius()));
        view.set_alpha_key(ray, sampler, s.depth, Dim::shadow_alpha);
        actions.shadow(ray, {1, 1, 1});
    }
    template <class V>
    void miss(const V&, const PathState&, PathActions& actions) const
    {
        actions.add({1, 1, 1});
    }
};

}  // namespace lancer
