// The auxiliary outputs (AOVs) that there are, with their names: see render/aov.h.
#pragma once

#include "core/enum_names.h"

namespace lancer {

enum class Aov { albedo, normal, depth, position, uv, material, variance, mask, flat, samples, z };
template <>
inline constexpr auto enum_names<Aov> = std::to_array<std::string_view>({"albedo", "normal", "depth", "position", "uv",
                                                                         "material", "variance", "mask", "flat",
                                                                         "samples", "z"});

}  // namespace lancer
