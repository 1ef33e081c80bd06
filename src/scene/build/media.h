// Which materials fill bodies with a medium, collected while the scene is built.
#pragma once

#include <cstdint>

#include "core/error.h"
#include "scene/description/description.h"
#include "scene/scene.h"

namespace lancer {

// The id of what is behind a surface of this material, or none; listed in scene.media. Says what cannot be. bsdf: of
// the same material.
uint16_t add_medium(const MaterialDescription& material, const Material& bsdf, Scene& scene, Diagnostics& diagnostics);

// Whether it makes a difference to a ray that it is inside.
bool matters(const Medium& medium);

// When all are listed: forgets them if none has a priority or absorbs anything, so that nobody looks for them.
void finish_media(Scene& scene);

}  // namespace lancer
