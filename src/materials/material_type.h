// The types of materials, with the names that scene files give them. Each struct of a material says which one it is, in
// its member `type`.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/enum_names.h"

namespace lancer {

// A mix is the last one: it has no BSDF of its own.
enum class MaterialType : uint8_t { lambert, translucent, mirror, metal, glass, plastic, interface, principled, mix };

template <>
inline constexpr auto enum_names<MaterialType> = std::to_array<std::string_view>({"lambert", "translucent", "mirror",
                                                                                  "metal", "glass", "plastic",
                                                                                  "interface", "principled", "mix"});
static_assert(static_cast<size_t>(MaterialType::mix) + 1 == enum_names<MaterialType>.size());

}  // namespace lancer
