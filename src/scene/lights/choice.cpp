#include "scene/lights/choice.h"

#include <algorithm>
#include <optional>

namespace lancer {
namespace {

// Selects a light at infinity; else u is remapped to [0, 1) for the tree.
std::optional<LightTree::Choice> far_away(const LightTable& table, double& u)
{
    for (const uint32_t id : table.far) {
        const float probability = table.pick.probability(id);
        const auto p = static_cast<double>(probability);
        if (u < p) return LightTree::Choice{id, probability};
        u -= p;
    }
    if (!(table.tree_share > 0)) return LightTree::Choice{};
    u = std::min(u / table.tree_share, 1 - 0x1p-53);
    return {};
}

}  // namespace

LightTree::Choice choose_light(const LightTable& table, Vec3 point, Vec3 normal, double u)
{
    if (!table.tree) {
        const uint32_t id = table.pick.size() == 1 ? 0 : table.pick.sample(u);
        return {id, table.pick.probability(id)};
    }
    if (const auto far = far_away(table, u)) return *far;
    LightTree::Choice c = table.tree->choose(point, normal, u);
    c.probability *= static_cast<float>(table.tree_share);
    return c;
}

std::array<LightTree::Choice, float_lanes> choose_by_tree(const LightTable& table, const Vec3x8& points,
                                                          const Vec3x8& normals,
                                                          const std::array<double, float_lanes>& u, uint32_t lanes)
{
    std::array<LightTree::Choice, float_lanes> choices{};
    std::array<double, float_lanes> rest = u;
    uint32_t near = lanes;
    for_each_lane(lanes, [&](uint32_t i) {
        const auto far = far_away(table, rest[i]);
        if (!far) return;
        choices[i] = *far;
        near &= ~(1u << i);
    });
    table.tree->choose(points, normals, rest, near, choices);
    for_each_lane(near, [&](uint32_t i) { choices[i].probability *= static_cast<float>(table.tree_share); });
    return choices;
}

float probability_of(const LightTable& table, uint32_t id, Vec3 point, Vec3 normal)
{
    if (!table.tree) return table.pick.probability(id);
    if (!(table.tree_share > 0)) return 0;
    return table.tree->probability(id, point, normal) * static_cast<float>(table.tree_share);
}

}  // namespace lancer
