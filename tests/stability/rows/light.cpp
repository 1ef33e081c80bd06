// Rows L of the stability matrix.
#include <algorithm>

#include "stability/groups.h"

namespace lancer::stability {

std::vector<Row> light_rows()
{
    std::vector<Row> all;
    for (auto* part : {light_shape_rows, many_light_rows, sky_rows, light_weight_rows, learned_light_rows})
        for (Row& row : part()) all.push_back(std::move(row));
    std::stable_sort(all.begin(), all.end(),
                     [](const Row& a, const Row& b) { return std::stoi(a.id.substr(1)) < std::stoi(b.id.substr(1)); });
    return all;
}

}  // namespace lancer::stability
