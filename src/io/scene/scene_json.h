// Exports a scene as JSON for scripts of other renderers, in the units of the scene file, with all names resolved. It
// supports meshes with instances, spheres, planes; lambert, mirror and smooth glass with constant colours and emission;
// point, directional and sphere lights and a constant environment; one camera. Anything else is refused.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/switches.h"
#include "scene/scene.h"

namespace lancer {

// Render settings.
struct ExportedView {
    uint32_t width = 0, height = 0;
    uint32_t max_depth = 0;  // surface vertices; 0: no limit
    std::string integrator, filter;
    Switches switches;
};

// Reports an error for each unsupported feature. scene: begun from the description, which has a camera.
void check_exportable(const SceneDescription& description, const Scene& scene, const Switches& switches,
                      Diagnostics& diagnostics);

// The text, schema "lancer.scene/1". mesh_files: of each mesh of the description, the file that write_obj() wrote; its
// materials m0, m1, ... are the places in "materials".
std::string scene_json(const SceneDescription& description, const Scene& scene, const ExportedView& view,
                       const std::vector<std::string>& mesh_files);

}  // namespace lancer
