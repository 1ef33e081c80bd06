#include "integrators/path.h"
#include "render/kernel.h"

namespace lancer {

template struct Kernels<Path>;

}  // namespace lancer
