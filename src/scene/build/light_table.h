// Builds the light table of a scene with selection probabilities by power, and the environment map.
#pragma once

#include "scene/scene.h"

namespace lancer {

// Waits for scene.pending_environment and empties it. A picture that could not be read is an error; invalid texels give
// a warning.
void receive_environment(Scene& scene, Diagnostics& diagnostics);

// Fills scene.lights and the ids that refer to it. Textures must be loaded, as they determine the power of emitters.
void build_light_table(Scene& scene);

}  // namespace lancer
