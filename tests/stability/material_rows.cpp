// Rows M of the stability matrix.
#include "stability/row.h"

namespace lancer::stability {

std::vector<Row> material_rows() { return {}; }

}  // namespace lancer::stability
