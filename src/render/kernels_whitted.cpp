#include "integrators/whitted.h"
#include "render/kernel.h"

namespace lancer {

template struct Kernels<Whitted>;

}  // namespace lancer
