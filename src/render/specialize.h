// From run-time facts to types: the one place that turns a scene and the name of an integrator into a compiled kernel.
#pragma once

#include <functional>

#include "integrators/integrator.h"
#include "render/kernel/kernels.h"

namespace lancer {

// One call per tile, so the type erasure costs nothing; below it only concrete types.
using TileKernel =
    std::function<void(const SamplingPlan&, const Camera&, Film&, Tile, SampleRange, Workspace&, Counters&)>;

// The version of the kernel that draws a complete scene: the plainest that covers it, or the one that is asked for.
Profile profile_of(const Scene& scene, const AnyIntegrator& integrator, std::optional<Profile> wanted = {});

// All references must outlive the kernel.
TileKernel make_tile_kernel(const Scene& scene, const Accelerator& accel, const AnyIntegrator& integrator,
                            const KernelSettings& settings);

// Traces one sample as a render would, with the same bits, and returns its radiance. width: of the whole
// picture, pixels.
Color replay(const Scene& scene, const Accelerator& accel, const AnyIntegrator& integrator,
             const KernelSettings& settings, const SamplingPlan& plan, const Camera& camera, uint32_t width,
             const SampleId& id, const PathListener& listener);

}  // namespace lancer
