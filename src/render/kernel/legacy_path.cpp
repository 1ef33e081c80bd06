#include "integrators/legacy/path.h"
#include "render/kernel/kernel.h"

namespace lancer {

template struct Kernels<LegacyPath>;

}  // namespace lancer
