// The pixel loop for scenes of which there is a DiffuseScene. Only kernels_diffuse.cpp and kernels_textured.cpp include
// this.
#pragma once

#include "render/diffuse_batch.h"
#include "render/diffuse_direct.h"
#include "render/kernel.h"

namespace lancer {

template <bool looks_up>
void DiffuseKernel<looks_up>::render(const View& view, const Accelerator& accel, const Camera& camera,
                                     const KernelSettings& settings, const Path& path, const DiffuseScene& scene,
                                     Film& film, Tile tile, SampleRange samples, Workspace& w, Counters& counters)
{
    render_tile(view, accel, camera, settings, DiffusePath<looks_up>{path, scene}, film, tile, samples, w, counters,
                NoListener{});
}

}  // namespace lancer
