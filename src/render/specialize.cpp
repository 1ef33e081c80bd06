#include "render/specialize.h"

#include "render/aov.h"

namespace lancer {

// Instantiated in kernels_path.cpp and kernels_direct.cpp, so that they compile side by side.
#define LANCER_KERNEL(Integrator, Listener)                                                                 \
    extern template void render_tile(const View&, const Accelerator&, const Camera&, const KernelSettings&, \
                                     const Integrator&, Film&, Tile, SampleRange, Workspace&, Counters&,    \
                                     const Listener&);
LANCER_KERNEL(Path, NoListener)
LANCER_KERNEL(Path, AovListener)
LANCER_KERNEL(Direct, NoListener)
LANCER_KERNEL(Direct, AovListener)
#undef LANCER_KERNEL

TileKernel make_tile_kernel(const Scene& scene, const Accelerator& accel, const AnyIntegrator& integrator,
                            const KernelSettings& settings)
{
    return std::visit(
        [&](const auto& concrete) -> TileKernel {
            return [view = View{scene}, &accel, &concrete, &settings](const Camera& camera, Film& film, Tile tile,
                                                                      SampleRange samples, Workspace& w,
                                                                      Counters& counters) {
                const auto render = [&](const auto& listener) {
                    render_tile(view, accel, camera, settings, concrete, film, tile, samples, w, counters, listener);
                };
                if (film.aovs.empty()) return render(NoListener{});
                render(AovListener(view.scene, film, tile, w));
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
