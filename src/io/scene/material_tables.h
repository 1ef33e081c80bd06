// What [texture.NAME], [material.NAME] and [[material_override]] mean: fills the materials of a SceneDescription.
// Pictures are only found here, not read.
#pragma once

#include <string>
#include <vector>

#include "io/asset_path.h"
#include "io/toml_reader.h"
#include "scene/description/description.h"

namespace lancer {

// A reference by name, looked up once all names are known.
struct NameUse {
    Location where;
    std::string name;
};

// Returns the materials that mixes and overrides name.
std::vector<NameUse> read_materials(const TomlTable& root, const AssetFolder& assets, SceneDescription& scene);

}  // namespace lancer
