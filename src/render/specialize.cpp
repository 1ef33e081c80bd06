#include "render/specialize.h"

namespace lancer {
namespace {

auto* render_eight(Shading shading)
{
    switch (shading) {
        case Shading::plain:
            return WideKernel<Shading::plain>::render;
        case Shading::textured:
            return WideKernel<Shading::textured>::render;
        case Shading::any:
            break;
    }
    return WideKernel<Shading::any>::render;
}

}  // namespace

KernelChoice choose_kernel(const Scene& scene, const AnyIntegrator& integrator, std::optional<Profile> wanted)
{
    const auto* path = std::get_if<Path>(&integrator);
    if (wanted == Profile::all || !path) return {};
    if (scene.has_constant_environment() && path->direct.always) return {};  // light sampling that the tables leave out
    std::optional<WideScene> wide = WideScene::of(scene);
    if (!wide) return {};
    return {std::make_shared<const WideScene>(std::move(*wide))};
}

TileKernel make_tile_kernel(const Scene& scene, const Accelerator& accel, const AnyIntegrator& integrator,
                            const KernelSettings& settings, const KernelChoice& choice)
{
    return std::visit(
        [&]<class Integrator>(const Integrator& concrete) -> TileKernel {
            if constexpr (std::is_same_v<Integrator, Path>)
                if (choice.wide)
                    return [&, wide = choice.wide](const SamplingPlan& plan, const Camera& camera, Film& film,
                                                   Tile tile, SampleRange samples, Workspace& w, Counters& counters) {
                        render_eight(wide->shading)(View{scene, plan}, accel, camera, settings, concrete, *wide, film,
                                                    tile, samples, w, counters);
                    };
            return [&](const SamplingPlan& plan, const Camera& camera, Film& film, Tile tile, SampleRange samples,
                       Workspace& w, Counters& counters) {
                Kernels<Integrator>::render(View{scene, plan}, accel, camera, settings, concrete, film, tile, samples,
                                            w, counters);
            };
        },
        integrator);
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
