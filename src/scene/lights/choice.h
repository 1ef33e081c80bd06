// Which light is sampled from a place: by power, or by a tree over those that are somewhere.
#pragma once

#include <array>

#include "scene/lights/light.h"
#include "scene/lights/tree.h"

namespace lancer {

// For a place and the shading normal there. u in [0, 1). Probability 0: none that sends light there. Not where there
// are no lights.
LightTree::Choice choose_light(const LightTable& table, Vec3 point, Vec3 normal, double u);

// The same, where there is a tree, for those of eight places whose bits are set in `lanes`; of the others probability
// 0.
std::array<LightTree::Choice, float_lanes> choose_by_tree(const LightTable& table, const Vec3x8& points,
                                                          const Vec3x8& normals,
                                                          const std::array<double, float_lanes>& u, uint32_t lanes);

// With which choose_light() would have chosen light `id` from there.
float probability_of(const LightTable& table, uint32_t id, Vec3 point, Vec3 normal);

}  // namespace lancer
