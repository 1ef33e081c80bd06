// The table [background] of a scene file. Pictures are only found here, not read.
#pragma once

#include "io/asset_path.h"
#include "io/toml_reader.h"
#include "scene/description/description.h"

namespace lancer {

// Fills scene.background if the file has the table.
void read_background(const TomlTable& root, const AssetFolder& assets, SceneDescription& scene);

}  // namespace lancer
