#include "app/render/describe.h"

#include "app/specialisation.h"
#include "app/system_info.h"
#include "app/version.h"
#include "core/parallel.h"
#include "geometry/embree/embree.h"

namespace lancer {

RunStats::Context describe_context(const RenderOptions& options)
{
    return {.version = LANCER_VERSION,
            .embree = embree_version(),
            .parallel = parallel_version(),
            .compiler = compiler_text(),
            .build_type = LANCER_BUILD_TYPE,
            .instructions = instruction_text(),
            .cpu = cpu_model(),
            .command_line = options.command_line,
            .load_average = load_average()};
}

void describe_run(const RenderOptions& options, const Prepared& prepared, const Renderer& renderer, RunStats& stats)
{
    stats.context = describe_context(options);
    const Scene& scene = renderer.scene();
    stats.scene = {.file = options.picture.scene.file,
                   .content_hash = prepared.description.content_hash,
                   .triangles = scene.triangle_count(),
                   .meshes = scene.geometry.meshes.size(),
                   .instances = scene.geometry.instances.size(),
                   .spheres = scene.geometry.spheres.size(),
                   .planes = scene.geometry.planes.size(),
                   .lights = scene.lights.lights.size(),
                   .materials = scene.material_names.size(),
                   .accelerator_bytes = renderer.accelerator().stats().bytes,
                   .hidden_lights = prepared.hidden_lights,
                   .added_light = prepared.added.light,
                   .warnings = prepared.warnings,
                   .unused_features = unused_features_of(renderer, renderer.profile()),
                   .catches_shadows = options.background != BackgroundChoice::keep && scene.catches_shadows(),
                   .ignores_scattering = scene.ignores_scattering};
    if (prepared.added.view_s) stats.analyses.push_back({"view", *prepared.added.view_s});
    if (prepared.added.light_s) stats.analyses.push_back({"light", *prepared.added.light_s});
    for (const Scene::Analysis& a : scene.analyses) stats.analyses.push_back({a.name, a.seconds});
    if (!scene.delta_lights.empty()) stats.analyses.push_back({"hidden lights", prepared.hidden_lights_s});
}

}  // namespace lancer
