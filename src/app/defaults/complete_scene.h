// What a scene does not say and a picture needs: a view and light. Each has a file of its own in this folder.
#pragma once

#include <optional>
#include <string>

#include "app/load_scene.h"
#include "scene/build/picture_memory.h"

namespace lancer {

struct Completed {
    Vec3d up{0, 1, 0};  // of the scene, unit
    std::string text;   // what was added, as that of a scene file; empty if nothing was
    std::string light;  // of a bare mesh: which light was added or not, and why; on one line
    // Seconds by the clock that the choice took; nothing where there was none.
    std::optional<double> view_s{}, light_s{};
};

// Adds what the scene lacks: a camera to any scene, light to a bare mesh. aspect: width over height. pictures: may be
// asked for those of emission; memory: what they may take. Must be called inside with_threads.
Completed complete_scene(SceneDescription& scene, const SceneChoice& choice, double aspect,
                         const RasterSource& pictures, const PictureMemory& memory);

}  // namespace lancer
