// Makes the environment and the background of a scene from their pictures.
#pragma once

#include "scene/build/picture_memory.h"
#include "scene/scene.h"

namespace lancer {

// Waits for the picture. One that could not be read is an error; texels that cannot shine are a warning.
void receive_environment(Scene& scene, PendingPictures::OfEnvironment pending, const PictureMemory& memory,
                         Diagnostics& diagnostics);

// Waits for the pictures of the background, makes Scene::background of them and, after receive_environment(), the
// table. What cannot be read is an error. texture_limit: as in RenderSettings, of a planar picture.
void receive_background(Scene& scene, PendingPictures::OfBackground pending, const PictureMemory& memory,
                        uint32_t texture_limit, Diagnostics& diagnostics);

}  // namespace lancer
