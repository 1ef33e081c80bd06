// What a [[light]] means.
#pragma once

#include "io/asset_path.h"
#include "io/toml_reader.h"
#include "scene/description/light.h"

namespace lancer {

// The picture of an environment is only found here, not read.
LightDescription read_light(const TomlTable& table, const AssetFolder& assets);

}  // namespace lancer
