// Takes textures out of a scene that say the same everywhere, and keeps what is there twice once. Pictures stay what
// they are, bit by bit.
#pragma once

#include "scene/scene.h"

namespace lancer {

// Textures with the same texels share them. Call it when all textures are there.
void share_texels(Scene& scene);

// A texture of one value becomes a factor of the parameters that it belongs to, heights without a slope no bumps, and a
// mix of one part alone that part. Materials that read no texture any more say so.
void fold_constants(Scene& scene);

}  // namespace lancer
