// The light of a bare mesh on which nothing emits. complete_scene() calls it.
#pragma once

#include <string>

#include "scene/description/description.h"

namespace lancer {

// Gives a scene in which nothing emits a sky and a sun from the upper left, with a radiance that makes surfaces about
// as bright as their albedo. Returns what was added as the text of a scene file; empty if there is light.
std::string add_default_light(SceneDescription& scene);

}  // namespace lancer
