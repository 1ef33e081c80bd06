#include "render/specialize.h"

namespace lancer {

TileKernel make_tile_kernel(const Scene& scene, const Accelerator& accel, const AnyIntegrator& integrator,
                            const KernelSettings& settings)
{
    return std::visit(
        [&]<class Integrator>(const Integrator& concrete) -> TileKernel {
            return [&](const PathPlan& plan, const Camera& camera, Film& film, Tile tile, SampleRange samples,
                       Workspace& w, Counters& counters) {
                Kernels<Integrator>::render(View{scene, plan}, accel, camera, settings, concrete, film, tile, samples,
                                            w, counters);
            };
        },
        integrator);
}

Color replay(const Scene& scene, const Accelerator& accel, const AnyIntegrator& integrator,
             const KernelSettings& settings, const PathPlan& plan, const Camera& camera, uint32_t width,
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
