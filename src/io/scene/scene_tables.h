// What each table of a scene file means: fills a SceneDescription from the values of the file. The mesh files are
// only found here, not loaded.
#pragma once

#include <optional>
#include <vector>

#include "io/asset_path.h"
#include "io/smoothing.h"
#include "io/toml_reader.h"
#include "scene/description/description.h"

namespace lancer {

struct MeshFile {
    Location where;  // of the name in the scene file
    AssetFolder::Found file;
    std::optional<Smoothing> smoothing;
    uint32_t catmull_clark = 0;  // so often it is subdivided when it is read
};

// Returns the file of every mesh of the scene, in the order of scene.meshes; with an empty path where none is named
// or it cannot be had.
std::vector<MeshFile> read_scene_tables(const TomlTable& root, const AssetFolder& assets, SceneDescription& scene);

}  // namespace lancer
