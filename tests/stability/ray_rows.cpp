// Rows R of the stability matrix.
#include "stability/row.h"

namespace lancer::stability {

std::vector<Row> ray_rows() { return {}; }

}  // namespace lancer::stability
