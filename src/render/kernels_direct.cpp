#include "integrators/direct.h"
#include "render/kernel.h"

namespace lancer {

template struct Kernels<Direct>;

}  // namespace lancer
