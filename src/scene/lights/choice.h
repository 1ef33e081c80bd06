// Light selection: by power, or by a tree over lights with a position.
#pragma once

#include <array>

#include "scene/lights/light.h"
#include "scene/lights/tree.h"

namespace lancer {

// Selects a light for a point and its shading normal, or 0 if it is on no surface; u in [0, 1). Probability 0: no light
// reaches the point. The table must not be empty.
LightTree::Choice choose_light(const LightTable& table, Vec3 point, Vec3 normal, double u);

// The same for the lanes in `lanes` of eight points, if there is a tree; other lanes get probability 0.
std::array<LightTree::Choice, float_lanes> choose_by_tree(const LightTable& table, const Vec3x8& points,
                                                          const Vec3x8& normals,
                                                          const std::array<double, float_lanes>& u, uint32_t lanes);

// Probability with which choose_light() selects light `id` for that point.
float probability_of(const LightTable& table, uint32_t id, Vec3 point, Vec3 normal);

}  // namespace lancer
