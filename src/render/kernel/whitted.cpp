#include "integrators/classic/whitted.h"
#include "render/kernel/kernel.h"

namespace lancer {

template struct Kernels<Whitted>;

}  // namespace lancer
