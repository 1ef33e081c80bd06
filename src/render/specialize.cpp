#include "render/specialize.h"

namespace lancer {
namespace {

// Null if the scene is not so plain, or the path wants of it what is left out there.
std::shared_ptr<const WideScene> wide_scene_for(const Scene& scene, const Path& path)
{
    if (scene.has_constant_environment() && path.direct.always) return {};
    auto plain = WideScene::of(scene);
    return plain ? std::make_shared<const WideScene>(std::move(*plain)) : nullptr;
}

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

Profile profile_of(const Scene& scene, const AnyIntegrator& integrator, std::optional<Profile> wanted)
{
    const auto* path = std::get_if<Path>(&integrator);
    if (wanted == Profile::all || !path || !wide_scene_for(scene, *path)) return Profile::all;
    return Profile::wide;
}

TileKernel make_tile_kernel(const Scene& scene, const Accelerator& accel, const AnyIntegrator& integrator,
                            const KernelSettings& settings)
{
    const Profile profile = profile_of(scene, integrator, settings.profile);
    return std::visit(
        [&]<class Integrator>(const Integrator& concrete) -> TileKernel {
            if constexpr (std::is_same_v<Integrator, Path>)
                if (profile == Profile::wide)
                    return [&, plain = wide_scene_for(scene, concrete)](const SamplingPlan& plan, const Camera& camera,
                                                                        Film& film, Tile tile, SampleRange samples,
                                                                        Workspace& w, Counters& counters) {
                        render_eight(plain->shading)(View{scene, plan}, accel, camera, settings, concrete, *plain, film,
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
