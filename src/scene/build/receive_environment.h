// Makes the environment and the background of a scene from their pictures.
#pragma once

#include "scene/build/pending_pictures.h"
#include "scene/scene.h"

namespace lancer {

// Waits for the picture. One that could not be read is an error; texels that cannot shine are a warning.
void receive_environment(Scene& scene, PendingPictures::OfEnvironment pending, Diagnostics& diagnostics);

// Waits for the pictures of the background, makes Scene::background of them and, after receive_environment(), the
// table. What cannot be read is an error.
void receive_background(Scene& scene, PendingPictures::OfBackground pending, Diagnostics& diagnostics);

}  // namespace lancer
