// Rows A of the stability matrix.
#include "stability/row.h"

namespace lancer::stability {

std::vector<Row> film_rows() { return {}; }

}  // namespace lancer::stability
