// The compiled pixel loops, one for each integrator: what render/specialize.cpp picks from. Defined in
// render/kernel/kernel.h and instantiated in render/kernel/NAME.cpp.
#pragma once

#include <functional>

#include "integrators/path/path.h"
#include "render/workspace.h"
#include "scene/wide_scene.h"

namespace lancer {

// What happened to one sample, for a reader. Every function must be set.
struct PathListener {
    std::function<void(const PathState&, const Hit&)> ray;         // traced to its end
    std::function<void(const PathState&, const Surface&)> vertex;  // where it ended, if it hit
    std::function<void(const PathState&, Color)> added;            // radiance added there at once
    std::function<void(const Ray&, Color, bool)> shadow;  // a shadow ray, what it carries, whether it was occluded
};

// Path's, for scenes of which there is a WideScene that does or does not look things up: the same bits, eight paths
// at a time. Each stands in a file of its own, or the compiler would think both together too long to inline much.
template <Shading shading>
struct WideKernel {
    static void render(const View& view, const Accelerator& accel, const Camera& camera, const KernelSettings& settings,
                       const Path& path, const WideScene& scene, Film& film, Tile tile, SampleRange samples,
                       Workspace& w, Counters& counters);
};

template <class Integrator>
struct Kernels {
    // Adds samples [begin, end) of every pixel of a tile to the film, and to its sums for AOVs if it has any.
    static void render(const View& view, const Accelerator& accel, const Camera& camera, const KernelSettings& settings,
                       const Integrator& integrator, Film& film, Tile tile, SampleRange samples, Workspace& w,
                       Counters& counters);
    // Traces the samples in w.slots into w.queue.radiance. width: of the whole picture, pixels.
    static void trace(const View& view, const Accelerator& accel, const Camera& camera, uint32_t width,
                      const KernelSettings& settings, const Integrator& integrator, Workspace& w, Counters& counters);
    // Traces one sample as render() would, with the same bits, and returns its radiance. width: as of trace().
    static Color replay(const View& view, const Accelerator& accel, const Camera& camera, uint32_t width,
                        const KernelSettings& settings, const Integrator& integrator, const SampleId& id,
                        const PathListener& listener);
};

}  // namespace lancer
