// What moves while the shutter of an [animation] is open.
#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "io/asset_path.h"
#include "io/scene/animation.h"

namespace lancer {

// Fills the paths of cameras, meshes, instances and spheres of a frame, at steps so short that they are straight. root:
// the tree of the file. Of what moves and does not blur it warns.
void read_paths(const TomlValue& root, const Animation& animation, double frame, const AssetFolder& assets,
                const std::vector<std::string>& definitions, SceneDescription& scene, Diagnostics& diagnostics);

// A mesh that moves is drawn as an instance of its own, where none of the file is drawn in its place. The meshes of the
// scene are loaded.
void add_instances_of_moving(SceneDescription& scene);

}  // namespace lancer
