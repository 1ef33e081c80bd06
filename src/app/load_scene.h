// From a path on the command line to a description that can be rendered.
#pragma once

#include <string>

#include "core/error.h"
#include "scene/description.h"

namespace lancer {

// A scene file (.toml) or a bare mesh (.obj). Throws Error if anything is wrong.
SceneDescription load_scene(const std::string& path, const std::string& asset_root, Diagnostics& diagnostics);

// Gives a scene without camera one that sees all of it, and a bare mesh on which nothing emits a white sky.
// aspect: width over height. Returns what was added, as text to paste into a scene file; empty if nothing was.
std::string complete_scene(SceneDescription& scene, double aspect);

}  // namespace lancer
