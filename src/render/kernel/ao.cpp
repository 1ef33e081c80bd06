#include "integrators/ao.h"
#include "render/kernel/kernel.h"

namespace lancer {

template struct Kernels<AmbientOcclusion>;

}  // namespace lancer
