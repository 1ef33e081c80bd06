// Which [[material_override]] changes a material of a mesh file.
#pragma once

#include <string>

#include "scene/description/description.h"

namespace lancer {

// The first whose pattern matches the name; null if none does.
const MaterialOverride* find_override(const SceneDescription& description, const std::string& material);

}  // namespace lancer
