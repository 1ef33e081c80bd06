#include "render/estimators/choice_levels.h"

#include <algorithm>
#include <cmath>

namespace lancer {

// Cells and corner are powers of two and multiples of these, so that
// a few more rays seldom move them.
LightChoice make_grid(std::span<const Arrival> arrivals)
{
    constexpr double outside = 0.005;  // part of the places beyond each end of the grid
    std::vector<float> along(arrivals.size());
    const auto cut = static_cast<std::ptrdiff_t>(outside * static_cast<double>(along.size()));
    std::array<float, 3> low{}, high{};
    for (size_t axis = 0; axis < 3; ++axis) {
        std::transform(arrivals.begin(), arrivals.end(), along.begin(),
                       [&](const Arrival& a) { return a.p[static_cast<int>(axis)]; });
        const auto place = [&](std::ptrdiff_t i) {
            std::nth_element(along.begin(), along.begin() + i, along.end());
            return along[static_cast<size_t>(i)];
        };
        low[axis] = place(cut), high[axis] = place(static_cast<std::ptrdiff_t>(along.size()) - 1 - cut);
    }
    LightChoice grid;
    const float extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
    if (!(extent > 0)) return grid;
    // One more cell than fits, as the corner is rounded down.
    const float cell = std::exp2(std::ceil(std::log2(extent / (LightChoice::most_cells - 1))));
    grid.per_unit = 1 / cell;
    for (size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::floor(low[axis] / cell) * cell;
        const float cells = std::floor((high[axis] - low[axis]) / cell) + 1;
        grid.size[axis] = std::min(LightChoice::most_cells, static_cast<uint32_t>(cells));
    }
    grid.low = {low[0], low[1], low[2]};
    return grid;
}

}  // namespace lancer
