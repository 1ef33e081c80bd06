// Loads a scene from the command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/smoothing.h"
#include "scene/description/description.h"

namespace lancer {

// The choice of a scene on the command line, besides render settings.
struct SceneChoice {
    std::string file;                      // .toml or .obj
    std::string asset_root;                // empty: the folder of the scene
    std::vector<std::string> definitions;  // KEY=VALUE, see io/scene/definition.h
    std::string camera;                    // the name of one of its cameras; empty: its default
    std::optional<Smoothing> smoothing;    // of mesh files of which the scene says nothing
};

// Loads a scene file or a bare mesh. Throws Error if anything is wrong; usage if it has no camera of that name.
// Textures of mesh files are requested from `pictures` while the meshes are still being read.
SceneDescription load_scene(const SceneChoice& choice, Diagnostics& diagnostics, const RasterSource& pictures = {});

// The options that repeat this choice, each with a leading blank.
std::string options_text(const SceneChoice& choice);

// Gives a scene without camera one that sees all of it, and a bare mesh on which nothing emits a white sky.
// aspect: width over height. Returns what was added, as text to paste into a scene file; empty if nothing was.
std::string complete_scene(SceneDescription& scene, double aspect);

}  // namespace lancer
