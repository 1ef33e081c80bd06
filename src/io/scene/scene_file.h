// Reads a scene file (TOML, see docs/scene-format.md) into a SceneDescription. Everything that one table can tell is
// checked here, with the place in the file; what only the whole scene can tell is left to Scene::build.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "io/mesh_options.h"
#include "scene/description/description.h"

namespace lancer {

// Loads one mesh file. What is wrong with it goes to the diagnostics; may return null if there was an error.
using MeshLoader =
    std::function<std::shared_ptr<const MeshData>(const std::string& path, Diagnostics&, const MeshOptions&)>;

struct SceneFileOptions {
    std::string asset_root = {};                // empty: only files in the folder of the scene file may be named in it
    MeshLoader mesh_loader = {};                // called once for each mesh file; must be set if the scene names one
    RasterSource pictures = {};                 // as in MeshOptions
    std::vector<std::string> definitions = {};  // KEY=VALUE, over what the file says; see io/scene/definition.h
};

// Collects every problem in `diagnostics`; after an error the description is not fit for use. Throws Error only if
// the file cannot be read at all.
SceneDescription load_scene_file(const std::string& path, const SceneFileOptions& options, Diagnostics& diagnostics);

// The same for a text already in memory; `path` stands in messages, and mesh files are sought relative to it.
SceneDescription parse_scene(std::string_view text, const std::string& path, const SceneFileOptions& options,
                             Diagnostics& diagnostics);

// A mesh file as a scene of its own: as if a scene file beside it held nothing but a [[mesh]] with its name.
SceneDescription wrap_mesh(const std::string& path, const SceneFileOptions& options, Diagnostics& diagnostics);

}  // namespace lancer
