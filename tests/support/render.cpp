#include "support/render.h"

namespace lancer {

std::vector<AnyIntegrator> all_integrators()
{
    std::vector<AnyIntegrator> all;
    for (size_t i = 0; i < enum_names<IntegratorKind>.size(); ++i)
        all.push_back(make_integrator({.integrator = static_cast<IntegratorKind>(i)}));
    return all;
}

Rendered render(const SceneDescription& d, const RenderRequest& r)
{
    std::optional<Scene> scene;
    with_threads(r.threads, [&] { scene = build_scene(d, r.images); });
    return render(*scene, d, r);
}

Rendered render(const Scene& scene, const SceneDescription& d, const RenderRequest& r)
{
    Rendered out{Film(r.width, r.height, r.crop.value_or(Tile{0, 0, r.width, r.height})), {}};
    out.film.keep_aovs(layout_of(r.aovs));
    if (r.sets) out.film.keep_sets(*r.sets);
    if (r.settings.kernel.stop != StopRule::never) out.film.wanted.resize(out.film.pixels.size());
    with_threads(r.threads, [&] {
        const Renderer renderer(Scene(scene), r.settings);
        const Camera camera = camera_of(d, renderer.scene(), r.width, r.height);
        const std::vector<Tile> tiles = make_tiles(out.film.crop, r.tile);
        const auto pass = [&](SampleRange samples) {
            if (!r.traces_open_sky) return renderer.pass(camera, out.film, tiles, samples).counters;
            SamplingPlan plan = *renderer.plan(camera, r.width, r.height);
            plan.background_only.clear();
            const TileKernel kernel = make_tile_kernel(renderer.scene(), renderer.accelerator(), r.settings.integrator,
                                                       r.settings.kernel, renderer.kernel_choice());
            Workspace w;
            Counters counters;
            for (const Tile& tile : tiles) kernel(plan, camera, out.film, tile, samples, w, counters);
            return counters;
        };
        uint32_t begin = 0;
        for (const uint32_t n : r.spp) {
            out.counters += pass({begin, begin + n});
            begin += n;
        }
    });
    return out;
}

}  // namespace lancer
