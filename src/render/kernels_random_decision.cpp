#include "integrators/random_decision.h"
#include "render/kernel.h"

namespace lancer {

template struct Kernels<RandomDecision>;

}  // namespace lancer
