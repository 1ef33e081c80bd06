// Reads a scene file (TOML, see docs/scene-format.md) into a SceneDescription. Each table is checked here, with its
// place in the file; checks that need the whole scene are done when the scene is built.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "io/mesh_options.h"
#include "io/scene/output_table.h"
#include "io/toml_value.h"
#include "scene/description/description.h"

namespace lancer {

// Loads one mesh file. Problems go to the diagnostics; may return null if there was an error.
using MeshLoader =
    std::function<std::shared_ptr<const MeshData>(const std::string& path, Diagnostics&, const MeshOptions&)>;

struct SceneFileOptions {
    std::string asset_root = {};  // empty: only files in the folder of the scene file may be named in it
    MeshLoader mesh_loader = {};  // called once per mesh file and smoothing; must be set if the scene has one
    RasterSource pictures = {};   // as in MeshOptions
    std::optional<Smoothing> smoothing = {};    // of meshes that say nothing of it
    std::vector<std::string> definitions = {};  // KEY=VALUE, override the file; see io/scene/definition.h
    std::optional<double> frame = {};           // of its [animation]; none: the first
    bool still = false;                         // an [animation] has no shutter
    bool checks_frames = false;                 // whether what is wrong in any other frame is an error, too
};

// Collects every problem in `diagnostics`; after an error the description is not fit for use. Throws Error only if
// the file cannot be read at all, or if it has no such frame (usage).
SceneDescription load_scene_file(const std::string& path, const SceneFileOptions& options, Diagnostics& diagnostics);

// The same for a text in memory; `path` is used in messages, and mesh files are relative to it.
SceneDescription parse_scene(std::string_view text, const std::string& path, const SceneFileOptions& options,
                             Diagnostics& diagnostics);

// What the scene file says, or the one that a mesh file stands for, with the definitions put over it: as it is read,
// not checked. An [animation] is replaced by the values of the frame. Throws Error if the file cannot be read.
TomlValue scene_tree(const std::string& path, const std::vector<std::string>& definitions, Diagnostics& diagnostics,
                     std::optional<double> frame = {});
// Its [output].
OutputDescription read_output(const std::string& path, const std::vector<std::string>& definitions,
                              Diagnostics& diagnostics, std::optional<double> frame = {});

// Its [animation]; nothing if there is none. Throws Error if the file cannot be read.
std::optional<AnimationDescription> read_animation(const std::string& path, const std::vector<std::string>& definitions,
                                                   Diagnostics& diagnostics);

// A mesh file as a scene of its own: as if a scene file beside it held nothing but a [[mesh]] with its name.
SceneDescription wrap_mesh(const std::string& path, const SceneFileOptions& options, Diagnostics& diagnostics);

}  // namespace lancer
