#include "integrators/ao.h"
#include "render/kernel.h"

namespace lancer {

template struct Kernels<AmbientOcclusion>;

}  // namespace lancer
