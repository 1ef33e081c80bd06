// Sweeps beside rows N of the stability matrix.
#include "stability/sweep.h"

namespace lancer::stability {

std::vector<Sweep> scale_sweeps() { return {}; }

}  // namespace lancer::stability
