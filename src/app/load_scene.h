// From a path on the command line to a description that can be rendered.
#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "scene/description/description.h"

namespace lancer {

// What the command line says of a scene, besides how it is rendered.
struct SceneChoice {
    std::string file;                      // .toml or .obj
    std::string asset_root;                // empty: the folder of the scene
    std::vector<std::string> definitions;  // KEY=VALUE, see io/scene/definition.h
    std::string camera;                    // the name of one of its cameras; empty: its default
};

// A scene file or a bare mesh. Throws Error if anything is wrong; usage if it has no camera of that name. pictures is
// asked for the textures of mesh files while the meshes themselves are still being read.
SceneDescription load_scene(const SceneChoice& choice, Diagnostics& diagnostics, const RasterSource& pictures = {});

// Options that make the same choice again, with a blank before each.
std::string options_text(const SceneChoice& choice);

// Gives a scene without camera one that sees all of it, and a bare mesh on which nothing emits a white sky.
// aspect: width over height. Returns what was added, as text to paste into a scene file; empty if nothing was.
std::string complete_scene(SceneDescription& scene, double aspect);

}  // namespace lancer
