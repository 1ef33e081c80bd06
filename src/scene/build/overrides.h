// Which [[material_override]] changes a material of a mesh file.
#pragma once

#include <string>

#include "scene/description/description.h"

namespace lancer {

// Whether a name is one that the shell pattern of a [[material_override]] means.
bool is_overridden(const std::string& material, const std::string& pattern);
// The pattern that means this name alone.
std::string pattern_of(const std::string& material);
// The first whose pattern matches the name; null if none does.
const MaterialOverride* find_override(const SceneDescription& description, const std::string& material);

}  // namespace lancer
