// The types of materials, with the names that scene files give them. Each struct of a material says which one it is, in
// its member `type`.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace lancer {

// A mix is the last one: it has no BSDF of its own.
enum class MaterialType : uint8_t { lambert, mirror, metal, glass, plastic, interface, mix };

inline constexpr std::array<std::string_view, 7> material_type_names{"lambert", "mirror",    "metal", "glass",
                                                                     "plastic", "interface", "mix"};
static_assert(static_cast<size_t>(MaterialType::mix) + 1 == material_type_names.size());

constexpr std::string_view name_of(MaterialType type) { return material_type_names[static_cast<size_t>(type)]; }

}  // namespace lancer
