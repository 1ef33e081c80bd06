// Sweeps beside rows D of the stability matrix.
#include "stability/sweep.h"

namespace lancer::stability {

std::vector<Sweep> surface_sweeps() { return {}; }

}  // namespace lancer::stability
