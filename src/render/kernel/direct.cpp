#include "integrators/path/direct.h"
#include "render/kernel/kernel.h"

namespace lancer {

template struct Kernels<Direct>;

}  // namespace lancer
