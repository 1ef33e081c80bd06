// --write-scene: a scene with what was added to it, as a scene file that renders the same bits.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/load_scene.h"
#include "io/scene/output_table.h"

namespace lancer {

// What is to be said over the material of a mesh file: keys and values of its [[material_override]].
struct MaterialEdit {
    std::string material;
    std::vector<std::pair<std::string, std::string>> values;
};
struct SceneEdits {
    std::vector<std::string> definitions;  // as of -D
    std::vector<MaterialEdit> materials;
};

// The text of such a file, of a scene file with its comments wherever the new values find a place in it. The scene has
// been loaded without errors. added: what complete_scene() returned; camera: of the scene, complete; settings: those of
// the command line; output: of the scene, and over it of the command line; edits: over all of these.
std::string completed_scene_text(const SceneChoice& choice, const std::string& added, const CameraDescription& camera,
                                 const RenderSettings& settings, const OutputDescription& output,
                                 const SceneEdits& edits = {});

// What --asset-root has to be for that file: the files that the scene names are found from there. Empty if none is
// needed, as the file lies beside the scene.
std::string asset_root_for(const std::string& file, const SceneChoice& choice);

}  // namespace lancer
