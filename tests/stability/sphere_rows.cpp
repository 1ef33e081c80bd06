// Rows P of the stability matrix.
#include "stability/row.h"

namespace lancer::stability {

std::vector<Row> sphere_rows() { return {}; }

}  // namespace lancer::stability
