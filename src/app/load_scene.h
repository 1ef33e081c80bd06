// Loads a scene from the command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/smoothing.h"
#include "scene/description/description.h"
#include "scene/view/auto_view.h"

namespace lancer {

// The choice of a scene on the command line, besides render settings.
struct SceneChoice {
    std::string file;                      // .toml or .obj
    std::string asset_root;                // empty: the folder of the scene
    std::vector<std::string> definitions;  // KEY=VALUE, see io/scene/definition.h
    std::string camera;                    // the name of one of its cameras; empty: its default
    std::optional<Smoothing> smoothing;    // of mesh files of which the scene says nothing
    std::string env{};                     // bare mesh: picture of the environment in place of a sky and a key light
    bool ground = true;                    // bare mesh: a ground below it, where that shows
    std::optional<UpChoice> up{};          // over that of the scene
    std::optional<ViewDirection> view{};   // likewise, over position and target
};

// Loads a scene file or a bare mesh. Throws Error if anything is wrong; usage if it has no camera of that name.
// Textures of mesh files are requested from `pictures` while the meshes are still being read.
SceneDescription load_scene(const SceneChoice& choice, Diagnostics& diagnostics, const RasterSource& pictures = {});

// The options that repeat this choice, each with a leading blank.
std::string options_text(const SceneChoice& choice);
// Of these only --up and --view; empty if neither is given.
std::string view_options_text(const SceneChoice& choice);

}  // namespace lancer
