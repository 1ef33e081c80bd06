// Folds constant textures into parameters and merges duplicates. The picture keeps its bits.
#pragma once

#include "scene/scene.h"

namespace lancer {

// Textures with equal texels share them. Call it when all textures are loaded.
void share_texels(Scene& scene);

// A constant texture becomes a factor of its parameters, constant heights no bumps, and a mix with weight 0 or 1 its
// part. Updates which materials read textures.
void fold_constants(Scene& scene);

}  // namespace lancer
