#include "integrators/classic/random_decision.h"
#include "render/kernel/kernel.h"

namespace lancer {

template struct Kernels<RandomDecision>;

}  // namespace lancer
