// Materials that every scene knows by name, as interfaces of the classic illumination model: what `material = "bronze"`
// means where the scene has no [material.bronze] of its own, and what `preset = "bronze"` starts from.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "scene/description/description.h"

namespace lancer {

std::vector<std::string_view> names_of_presets();

// Nothing if no preset has this name.
std::optional<MaterialDescription> find_preset(std::string_view name);

// What a shape of the scene may wear: its own materials, then the presets that none of these hides.
std::vector<std::string_view> names_of_materials(const SceneDescription& scene);

}  // namespace lancer
