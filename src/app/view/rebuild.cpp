#include "app/view/rebuild.h"

#include "app/view/camera_moves.h"
#include "scene/build/relight.h"

namespace lancer {
namespace {

// Whether a scene that was built for one serves the other: they differ in what the kernel alone is asked for.
bool needs_the_same_scene(RenderSettings a, const RenderSettings& b)
{
    a.spp = b.spp, a.seed = b.seed, a.max_depth = b.max_depth, a.sampler = b.sampler, a.filter = b.filter;
    a.split = b.split, a.roulette = b.roulette, a.learned_nee = b.learned_nee, a.replicates = b.replicates,
    a.given = b.given;
    return a == b;
}

}  // namespace

std::shared_ptr<const Renderer> renderer_for(const Sight& sight, const Sight& before, const Renderer& renderer,
                                             const RebuildSetup& setup)
{
    const bool is_empty = !(renderer.scene().bounds.extent() > 0);
    const bool fits = needs_the_same_scene(sight.settings, before.settings);
    const bool same_scene =
        fits && sight.scene == before.scene && !(is_empty && !is_same_view(sight.camera, before.camera));
    RenderSettings settings = sight.settings;
    settings.spp = before.settings.spp, settings.given = before.settings.given;
    if (same_scene && settings == before.settings) return nullptr;
    const RendererConfig config = configure(sight.settings, setup.batch);
    if (same_scene) return std::make_shared<const Renderer>(renderer, config);
    if (fits && !is_empty && sight.rest == before.rest) {
        Diagnostics none;
        return std::make_shared<const Renderer>(relit(renderer.scene(), *sight.scene, none), renderer, config);
    }
    SceneDescription description = *sight.scene;
    description.camera = sight.camera;
    Diagnostics diagnostics;
    SceneBuilder builder(description, sight.settings, diagnostics, setup.images, setup.memory);
    return std::make_shared<const Renderer>(std::move(builder), config, diagnostics, std::function<void()>{},
                                            &renderer);
}

}  // namespace lancer
