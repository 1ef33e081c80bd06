#include "integrators/path.h"
#include "render/kernel.h"

namespace lancer {

template void render_tile<Path>(const View&, const Accelerator&, const Camera&, const KernelSettings&, const Path&,
                                Film&, Tile, SampleRange, Workspace&, Counters&);

}  // namespace lancer
