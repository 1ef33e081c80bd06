// Makes the textures of a scene from its pictures.
#pragma once

#include "scene/build/picture_memory.h"
#include "scene/scene.h"

namespace lancer {

// Waits for the pictures and takes them. One that could not be read is a warning and leaves a texture of 1, or no
// bumps. Heights that look like normals become a map of normals, with a warning. texture_limit: as in RenderSettings.
void receive_textures(Scene& scene, std::vector<PendingPictures::OfTexture> pending, const PictureMemory& memory,
                      uint32_t texture_limit, Diagnostics& diagnostics);

}  // namespace lancer
