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
    std::string file;                       // .toml, or a mesh: .obj, .ply, .gltf, .glb
    std::optional<std::string> text{};      // what a .toml file would hold: the file itself need not be there
    std::vector<MeshDescription> meshes{};  // in memory, besides those of the file
    std::string asset_root;                 // empty: the folder of the scene
    std::vector<std::string> definitions;   // KEY=VALUE, see io/scene/definition.h
    std::string camera;                     // the name of one of its cameras; empty: its default
    std::optional<Smoothing> smoothing;     // of mesh files of which the scene says nothing
    std::string env{};                      // bare mesh: picture of the environment in place of a sky and a key light
    bool ground = true;                     // bare mesh: a ground below it, where that shows
    std::optional<UpChoice> up{};           // over that of the scene
    std::optional<ViewDirection> view{};    // likewise, over position and target
    std::optional<uint32_t> frame{};        // of its animation or turntable; none: the first
    bool still = false;                     // nothing moves: the shutter of an animation does not open
    uint32_t turntable = 0;                 // frames of a whole turn of the camera; 0: it stands still
};

struct FrameCache;

// Loads a scene file or a bare mesh. Throws Error if anything is wrong; usage if it has no camera or frame of that
// name. Textures of mesh files are requested from `pictures` while the meshes are still being read. film: what earlier
// frames have read is not read again. checks_frames: whether mistakes in any other frame count.
SceneDescription load_scene(const SceneChoice& choice, Diagnostics& diagnostics, const RasterSource& pictures = {},
                            FrameCache* film = nullptr, bool checks_frames = false);

// The options that repeat this choice, each with a leading blank.
std::string options_text(const SceneChoice& choice);
// Of these only what changes the view: --up, --view and --turntable with its frame; empty if none is given.
std::string view_options_text(const SceneChoice& choice);

}  // namespace lancer
