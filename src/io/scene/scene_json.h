// Exports a scene as JSON for scripts of other renderers, in the units of the scene file, with all names resolved. It
// supports meshes with instances, spheres, planes; lambert, mirror and smooth glass with constant colours and emission;
// point, directional and sphere lights and a constant environment; one camera. Anything else is refused.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"
#include "scene/build/scene_builder.h"
#include "scene/description/render_settings.h"

namespace lancer {

// An error for each thing that scene_json() has no words for. scene: begun from the description, which has a camera.
void check_exportable(const SceneDescription& description, const SceneBuilder& scene, const RenderSettings& settings,
                      Diagnostics& diagnostics);

// The text, schema "lancer.scene/1". settings: how the scene is to be rendered, resolved. mesh_files: of each mesh of
// the description, the file that write_obj() wrote; its materials m0, m1, ... are the places in "materials".
std::string scene_json(const SceneDescription& description, const Scene& scene, const RenderSettings& settings,
                       const std::vector<std::string>& mesh_files);

}  // namespace lancer
