// Selects the compiled kernel for a scene and an integrator; the only place that does so.
#pragma once

#include <functional>

#include "integrators/integrator.h"
#include "render/kernel/kernels.h"

namespace lancer {

// A kernel with its scene, accelerator and integrator. It is called once per tile, so type erasure costs nothing.
using TileKernel =
    std::function<void(const SamplingPlan&, const Camera&, Film&, Tile, SampleRange, Workspace&, Counters&)>;

// A kernel variant: by the tables of the scene that it reads.
struct KernelChoice {
    std::shared_ptr<const WideScene> wide{};  // null for Profile::all
    // For plans that choose tiles of the sky, which Shading::plain cannot sample; else the same.
    std::shared_ptr<const WideScene> tiled{};
    const WideScene& wide_for(const SamplingPlan& plan) const { return plan.light_choice.has_tiles ? *tiled : *wide; }
    Profile profile() const { return wide ? Profile::wide : Profile::all; }
};
// The most specialised kernel variant that supports a complete scene, or the requested one if it does. Building the
// tables reads every material and light: it is done once per scene.
KernelChoice choose_kernel(const Scene& scene, const AnyIntegrator& integrator, std::optional<Profile> wanted = {});

// All references must outlive the returned kernel.
TileKernel make_tile_kernel(const Scene& scene, const Accelerator& accel, const AnyIntegrator& integrator,
                            const KernelSettings& settings, const KernelChoice& choice);

// Traces the samples in w.slots into w.queue.radiance, as Kernels::trace().
void trace_pilot(const View& view, const Accelerator& accel, const Path& path, const KernelSettings& settings,
                 const KernelChoice& choice, const Camera& camera, uint32_t width, Workspace& w, Counters& counters,
                 const ArrivalListener& listener);

// Traces one sample with the bits of a render and returns its radiance. width: of the whole picture, pixels.
Color replay(const Scene& scene, const Accelerator& accel, const AnyIntegrator& integrator,
             const KernelSettings& settings, const SamplingPlan& plan, const Camera& camera, uint32_t width,
             const SampleId& id, const PathListener& listener);

}  // namespace lancer
