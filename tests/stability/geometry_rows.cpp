// Rows G of the stability matrix.
#include "stability/row.h"

namespace lancer::stability {

std::vector<Row> geometry_rows() { return {}; }

}  // namespace lancer::stability
