// [fog] of scene files.
#pragma once

#include "io/toml_reader.h"
#include "scene/description/description.h"

namespace lancer {

FogDescription read_fog(const TomlTable& table);

}  // namespace lancer
