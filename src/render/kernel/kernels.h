// The compiled kernels, one for each integrator; render/specialize.cpp selects one. Defined in render/kernel/kernel.h
// and instantiated in render/kernel/NAME.cpp.
#pragma once

#include <functional>

#include "integrators/path/path.h"
#include "render/workspace.h"

namespace lancer {

class ArrivalListener;
struct View;       // integrators/view.h
struct WideScene;  // scene/wide_scene.h
enum class Shading;

// The events of one sample, for `lancer pixel` and tests. Every function must be set; the last two may be left out.
struct PathListener {
    std::function<void(const PathState&, const Hit&)> ray;         // a traced ray
    std::function<void(const PathState&, const Surface&)> vertex;  // its hit, if any
    std::function<void(const PathState&, Color)> added;            // radiance added at its end
    std::function<void(const Ray&, Color, bool)> shadow;  // a shadow ray, its radiance, whether it was occluded
    // Likewise one by way of a mirror: the part of it that was stopped, or the last one.
    std::function<void(const Ray&, Color, bool)> mirrored_shadow = [](const Ray&, Color, bool) {};
    // A medium scattered the path at that distance on its ray; of its hit there is then no event.
    std::function<void(const PathState&, float)> scattered = [](const PathState&, float) {};
};

// Kernels of Path with eight paths at a time, with the same bits, for scenes that WideScene supports. Each Shading is
// compiled in its own file: in one file the compiler would inline less.
template <Shading shading>
struct WideKernel {
    static void render(const View& view, const Accelerator& accel, const Camera& camera, const KernelSettings& settings,
                       const Path& path, const WideScene& scene, Film& film, Tile tile, SampleRange samples,
                       Workspace& w, Counters& counters);
    // As Kernels::trace(), for a pilot.
    static void trace(const View& view, const Accelerator& accel, const Camera& camera, uint32_t width,
                      const KernelSettings& settings, const Path& path, const WideScene& scene, Workspace& w,
                      Counters& counters, const ArrivalListener& listener);
};

template <class Integrator>
struct Kernels {
    // Adds samples [begin, end) of every pixel of a tile to the film and to its AOV sums, if any.
    static void render(const View& view, const Accelerator& accel, const Camera& camera, const KernelSettings& settings,
                       const Integrator& integrator, Film& film, Tile tile, SampleRange samples, Workspace& w,
                       Counters& counters);
    // Traces the samples in w.slots into w.queue.radiance. width: of the whole picture, pixels.
    template <class Listener>
    static void trace(const View& view, const Accelerator& accel, const Camera& camera, uint32_t width,
                      const KernelSettings& settings, const Integrator& integrator, Workspace& w, Counters& counters,
                      const Listener& listener);
    // Traces one sample with the bits of render() and returns its radiance. width: as in trace().
    static Color replay(const View& view, const Accelerator& accel, const Camera& camera, uint32_t width,
                        const KernelSettings& settings, const Integrator& integrator, const SampleId& id,
                        const PathListener& listener);
};

}  // namespace lancer
