// Lists the lights of a scene, each with the power by which it is chosen; makes the environment of its picture.
#pragma once

#include "scene/scene.h"

namespace lancer {

// Waits for scene.pending_environment and empties it. A picture that could not be read is an error; texels that cannot
// shine are a warning.
void receive_environment(Scene& scene, Diagnostics& diagnostics);

// Fills scene.lights and the ids that point into it. Textures must be there: they decide the power of emitters.
void build_light_table(Scene& scene);

}  // namespace lancer
