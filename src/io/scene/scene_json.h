// Exports a scene as JSON for scripts of other renderers, in the units of the scene file, with all names resolved:
// meshes with instances, spheres, planes; all materials but interfaces, with their textures; all lights, and an
// environment of one colour or a picture; one camera. Anything else is refused.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/scene/exported_pictures.h"
#include "scene/description/render_settings.h"

namespace lancer {

// An error for each thing that scene_json() has no words for. scene: complete, of a description that has a camera.
void check_exportable(const SceneDescription& description, const Scene& scene, const RenderSettings& settings,
                      Diagnostics& diagnostics);

// The text, schema "lancer.scene/2". settings: how the scene is to be rendered, resolved. mesh_files: of each mesh of
// the description, the file that write_obj() wrote; its materials m0, m1, ... are the places in "materials". pictures:
// those of the scene.
std::string scene_json(const SceneDescription& description, const Scene& scene, const RenderSettings& settings,
                       const std::vector<std::string>& mesh_files, const ExportedPictures& pictures);

}  // namespace lancer
