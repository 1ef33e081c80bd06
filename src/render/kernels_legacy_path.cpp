#include "integrators/legacy_path.h"
#include "render/kernel.h"

namespace lancer {

template struct Kernels<LegacyPath>;

}  // namespace lancer
