#include "integrators/direct.h"
#include "render/aov.h"
#include "render/kernel.h"

namespace lancer {

template void render_tile(const View&, const Accelerator&, const Camera&, const KernelSettings&, const Direct&, Film&,
                          Tile, SampleRange, Workspace&, Counters&, const NoListener&);
template void render_tile(const View&, const Accelerator&, const Camera&, const KernelSettings&, const Direct&, Film&,
                          Tile, SampleRange, Workspace&, Counters&, const AovListener&);

}  // namespace lancer
