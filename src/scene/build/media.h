// Collects the media of materials while the scene is built.
#pragma once

#include <cstdint>

#include "core/error.h"
#include "scene/description/description.h"
#include "scene/scene.h"

namespace lancer {

// The id of what is behind a surface of this material, or none; listed in scene.media. Says what cannot be. bsdf: of
// the same material.
uint16_t add_medium(const MaterialDescription& material, const Material& bsdf, Scene& scene, Diagnostics& diagnostics);

// Whether the medium affects rays inside it.
bool matters(const Medium& medium);

// Removes all media if none has a priority or absorbs, so that rendering skips them.
void finish_media(Scene& scene);

}  // namespace lancer
