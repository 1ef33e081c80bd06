// The wide kernel. Only the files that instantiate one Shading each include it.
#pragma once

#include "render/kernel/kernel.h"
#include "render/wide/batch.h"
#include "render/wide/bsdf.h"
#include "render/wide/direct.h"
#include "render/wide/lights.h"
#include "render/wide/mirrors.h"
#include "render/wide/surfaces.h"

namespace lancer {

template <Shading shading>
void WideKernel<shading>::render(const View& view, const Accelerator& accel, const Camera& camera,
                                 const KernelSettings& settings, const Path& path, const WideScene& scene, Film& film,
                                 Tile tile, SampleRange samples, Workspace& w, Counters& counters)
{
    for_listener(view.scene, accel, camera, film, tile, w, [&](const auto& listener) {
        render_tile(view, accel, camera, settings, WidePath<shading>{path, scene}, film, tile, samples, w, counters,
                    listener);
    });
}

template <Shading shading>
void WideKernel<shading>::trace(const View& view, const Accelerator& accel, const Camera& camera, uint32_t width,
                                const KernelSettings& settings, const Path& path, const WideScene& scene, Workspace& w,
                                Counters& counters, const ArrivalListener& listener)
{
    trace_batch(view, accel, camera, width, settings, WidePath<shading>{path, scene}, w, counters, listener);
}

}  // namespace lancer
