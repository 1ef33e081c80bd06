// What [camera] and [camera.NAME] mean: fills the cameras of a SceneDescription.
#pragma once

#include "io/toml_reader.h"
#include "scene/description/description.h"

namespace lancer {

// The direction at the key 'up': a vector, or "y" or "z"; nothing if there is none or it is wrong.
std::optional<Vec3d> read_up(const TomlTable& table);

// [camera] is the camera to render; a table that holds nothing but named ones leaves that to the first of them. Every
// named camera starts from the values of [camera].
void read_cameras(const TomlTable& root, SceneDescription& scene);

}  // namespace lancer
