// Makes the textures of a scene from its pictures.
#pragma once

#include "scene/scene.h"

namespace lancer {

// Waits for scene.pending and empties it. A picture that could not be read gives a warning and a texture of 1, or no
// bumps.
void receive_textures(Scene& scene, Diagnostics& diagnostics);

}  // namespace lancer
