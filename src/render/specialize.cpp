#include "render/specialize.h"

namespace lancer {

// Instantiated in kernels_path.cpp and kernels_direct.cpp, so that they compile side by side.
#define LANCER_KERNEL(Integrator)                                                                                    \
    extern template void render_tile<Integrator>(const View&, const Accelerator&, const Camera&,                     \
                                                 const KernelSettings&, const Integrator&, Film&, Tile, SampleRange, \
                                                 Workspace&, Counters&);
LANCER_KERNEL(Path)
LANCER_KERNEL(Direct)
#undef LANCER_KERNEL

TileKernel make_tile_kernel(const Scene& scene, const Accelerator& accel, const AnyIntegrator& integrator,
                            const KernelSettings& settings)
{
    return std::visit(
        [&](const auto& concrete) -> TileKernel {
            return [view = View{scene}, &accel, &concrete, &settings](const Camera& camera, Film& film, Tile tile,
                                                                      SampleRange samples, Workspace& w,
                                                                      Counters& counters) {
                render_tile(view, accel, camera, settings, concrete, film, tile, samples, w, counters);
            };
        },
        integrator);
}

Color replay(const Scene& scene, const Accelerator& accel, const AnyIntegrator& integrator,
             const KernelSettings& settings, const Camera& camera, uint32_t width, const SampleId& id,
             const PathListener& listener)
{
    Workspace w;
    Counters counters;
    w.slots.push_back(id);
    std::visit(
        [&](const auto& concrete) {
            trace_batch(View{scene}, accel, camera, width, settings, concrete, w, counters, listener);
        },
        integrator);
    return w.queue.radiance[0];
}

}  // namespace lancer
