// Whether what a render holds until its end fits into --memory, before it begins.
#pragma once

#include "app/render/recipe.h"

namespace lancer {

// Throws Error (no_memory), with a table of what takes how much, if what this process holds already (scene, accelerator
// and program), the film and, with --denoise, the denoiser take more than --memory. recipe: of the render to come.
void require_memory(const PictureRecipe& recipe);

}  // namespace lancer
