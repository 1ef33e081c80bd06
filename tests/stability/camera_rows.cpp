// Rows C of the stability matrix.
#include "stability/row.h"

namespace lancer::stability {

std::vector<Row> camera_rows() { return {}; }

}  // namespace lancer::stability
