#include "integrators/path/path.h"
#include "render/kernel/kernel.h"

namespace lancer {

template struct Kernels<Path>;

}  // namespace lancer
