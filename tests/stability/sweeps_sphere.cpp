// Sweeps beside rows P of the stability matrix.
#include "stability/sweep.h"

namespace lancer::stability {

std::vector<Sweep> sphere_sweeps() { return {}; }

}  // namespace lancer::stability
