#include "scene/lights/emission_map.h"

#include <algorithm>
#include <numeric>

namespace lancer {
namespace {

constexpr float last_below_1 = 1 - 0x1p-24f;

// Replaces weights by their cumulative sums, the last of which is 1.
void accumulate(const double* weights, uint32_t count, float* sums)
{
    const double total = std::accumulate(weights, weights + count, 0.0);
    double sum = 0;
    for (uint32_t i = 0; i < count; ++i) sums[i] = static_cast<float>((sum += weights[i]) / total);
    sums[count - 1] = 1;
}

struct Cell {
    uint32_t index;
    float part;  // in [0, 1)
    float probability;
};
// The first sum above u. Without branches, which could not be predicted. count: a power of two.
Cell cell_at(const float* sums, uint32_t count, float u)
{
    uint32_t index = 0;
    for (uint32_t step = count / 2; step > 0; step /= 2)
        index += step * static_cast<uint32_t>(sums[index + step - 1] <= u);
    const float below = index == 0 ? 0 : sums[index - 1], probability = sums[index] - below;
    return {index, std::min((u - below) / probability, last_below_1), probability};
}
float share_of(const float* sums, uint32_t index) { return sums[index] - (index == 0 ? 0 : sums[index - 1]); }

}  // namespace

EmissionMap::EmissionMap(const std::vector<double>& weights, uint32_t side)
    : in_row_(weights.size()), rows_(side), side_(side)
{
    std::vector<double> of_rows(side);
    for (uint32_t y = 0; y < side; ++y) {
        const double* const row = &weights[size_t{y} * side];
        accumulate(row, side, &in_row_[size_t{y} * side]);
        of_rows[y] = std::accumulate(row, row + side, 0.0);
    }
    accumulate(of_rows.data(), side, rows_.data());
}

EmissionMap::Place EmissionMap::sample(Vec2 u) const
{
    const Cell y = cell_at(rows_.data(), side_, u.y);
    const Cell x = cell_at(&in_row_[size_t{y.index} * side_], side_, u.x);
    const auto side = static_cast<float>(side_);
    const auto along = [&](const Cell& c) {
        return std::min((static_cast<float>(c.index) + c.part) / side, last_below_1);
    };
    return {{along(x), along(y)}, x.probability * y.probability * side * side};
}

float EmissionMap::density(Vec2 u) const
{
    const auto side = static_cast<float>(side_);
    const auto index = [&](float x) {
        return static_cast<uint32_t>(std::clamp(x * side, 0.0f, static_cast<float>(side_ - 1)));
    };
    const uint32_t y = index(u.y);
    return share_of(rows_.data(), y) * share_of(&in_row_[size_t{y} * side_], index(u.x)) * side * side;
}

double relative_variance(const std::vector<double>& weights)
{
    double sum = 0, squares = 0;
    for (const double w : weights) sum += w, squares += w * w;
    const auto count = static_cast<double>(weights.size());
    return sum > 0 ? squares * count / (sum * sum) - 1 : 0;
}

}  // namespace lancer
