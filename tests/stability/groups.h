// Groups D and L in parts, by what their rows are about.
#pragma once

#include "stability/row.h"

namespace lancer::stability {

// D
std::vector<Row> mirror_rows();      // D1, D2
std::vector<Row> dielectric_rows();  // D3 to D6
std::vector<Row> facet_rows();       // D7, D8, D11
std::vector<Row> furnace_rows();     // D9, D10

// L
std::vector<Row> light_shape_rows();    // L1 to L5, L12
std::vector<Row> many_light_rows();     // L6, L7
std::vector<Row> sky_rows();            // L8 to L10
std::vector<Row> light_weight_rows();   // L11
std::vector<Row> learned_light_rows();  // L13 to L15

}  // namespace lancer::stability
