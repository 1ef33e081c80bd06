// What the picture files of a render hold.
#pragma once

#include "app/render/outputs.h"
#include "app/render/recipe.h"
#include "core/film.h"
#include "render/denoise/denoise.h"

namespace lancer {

// film and denoised must outlive the result. denoised: empty where only the noisy picture is written.
PictureContent content_of(const Film& film, const Denoised& denoised, const PictureRecipe& recipe);

// What the file of a denoised picture has besides: the noisy one, and the error to expect.
std::vector<ImagePlane> layers_of_denoised(const Image& noisy, const Denoised& denoised);

}  // namespace lancer
