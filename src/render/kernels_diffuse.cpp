#include "render/diffuse_batch.h"
#include "render/kernel.h"

namespace lancer {

void DiffuseKernel::render(const View& view, const Accelerator& accel, const Camera& camera,
                           const KernelSettings& settings, const Path& path, const DiffuseScene& scene, Film& film,
                           Tile tile, SampleRange samples, Workspace& w, Counters& counters)
{
    render_tile(view, accel, camera, settings, DiffusePath{path, scene}, film, tile, samples, w, counters,
                NoListener{});
}

}  // namespace lancer
