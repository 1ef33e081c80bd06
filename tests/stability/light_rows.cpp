// Rows L of the stability matrix.
#include "stability/row.h"

namespace lancer::stability {

std::vector<Row> light_rows() { return {}; }

}  // namespace lancer::stability
