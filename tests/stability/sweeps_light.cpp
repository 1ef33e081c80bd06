// Sweeps beside rows L of the stability matrix.
#include "stability/sweep.h"

namespace lancer::stability {

std::vector<Sweep> light_sweeps() { return {}; }

}  // namespace lancer::stability
