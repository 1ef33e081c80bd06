// Rows N of the stability matrix.
#include "stability/row.h"

namespace lancer::stability {

std::vector<Row> scale_rows() { return {}; }

}  // namespace lancer::stability
