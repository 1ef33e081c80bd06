// Lists the lights of a scene, each with the power by which it is chosen.
#pragma once

#include "scene/scene.h"

namespace lancer {

// Fills scene.lights and the ids that point into it. Textures must be there: they decide the power of emitters.
void build_light_table(Scene& scene);

}  // namespace lancer
