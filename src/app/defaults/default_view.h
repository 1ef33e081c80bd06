// The view of a scene without camera. complete_scene() calls it.
#pragma once

#include <string>

#include "scene/description/description.h"

namespace lancer {

// Gives a scene without camera one that sees all of it. aspect: width over height. Returns what was added as the text
// of a scene file; empty if there is a camera.
std::string add_default_view(SceneDescription& scene, double aspect);

}  // namespace lancer
