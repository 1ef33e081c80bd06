#include "render/specialize.h"

#include "integrators/view.h"
#include "scene/wide_scene.h"

namespace lancer {
namespace {

// Calls f(kernel) with the WideKernel of a shading.
template <class F>
void with_wide_kernel(Shading shading, const F& f)
{
    switch (shading) {
        case Shading::plain:
            return f(WideKernel<Shading::plain>{});
        case Shading::textured:
            return f(WideKernel<Shading::textured>{});
        case Shading::any:
            return f(WideKernel<Shading::any>{});
    }
}

// Whether the film asks for what the scalar loop alone tells apart: layers of light, the background behind smooth
// glass, shadows that are caught.
bool needs_scalar_loop(const Film& film, const Scene& scene)
{
    return film.layers.size() > 0 || film.aov_layout.has(AovSum::caught) ||
           (film.aov_layout.has(AovSum::through) && scene.lets_through());
}

}  // namespace

KernelChoice choose_kernel(const Scene& scene, const AnyIntegrator& integrator, std::optional<Profile> wanted)
{
    const auto* path = std::get_if<Path>(&integrator);
    if (wanted == Profile::all || !path) return {};
    if (scene.has_constant_environment() && path->direct.always) return {};  // light sampling that the tables leave out
    std::optional<WideScene> wide = WideScene::of(scene);
    if (!wide) return {};
    KernelChoice choice{std::make_shared<const WideScene>(std::move(*wide))};
    choice.tiled = choice.wide;
    if (choice.wide->shading == Shading::plain && scene.has_sky() && path->learned_nee)
        choice.tiled = std::make_shared<const WideScene>(*WideScene::of(scene, Shading::textured));
    return choice;
}

TileKernel make_tile_kernel(const Scene& scene, const Accelerator& accel, const AnyIntegrator& integrator,
                            const KernelSettings& settings, const KernelChoice& choice)
{
    return std::visit(
        [&]<class Integrator>(const Integrator& concrete) -> TileKernel {
            if constexpr (std::is_same_v<Integrator, Path>)
                if (choice.wide)
                    return [&, choice](const SamplingPlan& plan, const Camera& camera, Film& film, Tile tile,
                                       SampleRange samples, Workspace& w, Counters& counters) {
                        if (needs_scalar_loop(film, scene))
                            return Kernels<Integrator>::render(View{scene, plan}, accel, camera, settings, concrete,
                                                               film, tile, samples, w, counters);
                        const WideScene& wide = choice.wide_for(plan);
                        with_wide_kernel(wide.shading, [&](auto kernel) {
                            kernel.render(View{scene, plan}, accel, camera, settings, concrete, wide, film, tile,
                                          samples, w, counters);
                        });
                    };
            return [&](const SamplingPlan& plan, const Camera& camera, Film& film, Tile tile, SampleRange samples,
                       Workspace& w, Counters& counters) {
                Kernels<Integrator>::render(View{scene, plan}, accel, camera, settings, concrete, film, tile, samples,
                                            w, counters);
            };
        },
        integrator);
}

void trace_pilot(const View& view, const Accelerator& accel, const Path& path, const KernelSettings& settings,
                 const KernelChoice& choice, const Camera& camera, uint32_t width, Workspace& w, Counters& counters,
                 const ArrivalListener& listener)
{
    if (!choice.wide) return Kernels<Path>::trace(view, accel, camera, width, settings, path, w, counters, listener);
    with_wide_kernel(choice.wide->shading, [&](auto kernel) {
        kernel.trace(view, accel, camera, width, settings, path, *choice.wide, w, counters, listener);
    });
}

Color replay(const Scene& scene, const Accelerator& accel, const AnyIntegrator& integrator,
             const KernelSettings& settings, const SamplingPlan& plan, const Camera& camera, uint32_t width,
             const SampleId& id, const PathListener& listener)
{
    return std::visit(
        [&]<class Integrator>(const Integrator& concrete) {
            return Kernels<Integrator>::replay(View{scene, plan}, accel, camera, width, settings, concrete, id,
                                               listener);
        },
        integrator);
}

}  // namespace lancer
