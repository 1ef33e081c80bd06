// The key of a scene file that a track of [animation] names.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/toml_reader.h"

namespace lancer {

// "light.0.intensity" or "mesh.gear.rotate" as a path through the tree, with the entries of lists by number: by name
// they are those with that `name`. The table that holds the key must be in the file; the key itself need not be.
// Nothing and a problem at `where`, with the nearest known name, if it is not.
std::optional<std::vector<std::string>> find_target(const TomlValue& root, const std::string& key,
                                                    const Location& where, TomlProblems& problems);

}  // namespace lancer
