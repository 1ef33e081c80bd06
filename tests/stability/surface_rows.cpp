// Rows D of the stability matrix.
#include "stability/row.h"

namespace lancer::stability {

std::vector<Row> surface_rows() { return {}; }

}  // namespace lancer::stability
