// What a scene does not say and a picture needs: a view and light. Each has a file of its own in this folder.
#pragma once

#include <string>

#include "app/load_scene.h"

namespace lancer {

// Adds what the scene lacks: a camera to any scene, light to a bare mesh. aspect: width over height. Returns what was
// added as the text of a scene file; empty if nothing was.
std::string complete_scene(SceneDescription& scene, const SceneChoice& choice, double aspect);

}  // namespace lancer
