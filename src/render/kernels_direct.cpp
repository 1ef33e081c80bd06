#include "integrators/direct.h"
#include "render/kernel.h"

namespace lancer {

template void render_tile<Direct>(const View&, const Accelerator&, const Camera&, const KernelSettings&, const Direct&,
                                  Film&, Tile, SampleRange, Workspace&, Counters&);

}  // namespace lancer
